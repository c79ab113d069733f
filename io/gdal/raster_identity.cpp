// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/raster_identity.hpp"

#include "io/files/sha256.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace sturz {
namespace {

constexpr std::size_t hash_digits = 16;  // 64 bits a block: a change does not hide behind them

/// The part of a block along one axis, in cells of the file.
struct Span {
  int from = 0, end = 0;
  bool whole = true;
};

Span span_of(int block, int window_from, int window_n, int file_n) {
  const int first = block * identity_block, last = std::min(first + identity_block, file_n);
  const Span r{std::max(first, window_from), std::min(last, window_from + window_n), true};
  return {r.from, r.end, r.from == first && r.end == last};
}

std::string part_name(int row, int col, const Span& rows, const Span& cols) {
  std::string name = fmt::format("{}/{}", row, col);
  if (!rows.whole || !cols.whole)
    name +=
        fmt::format(" rows {}-{} columns {}-{}", rows.from, rows.end - 1, cols.from, cols.end - 1);
  return name;
}

/// Reads "12" off the front of a text, and what follows it. False: it does not begin so.
bool take_number(std::string_view& text, int& number, std::string_view then) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!text.starts_with(then)) return false;
  text.remove_prefix(then.size());
  return true;
}

}  // namespace

std::optional<ReadWindow> window_of_part(const std::string& name, int file_cols, int file_rows) {
  std::string_view rest = name;
  int row = 0, col = 0;
  if (!take_number(rest, row, "/") || !take_number(rest, col, "")) return {};
  const auto lies_in = [](int block, int n) {
    return block >= 0 && block <= (n - 1) / identity_block;
  };
  if (!lies_in(row, file_rows) || !lies_in(col, file_cols)) return {};
  Span rows = span_of(row, 0, file_rows, file_rows), cols = span_of(col, 0, file_cols, file_cols);
  if (!rest.empty()) {
    int r0 = 0, r1 = 0, c0 = 0, c1 = 0;
    if (!rest.starts_with(" rows ")) return {};
    rest.remove_prefix(6);
    if (!take_number(rest, r0, "-") || !take_number(rest, r1, " columns ") ||
        !take_number(rest, c0, "-") || !take_number(rest, c1, "") || !rest.empty())
      return {};
    if (r0 < rows.from || r1 < r0 || r1 >= rows.end || c0 < cols.from || c1 < c0 || c1 >= cols.end)
      return {};
    rows = {r0, r1 + 1, false}, cols = {c0, c1 + 1, false};
  }
  return ReadWindow{cols.from, rows.from, cols.end - cols.from, rows.end - rows.from};
}

std::map<std::string, std::string> block_hashes(std::span<const double> values,
                                                const ReadWindow& window, int file_cols,
                                                int file_rows) {
  std::map<std::string, std::string> hashes;
  const auto last_block = [](int from, int n) { return (from + n - 1) / identity_block; };
  for (int br = window.row0 / identity_block; br <= last_block(window.row0, window.n_rows); ++br)
    for (int bc = window.col0 / identity_block; bc <= last_block(window.col0, window.n_cols);
         ++bc) {
      const Span rows = span_of(br, window.row0, window.n_rows, file_rows);
      const Span cols = span_of(bc, window.col0, window.n_cols, file_cols);
      Sha256 hash;
      for (int row = rows.from; row < rows.end; ++row)
        hash.add_values(values.subspan(static_cast<std::size_t>(row - window.row0) * window.n_cols +
                                           static_cast<std::size_t>(cols.from - window.col0),
                                       static_cast<std::size_t>(cols.end - cols.from)));
      hashes[part_name(br, bc, rows, cols)] = hash.hex().substr(0, hash_digits);
    }
  return hashes;
}

std::string raster_shape(int file_cols, int file_rows, const std::array<double, 6>& a,
                         const OGRSpatialReference& crs) {
  return fmt::format("{} x {} cells, corner {} {}, steps {} {} {} {}, {}", file_cols, file_rows,
                     a[0], a[3], a[1], a[2], a[4], a[5], crs_identity(crs));
}

std::string crs_identity(const OGRSpatialReference& crs) {
  if (crs.IsEmpty()) return "no coordinate system";
  if (crs.GetAuthorityCode(nullptr) != nullptr) return crs_name(crs);
  Sha256 hash;
  hash.add_text(crs_wkt2(crs));
  return fmt::format("{} #{}", crs_name(crs), hash.hex().substr(0, 8));
}

}  // namespace sturz
