// SPDX-License-Identifier: Apache-2.0
#include "io/files/plain_text.hpp"

#include <utf8.h>

#include <algorithm>

namespace sturz {
namespace {

/// A byte of a UTF-8 character that is not its first.
bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

bool is_printable(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return c == '\t' || c == '\n' || c == '\r' || (byte >= 0x20 && byte != 0x7F);
}

std::string byte_name(char c) {
  constexpr const char* hex = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + hex[byte >> 4] + hex[byte & 15];
}

}  // namespace

std::optional<UnreadableByte> first_unreadable(std::string_view text) {
  const std::size_t n_valid = utf8::find_invalid(text);
  UnreadableByte at;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i == n_valid || !is_printable(text[i])) {
      at.what = byte_name(text[i]);
      return at;
    }
    ++at.column;
    if (text[i] == '\n') {
      ++at.line;
      at.column = 1;
    }
  }
  return std::nullopt;
}

std::string as_utf8(std::string_view text) { return utf8::replace_invalid(text); }

std::string one_line(std::string_view text, std::size_t max_bytes) {
  const bool cut = text.size() > max_bytes;
  if (cut) {
    std::size_t end = max_bytes;
    while (end > 0 && is_continuation(text[end])) --end;
    text = text.substr(0, end);
  }
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return cut ? line + "..." : line;
}

}  // namespace sturz
