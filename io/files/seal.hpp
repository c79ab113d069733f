// SPDX-License-Identifier: Apache-2.0
/// A checksum over every byte of a file, kept in its last line: looked at before a library that
/// trusts its input (HDF5 crashes on some flipped bits) opens the file.
///
///   content ... \n#sturz sha256 <64 hexadecimal digits>\n
///
/// HDF5 looks at nothing beyond the end that its own header states, so a sealed netCDF file opens
/// everywhere. The seal lies in the file and not beside it: the two cannot part, and one rename
/// makes both appear.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace sturz {

/// The last line for a file of that content.
std::string seal_of(std::span<const std::byte> content);

enum class SealState { good, missing, broken };

/// Reads the whole file. \throws IoError when it cannot be read
SealState seal_state(const std::filesystem::path& file);

/// \throws IoError unless the seal is there and fits
void require_sealed(const std::filesystem::path& file);

}  // namespace sturz
