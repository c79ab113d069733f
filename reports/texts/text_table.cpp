// SPDX-License-Identifier: Apache-2.0
#include "reports/texts/text_table.hpp"

#include "engine/core/error.hpp"
#include "reports/page/bundle.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>

namespace sturz {
namespace {

using Table = std::map<std::string, std::string, std::less<>>;

const std::map<std::string, Table, std::less<>>& tables() {
  static const auto all = [] {
    std::map<std::string, Table, std::less<>> read;
    for (const BundledTexts& language : bundled_texts()) {
      const auto texts = nlohmann::json::parse(language.json);
      for (const auto& [key, text] : texts.items())
        read[std::string(language.name)].emplace(key, text.get<std::string>());
    }
    return read;
  }();
  return all;
}

const std::pair<const std::string, Table>& english() {
  static const auto& table = *tables().find("en");
  return table;
}

thread_local const std::pair<const std::string, Table>* current = nullptr;

const std::pair<const std::string, Table>& spoken() { return current ? *current : english(); }

const std::string* find_text(std::string_view key) {
  for (const Table* table : {&spoken().second, &english().second})
    if (const auto found = table->find(key); found != table->end()) return &found->second;
  return nullptr;
}

}  // namespace

LanguageScope::LanguageScope(std::string_view language) : before_(current) {
  const auto found = tables().find(language);
  expect(found != tables().end(), "a page is asked for in a language that has a table");
  current = &*found;
}
LanguageScope::~LanguageScope() {
  current = static_cast<const std::pair<const std::string, Table>*>(before_);
}

std::vector<std::string> page_languages() {
  std::vector<std::string> names;
  for (const auto& [name, table] : tables()) names.push_back(name);
  return names;
}

const std::string& page_language() { return spoken().first; }

const std::string& tr(std::string_view key) {
  const std::string* text = find_text(key);
  if (text == nullptr) {
    std::string what = "the page's texts have no key ";
    what += key;
    throw std::logic_error(what);
  }
  return *text;
}

bool has_text(std::string_view key) { return find_text(key) != nullptr; }

std::string script_texts() {
  constexpr std::string_view mark = "js.";
  nlohmann::ordered_json texts = nlohmann::ordered_json::object();
  for (const auto& [key, text] : english().second)
    if (key.starts_with(mark)) texts[key.substr(mark.size())] = tr(key);
  return texts.dump();
}

}  // namespace sturz
