// SPDX-License-Identifier: Apache-2.0
/// Enumerations that files and people know by words: one table each, both directions follow.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <type_traits>

namespace sturz {

template <class Enum>
struct Word {
  Enum value;
  std::string_view text;
};
// clang 14 does not deduce this for an aggregate by itself.
template <class Enum>
Word(Enum, std::string_view) -> Word<Enum>;

/// An enumeration joins by declaring, beside itself, its table in the order in which it is listed:
///   constexpr auto words_of(Colour) { return std::array{Word{Colour::red, "red"}, ...}; }
template <class Enum>
concept Worded = std::is_enum_v<Enum> && requires {
  words_of(Enum{});
};

/// Empty for a value that the table does not hold.
template <Worded Enum>
constexpr std::string_view to_string(Enum value) {
  for (const auto& word : words_of(Enum{}))
    if (word.value == value) return word.text;
  return {};
}

/// Inverse of to_string; empty for an unknown word.
template <Worded Enum>
constexpr std::optional<Enum> from_word(std::string_view text) {
  for (const auto& word : words_of(Enum{}))
    if (word.text == text) return word.value;
  return std::nullopt;
}

}  // namespace sturz
