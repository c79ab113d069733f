// SPDX-License-Identifier: Apache-2.0
/// What a pair sweep leaves for the next one, and where grains lie against the ground.
#pragma once

#include "engine/core/parallel.hpp"
#include "engine/effects/dense/sweep_arrays.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>

namespace sturz {

/// Distances to the ground, and what the last sweep left for this one.
/// \param support  2h [m]
inline void gather_ground(SweepArrays& shared, const MovingSet& p, double support, int threads) {
  const NeighborLists& lists = shared.lists;
  const double unit = lists.view().unit_m;
  const GroundRecord none{static_cast<float>(GroundRecord::far * support / unit), 0};
  auto& ground = shared.ground;
  auto& gradient = shared.density_gradient;
  ground.resize(lists.n_records_rounded());
  gradient.resize(lists.n_records_rounded());
  const auto& weight = p.scalar(fields::ground_weight);
  const auto& g = p.components(fields::density_gradient);
  const float *distance = p.boundary.distance.data(), far = static_cast<float>(support);
  parallel_ranges(p.n_listed, reduction_block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool near = distance[i] < far && p.fate[i] == Fate::stays;
      ground[i] = near ? GroundRecord{static_cast<float>(std::max(0.0f, distance[i]) / unit),
                                      static_cast<float>(weight[i])}
                       : none;
      const double half = 0.5 * unit;
      gradient[i] = {static_cast<float>(half * g[0][i]), static_cast<float>(half * g[1][i]),
                     static_cast<float>(half * g[2][i]), 0};
    }
  });
  for (std::size_t i = p.n_listed; i < lists.padded_size(); ++i) ground[i] = none;
  lists.for_each_image([&](std::size_t image, std::size_t source) {
    ground[image] = ground[source];
    gradient[image] = gradient[source];
  });
}

/// How much of a sweep's density gradient enters that of the next: all at the start, then over
/// 10 h/c0, forty steps or so.
/// \param sound_speed  c0 [m/s] \param h  smoothing length [m]
inline double gradient_share(const State& s, double sound_speed, double h, double dt) {
  const double relaxed = dt * sound_speed / (10 * h);
  return s.n_steps == 0 ? 1 : std::min(1.0, relaxed);
}

/// In fields, which are sorted with the particles. The density gradient follows the sweep's slowly:
/// what diffusion takes off shall be that of weight and slope, not that of sound and of grains that
/// pass each other, which diffusion is there for.
/// \param share  of the new gradient
inline void keep_for_next(const SweepOutput& out, MovingSet& p, std::size_t begin, std::size_t end,
                          double share) {
  end = std::min(end, p.n_listed);
  double* weight = p.scalar(fields::ground_weight).data();
  auto& gradient = p.components(fields::density_gradient);
  std::copy(out.ground_weight + begin, out.ground_weight + end, weight + begin);
  for (int k = 0; k < 3; ++k) {
    double* g = gradient[k].data();
    for (std::size_t i = begin; i < end; ++i) g[i] += share * (out.density_gradient[k][i] - g[i]);
  }
}

}  // namespace sturz
