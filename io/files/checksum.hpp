// SPDX-License-Identifier: Apache-2.0
/// Checksums that tell whether an input file is still the one that a result was made from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace sturz {

/// FNV-1a, 64 bit. Finds changes, does not defend against forgery.
std::uint64_t fnv1a64(std::span<const std::byte> bytes,
                      std::uint64_t start = 14695981039346656037ULL);

/// "fnv1a64:" and 16 hexadecimal digits of the file's bytes. \throws IoError
std::string file_checksum(const std::filesystem::path& file);

}  // namespace sturz
