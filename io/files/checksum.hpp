// SPDX-License-Identifier: Apache-2.0
/// Checksums that tell whether an input file is still the one that a result was made from.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sturz {

/// "sha256:" and 64 hexadecimal digits of the file's bytes. \throws IoError
std::string file_checksum(const std::filesystem::path& file);

/// The same of a text in memory.
std::string text_checksum(std::string_view text);

/// What to say of a file whose checksum was `before` and is `now`; empty when they are equal. A sum
/// of another kind ("fnv1a64:...", of versions before SHA-256) cannot be compared and says so.
std::string checksum_difference(const std::string& before, const std::string& now);

}  // namespace sturz
