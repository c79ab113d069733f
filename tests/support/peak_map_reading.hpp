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

/// What one particle set is recorded with.
struct OneSet {
  Grid grid;
  double spacing_m = 1, bulk_density_kg_m3 = 1, runout_limit_m = 0.05;
};

/// Peak maps of a single set of plain particles.
class OneSetMaps {
 public:
  explicit OneSetMaps(const OneSet& s) : one_(s), maps_({s.grid, s.runout_limit_m}) {}

  void record(const ParticleSet& p, double time_s) {
    const MovingSet set = moving(p);
    maps_.record({&set, 1}, time_s);
  }
  void finish(const ParticleSet& p, MemberResult& result) {
    const MovingSet set = moving(p);
    maps_.finish({&set, 1}, result);
  }
  const LayerCount& layers() const { return maps_.layers(); }

 private:
  MovingSet moving(const ParticleSet& p) const {
    MovingSet set;
    static_cast<ParticleSet&>(set) = p;
    set.spacing = one_.spacing_m;
    set.bulk_density = one_.bulk_density_kg_m3;
    return set;
  }

  OneSet one_;
  PeakMaps maps_;
};

/// The maps of a flow that was looked at once.
inline MemberResult maps_of(const OneSet& s, const ParticleSet& p) {
  OneSetMaps maps(s);
  maps.record(p, 0);
  MemberResult r;
  maps.finish(p, r);
  return r;
}

}  // namespace sturz::test
