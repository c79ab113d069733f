// SPDX-License-Identifier: Apache-2.0
/// Whole text files: csv, json, yaml, html.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sturz {

/// Replaces `target` by `text` (UTF-8, written as it is) in one stroke. \throws IoError
void write_text_atomic(const std::filesystem::path& target, std::string_view text);

/// The whole file. \throws IoError if it cannot be read
std::string read_text(const std::filesystem::path& file);

}  // namespace sturz
