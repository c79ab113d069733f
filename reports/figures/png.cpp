// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/png.hpp"

#include "reports/figures/codec.hpp"

#include <zlib.h>

#include <array>
#include <string_view>

namespace sturz {
namespace {

using Bytes = std::vector<std::uint8_t>;
enum class ColourType : std::uint8_t { grey = 0, palette = 3 };

void append_u32(Bytes& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(value >> shift & 255);
}

void append_chunk(Bytes& png, std::string_view type, std::span<const std::uint8_t> data) {
  append_u32(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  append_u32(png, static_cast<std::uint32_t>(
                      crc32(0, png.data() + start, static_cast<uInt>(png.size() - start))));
}

/// Rows with the "Sub" filter (difference to the pixel on the left) or none.
Bytes filtered(std::span<const std::uint8_t> rows, int row_bytes, bool sub) {
  Bytes out;
  out.reserve(rows.size() + rows.size() / row_bytes);
  for (std::size_t start = 0; start < rows.size(); start += row_bytes) {
    out.push_back(sub ? 1 : 0);
    for (int i = 0; i < row_bytes; ++i) {
      const std::uint8_t left = sub && i > 0 ? rows[start + i - 1] : 0;
      out.push_back(static_cast<std::uint8_t>(rows[start + i] - left));
    }
  }
  return out;
}

Bytes start_png(int width, int height, ColourType type) {
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  Bytes header;
  append_u32(header, width);
  append_u32(header, height);
  header.insert(header.end(), {8, static_cast<std::uint8_t>(type), 0, 0, 0});
  append_chunk(png, "IHDR", header);
  return png;
}

void finish_png(Bytes& png, const Bytes& rows) {
  append_chunk(png, "IDAT", deflate_bytes(rows));
  append_chunk(png, "IEND", {});
}

}  // namespace

std::vector<std::uint8_t> grey_png(std::span<const std::uint8_t> grey, int width, int height) {
  Bytes png = start_png(width, height, ColourType::grey);
  finish_png(png, filtered(grey, width, true));
  return png;
}

std::vector<std::uint8_t> palette_png(std::span<const std::uint8_t> index, int width, int height,
                                      std::span<const Rgb> palette) {
  Bytes png = start_png(width, height, ColourType::palette);
  Bytes colours;
  for (const Rgb& c : palette) colours.insert(colours.end(), {c.r, c.g, c.b});
  append_chunk(png, "PLTE", colours);
  append_chunk(png, "tRNS", std::array<std::uint8_t, 1>{0});
  finish_png(png, filtered(index, width, false));
  return png;
}

std::string data_uri(std::span<const std::uint8_t> png) {
  return "data:image/png;base64," + base64(png);
}

}  // namespace sturz
