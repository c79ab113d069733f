// SPDX-License-Identifier: Apache-2.0
/// What a set has that takes part in the pair sweep, whatever its stress follows: lists, what the
/// sweep reads besides its records, and what it leaves.
#pragma once

#include "engine/effects/motion/wrapping.hpp"
#include "engine/effects/state.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "engine/neighbors/neighbor_lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sturz {

struct SweepArrays {
  std::size_t set;  ///< index in State::sets
  NeighborLists lists;
  /// Velocity gradient, density diffusion, density gradient, weight of the image in the ground.
  std::vector<float> results[14];
  std::vector<GroundRecord> ground;  // by record
  std::vector<HalfDensityGradient> density_gradient;

  /// \param h  smoothing length [m] \param skin  in smoothing lengths
  SweepArrays(std::size_t set_index, double h, double skin, InstructionSet instructions)
      : set(set_index), lists(2 * h, skin * h, sweeps(instructions).tight_list) {}

  /// Without accelerations and the walls' mirror weights, which live in the state.
  SweepOutput output() {
    SweepOutput out{};
    float** slots[] = {&out.lxx,
                       &out.lxy,
                       &out.lxz,
                       &out.lyx,
                       &out.lyy,
                       &out.lyz,
                       &out.lzx,
                       &out.lzy,
                       &out.lzz,
                       &out.diffusion,
                       &out.density_gradient[0],
                       &out.density_gradient[1],
                       &out.density_gradient[2],
                       &out.ground_weight};
    for (int k = 0; k < 14; ++k) *slots[k] = results[k].data();
    return out;
  }
  /// The same, and accelerations and mirror weights of the set.
  SweepOutput output(MovingSet& p) {
    SweepOutput out = output();
    join_state(out, p);
    return out;
  }
  static void join_state(SweepOutput& out, MovingSet& p) {
    out.ax = p.ax.data(), out.ay = p.ay.data(), out.az = p.az.data();
    for (int k = 0; k < 3; ++k) out.from_ground[k] = p.boundary.from_ground[k].data();
    out.mirror_weight = p.boundary.mirror_weight.data();
  }

  NeighborView view() const {
    NeighborView v = lists.view();
    v.density_gradient = density_gradient.data();
    return v;
  }
  BoundaryView boundary(const Domain& domain, const MovingSet& p) const {
    const BoundarySupport& b = p.boundary;
    BoundaryView v{ground.data(), b.nx.data(), b.ny.data(), b.nz.data(), {}, {}};
    for (int c = 0; c < 6 && !domain.walls.empty(); ++c) {
      v.moment[c] = b.moment[c].data();
      v.gradient[c] = b.gradient[c].data();
    }
    return v;
  }

  /// Whether particles moved so far, or their order changed, that lists must be made again. To be
  /// asked once a step.
  bool outdated(const State& s, MovingSet& p) {
    const double* range = p.motion.velocity_range;
    lists.add_relative_motion(
        s.previous_dt * std::sqrt(range[0] * range[0] + range[1] * range[1] + range[2] * range[2]));
    if (p.order_changed) lists.invalidate();
    p.order_changed = false;
    return lists.needs_rebuild();
  }
  /// For whole groups, because the sweep reads lanes.
  void make_room(MovingSet& p) {
    const std::size_t padded = lists.padded_size();
    for (auto& r : results) r.resize(padded);
    const std::size_t all = std::max(padded, p.size());
    for (auto* a : {&p.ax, &p.ay, &p.az, &p.boundary.mirror_weight}) a->resize(all);
    for (auto& a : p.boundary.from_ground) a.resize(all);
  }
  std::size_t bytes() const {
    std::size_t sum = ground.capacity() * sizeof(GroundRecord) +
                      density_gradient.capacity() * sizeof(HalfDensityGradient);
    for (const auto& r : results) sum += r.capacity() * sizeof(float);
    return sum;
  }
};

}  // namespace sturz
