// SPDX-License-Identifier: Apache-2.0
/// Text hygiene for what users type: UTF-8 checks and one-line excerpts for messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sturz {

/// A byte that plain text does not hold.
struct UnreadableByte {
  int line = 1, column = 1;  ///< from 1, column in bytes
  std::string what;          ///< "byte 0x00", ...
};

/// First byte that is neither valid UTF-8 nor a printable character, tab or line end.
std::optional<UnreadableByte> first_unreadable(std::string_view text);

/// `text` with every byte that is not UTF-8 replaced: names of files are bytes, pages are not.
std::string as_utf8(std::string_view text);

/// `text` on one line, cut after `max_bytes` (never inside a character) with "..." for the rest.
std::string one_line(std::string_view text, std::size_t max_bytes);

}  // namespace sturz
