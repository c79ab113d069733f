// SPDX-License-Identifier: Apache-2.0
/// Compact bytes for a page: deflate, base64, and rasters of small whole numbers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// zlib stream (RFC 1950) of `bytes` at the best level. Throws std::runtime_error if zlib fails.
std::vector<std::uint8_t> deflate_bytes(std::span<const std::uint8_t> bytes);
std::string base64(std::span<const std::uint8_t> bytes);

/// Whole numbers of a raster, packed for the browser: each row as differences to the left
/// neighbour (the first cell as it is, all modulo 2^bits); 16-bit codes as all high bytes, then
/// all low bytes; then deflate, then base64.
struct PackedCodes {
  int bits = 8;      ///< 8 when every code fits, else 16
  std::string data;  ///< base64
};
/// \param codes [n_rows][n_cols]
PackedCodes pack_codes(std::span<const std::uint16_t> codes, int n_cols);

}  // namespace sturz
