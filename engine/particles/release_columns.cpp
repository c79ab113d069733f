// SPDX-License-Identifier: Apache-2.0
#include "engine/particles/release_columns.hpp"

#include "engine/core/error.hpp"
#include "engine/core/sum.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double most_columns = 5e8;

/// How one direction of a raster's cells falls on lattice intervals: shares that sum to one.
struct Overlap {
  std::int64_t first = 0;
  std::vector<double> share;

  Overlap(double low, double high, double spacing) {
    first = static_cast<std::int64_t>(std::floor(low / spacing));
    double from = low;
    for (std::int64_t k = first;; ++k) {
      const double to = std::min(high, (k + 1) * spacing);
      share.push_back(std::max(0.0, to - from) / (high - low));
      if (to >= high) break;
      from = to;
    }
  }
  std::int64_t last() const { return first + static_cast<std::int64_t>(share.size()) - 1; }
};

CellExtent survey(const Raster<double>& thickness, ReleaseColumns& out) {
  const Grid& g = thickness.grid;
  CellExtent e{g.n_rows, -1, g.n_cols, -1};
  Sum sum;
  std::size_t n = 0;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const double h = thickness.at(r, c);
      if (!(h > 0)) continue;
      require(std::isfinite(h), "release: the thickness is infinite in row " + std::to_string(r) +
                                    ", column " + std::to_string(c) +
                                    " (a nodata value that was not marked?). Mend the raster.");
      e = {std::min(e.row0, r), std::max(e.row1, r), std::min(e.col0, c), std::max(e.col1, c)};
      out.max_thickness_m = std::max(out.max_thickness_m, h);
      sum.add(h);
      ++n;
    }
  const double cell_area = g.cell_m * g.cell_m;
  out.volume_m3 = sum.value() * cell_area;
  out.area_m2 = static_cast<double>(n) * cell_area;
  return e;
}

}  // namespace

ReleaseColumns release_columns(const Raster<double>& thickness, double spacing_m,
                               const Raster<double>* cover) {
  expect(thickness.values.size() == thickness.grid.n_cells(), "a raster has one value per cell");
  ReleaseColumns out;
  const CellExtent e = out.cells = survey(thickness, out);
  require(out.volume_m3 > 0,
          "release: there is no mass (no cell of the thickness raster is above zero). Check the "
          "polygon or raster, its place and its nodata value.");
  const Grid& g = thickness.grid;
  std::vector<Overlap> across, down;
  for (int c = e.col0; c <= e.col1; ++c)
    across.emplace_back(g.west_m + c * g.cell_m, g.west_m + (c + 1) * g.cell_m, spacing_m);
  for (int r = e.row0; r <= e.row1; ++r)
    down.emplace_back(g.north_m - (r + 1) * g.cell_m, g.north_m - r * g.cell_m, spacing_m);
  const std::int64_t x0 = across.front().first, x1 = across.back().last();
  const std::int64_t y0 = down.back().first, y1 = down.front().last();
  const double n_lattice = double(x1 - x0 + 1) * double(y1 - y0 + 1);
  require(n_lattice < most_columns,
          "release: the spacing of " + std::to_string(spacing_m) +
              " m makes more than 5e8 columns (memory). Is numerics.spacing_m in metres?");

  const std::size_t width = static_cast<std::size_t>(x1 - x0 + 1);
  expect(!cover || cover->values.size() == thickness.values.size(), "cover is on the same grid");
  std::vector<double> volume(static_cast<std::size_t>(n_lattice), 0.0), area = volume;
  const double cell_area = g.cell_m * g.cell_m;
  for (int r = e.row0; r <= e.row1; ++r) {
    const Overlap& oy = down[r - e.row0];
    for (int c = e.col0; c <= e.col1; ++c) {
      const double h = thickness.at(r, c);
      if (!(h > 0)) continue;
      const double covered = cover ? std::clamp(cover->at(r, c), 0.0, 1.0) : 1.0;
      const Overlap& ox = across[c - e.col0];
      for (std::size_t j = 0; j < oy.share.size(); ++j)
        for (std::size_t i = 0; i < ox.share.size(); ++i) {
          const std::size_t k = (y1 - (oy.first + j)) * width + (ox.first - x0 + i);
          volume[k] += h * cell_area * oy.share[j] * ox.share[i];
          area[k] += covered * cell_area * oy.share[j] * ox.share[i];
        }
    }
  }
  const double column_area = spacing_m * spacing_m;
  for (std::size_t k = 0; k < volume.size(); ++k)
    if (volume[k] > 0)
      out.columns.push_back({x0 + static_cast<std::int64_t>(k % width),
                             y1 - static_cast<std::int64_t>(k / width), volume[k] / column_area,
                             std::min(1.0, area[k] / column_area)});
  return out;
}

}  // namespace sturz
