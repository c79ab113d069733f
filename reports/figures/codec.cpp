// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/codec.hpp"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>

namespace sturz {

std::vector<std::uint8_t> deflate_bytes(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> out(size);
  const int status = compress2(out.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()),
                               Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::runtime_error("zlib could not compress the report's data");
  out.resize(size);
  return out;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = bytes[i] << 16;
    if (left > 1) word |= bytes[i + 1] << 8;
    if (left > 2) word |= bytes[i + 2];
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= left ? alphabet[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

PackedCodes pack_codes(std::span<const std::uint16_t> codes, int n_cols) {
  PackedCodes packed;
  const bool small = std::all_of(codes.begin(), codes.end(), [](auto c) { return c < 256; });
  packed.bits = small ? 8 : 16;
  std::vector<std::uint8_t> bytes(codes.size() * (small ? 1 : 2));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const bool row_start = i % static_cast<std::size_t>(n_cols) == 0;
    const auto step = static_cast<std::uint16_t>(codes[i] - (row_start ? 0 : codes[i - 1]));
    if (small) {
      bytes[i] = static_cast<std::uint8_t>(step);
    } else {
      bytes[i] = static_cast<std::uint8_t>(step >> 8);
      bytes[codes.size() + i] = static_cast<std::uint8_t>(step & 255);
    }
  }
  packed.data = base64(deflate_bytes(bytes));
  return packed;
}

}  // namespace sturz
