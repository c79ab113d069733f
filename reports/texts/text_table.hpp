// SPDX-License-Identifier: Apache-2.0
/// The words of a page: one file a language, reports/texts/<language>.json, with the same keys.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// While it lives, tr() and the numbers of text.hpp speak `language` on this thread. A page is made
/// of hundreds of small functions; handing the language through all of them would hide what they
/// do. Outside of any scope it is English.
/// \throws std::logic_error for a language without a table
class LanguageScope {
 public:
  explicit LanguageScope(std::string_view language);
  ~LanguageScope();
  LanguageScope(const LanguageScope&) = delete;
  LanguageScope& operator=(const LanguageScope&) = delete;

 private:
  const void* before_;
};

/// The languages that have a table: "de", "en".
std::vector<std::string> page_languages();
/// Of the innermost scope: "en".
const std::string& page_language();

/// The text of a key; a language that lacks it gives the English one.
/// \throws std::logic_error for a key that English does not have
const std::string& tr(std::string_view key);
/// The same with its places "{}" filled.
template <class... Args>
std::string tr(std::string_view key, const Args&... args) requires(sizeof...(Args) > 0) {
  return fmt::vformat(tr(key), fmt::make_format_args(args...));
}
/// The text of `key` followed by ".one" or ".many", by which of the two `n` asks for, its places
/// filled with `n` and the others.
template <class... Args>
std::string tr_count(std::string_view key, long long n, const Args&... args) {
  return tr(fmt::format("{}.{}", key, n == 1 ? "one" : "many"), n, args...);
}
/// Whether there is such a key.
bool has_text(std::string_view key);

/// The texts of the script (keys that begin with "js."), as a JSON object without that beginning.
std::string script_texts();

}  // namespace sturz
