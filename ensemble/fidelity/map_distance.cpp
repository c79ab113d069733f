// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/map_distance.hpp"

#include "engine/core/error.hpp"
#include "ensemble/scores/boundary_distance.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

std::vector<Segment> outline_of(const Raster<double>& probability) {
  Raster<std::uint8_t> likely(probability.grid, 0);
  for (std::size_t i = 0; i < likely.values.size(); ++i)
    likely.values[i] = probability.values[i] >= 0.5;
  return outer_boundary(likely);
}

}  // namespace

Raster<double> share_thicker(const MemberParts& source, const std::vector<std::int64_t>& numbers,
                             const Window& extent, double threshold_m, CancelFlag cancel) {
  const Grid grid = grid_of(extent, source.grid());
  Raster<double> share(grid, 0);
  const auto n = static_cast<double>(numbers.size());
  std::vector<float> values;
  for (std::size_t i = 0; i < source.members().size(); ++i) {
    const MemberSummary& m = source.members()[i];
    if (!std::binary_search(numbers.begin(), numbers.end(), m.member)) continue;
    cancel.check();
    const Window part = overlap(m.window, extent);
    values.resize(part.n_cells());
    if (values.empty()) continue;
    source.read_part(i, PeakLayer::thickness, part, values);
    for (int row = 0; row < part.n_rows; ++row)
      for (int col = 0; col < part.n_cols; ++col)
        if (values[static_cast<std::size_t>(row) * part.n_cols + col] > threshold_m)
          share.values[grid.index(part.row0 + row - extent.row0, part.col0 + col - extent.col0)] +=
              1 / n;
  }
  return share;
}

MapDistance map_distance(const Raster<double>& p, const Raster<double>& q) {
  expect(p.grid.same_place(q.grid), "maps of one grid");
  MapDistance d;
  const double cell = p.grid.cell_m * p.grid.cell_m;
  for (std::size_t i = 0; i < p.values.size(); ++i) {
    const double off = std::abs(p.values[i] - q.values[i]);
    d.area_between_m2 += off * cell;
    d.mean_area_m2 += q.values[i] * cell;
    d.worst_cell = std::max(d.worst_cell, off);
  }
  const SegmentIndex a(outline_of(p), p.grid.cell_m), b(outline_of(q), p.grid.cell_m);
  if (!a.empty() && !b.empty())
    d.boundary_m = boundary_distance(a, b, p.grid.cell_m, p.grid.cell_m).mean_m;
  return d;
}

}  // namespace sturz
