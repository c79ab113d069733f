// SPDX-License-Identifier: Apache-2.0
/// Peak maps of one instant, and their values by cell of the whole grid.
#pragma once

#include "engine/simulation/peak_maps.hpp"

#include <numeric>
#include <vector>

namespace sturz::test {

inline double sum_of(const std::vector<float>& layer) {
  return std::accumulate(layer.begin(), layer.end(), 0.0);
}

inline float at(const MemberResult& r, PeakLayer layer, int row, int col) {
  row -= r.window.row0, col -= r.window.col0;
  if (row < 0 || col < 0 || row >= r.window.n_rows || col >= r.window.n_cols)
    return info(layer).untouched;
  return r.layer(layer)[static_cast<std::size_t>(row) * r.window.n_cols + col];
}

/// The maps of a flow that was looked at once.
inline MemberResult maps_of(const PeakMapSettings& s, const ParticleSet& p) {
  PeakMaps maps(s);
  maps.record(p, 0);
  MemberResult r;
  maps.finish(p, r);
  return r;
}

}  // namespace sturz::test
