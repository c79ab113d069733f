// SPDX-License-Identifier: Apache-2.0
/// The loops over groups, compiled once per instruction set (see engine/core/lanes.hpp).
#pragma once

#include "engine/effects/sweep/finish.hpp"
#include "engine/effects/sweep/no_slip_sums.hpp"

namespace sturz::STURZ_ISA {

/// \tparam completeness  whether SweepOutput::support_completeness is wanted
/// \tparam tension  whether artificial stress acts
template <bool smooth, bool completeness, bool tension>
inline void dense_group(const NeighborView& view, const DenseScale& scale, const BoundaryView& wall,
                        const SweepOutput& out, std::size_t group) {
  const std::size_t first = group * group_size;
  const GroupRows rows(view.records + first);
  const GroundRows ground(wall.ground + first);
  const std::uint32_t* begin = view.list(group);
  const std::uint32_t* end = begin + view.list_size(group);
  for (int lane = 0; lane < group_size; lane += Lanes::width) {
    const DenseSelf self = self_of(rows, lane);
    DenseSums sums;
    sums.clear();
    RatioSums ratio;
    if constexpr (smooth) ratio.clear();
    TensionSums pull;
    if constexpr (tension) pull.clear();
    const Lanes half = Lanes::all(0.5f * scale.viscosity);
    const Lanes own = half * Lanes::load(rows.viscosity + lane);
    for (const std::uint32_t* j = begin; j != end; ++j) {
      const Lanes viscosity = fma(half, Lanes::all(view.records[*j].viscosity), own);
      const Lanes w = sums.add(self, view.records[*j], view.density_gradient[*j], scale, viscosity);
      if constexpr (smooth) ratio.add(view.records[*j], scale, w);
      if constexpr (tension) pull.add(self, view.records[*j], scale, w);
    }
    ImageSums images;
    const bool near = ground.least < scale.support;
    if (near && wall.no_slip)
      images = no_slip_sums(view, group, rows, ground, lane, scale, wall, own);
    else if (near)
      images = image_sums(view, group, rows, ground, lane, scale, wall, own,
                          [&](std::uint32_t j) { return view.records[j].viscosity; });
    const Lanes mirror_trace =
        finish_dense<false>(sums, near ? &images : nullptr, rows, lane, scale, view, wall, out,
                            first + lane, Lanes::all(1));
    if constexpr (completeness)
      support_completeness(sums, scale, mirror_trace)
          .store(out.support_completeness + first + lane);
    if constexpr (tension) finish_tension(pull, rows, lane, scale, out, first + lane);
    if constexpr (smooth) finish_ratio(ratio, rows, lane, scale, out, first + lane);
  }
}

/// The loop with the terms of this step.
template <bool completeness>
inline auto pick_dense(const SweepConstants& c) {
  if (c.stress_smoothing > 0)
    return c.tension ? &dense_group<true, completeness, true>
                     : &dense_group<true, completeness, false>;
  return c.tension ? &dense_group<false, completeness, true>
                   : &dense_group<false, completeness, false>;
}

inline void dense_sweep(const NeighborView& view, const SweepConstants& constants,
                        const BoundaryView& wall, const SweepOutput& out, std::size_t first_group,
                        std::size_t last_group) {
  const DenseScale scale = dense_scale(constants, view.unit_m);
  const auto group = pick_dense<false>(constants);
  for (std::size_t g = first_group; g < last_group; ++g) group(view, scale, wall, out, g);
}

/// A group in which some grain is dispersed, or a neighbour is.
template <bool smooth, bool tension>
inline void kinetic_group(const NeighborView& view, const KineticView& dispersed,
                          const DenseScale& scale, const BoundaryView& wall, const SweepOutput& out,
                          std::size_t group) {
  const std::size_t first = group * group_size;
  const GroupRows rows(view.records + first);
  const GroundRows ground(wall.ground + first);
  const KineticRows own(dispersed.records + first);
  const std::uint32_t* begin = view.list(group);
  const std::uint32_t* end = begin + view.list_size(group);
  for (int lane = 0; lane < group_size; lane += Lanes::width) {
    const DenseSelf self = self_of(rows, lane);
    const KineticSelf kinetic{Lanes::load(own.theta + lane), Lanes::load(own.resistance + lane),
                              Lanes::load(own.viscosity + lane)};
    DenseSums sums;
    sums.clear();
    KineticSums more;
    more.clear();
    RatioSums ratio;
    if constexpr (smooth) ratio.clear();
    TensionSums pull;
    if constexpr (tension) pull.clear();
    const Lanes half = Lanes::all(0.5f * scale.viscosity), mine = half * kinetic.viscosity;
    for (const std::uint32_t* j = begin; j != end; ++j) {
      const KineticRecord& k = dispersed.records[*j];
      const Lanes viscosity = fma(half, Lanes::all(k.viscosity), mine);
      const Lanes w = sums.add(self, view.records[*j], view.density_gradient[*j], scale, viscosity);
      more.add(self, kinetic, view.records[*j], k, w);
      if constexpr (smooth) ratio.add(view.records[*j], scale, w);
      if constexpr (tension) pull.add(self, view.records[*j], scale, w);
    }
    ImageSums images;
    const bool near = ground.least < scale.support;
    if (near)
      images = image_sums(view, group, rows, ground, lane, scale, wall, mine,
                          [&](std::uint32_t j) { return dispersed.records[j].viscosity; });
    const std::size_t at = first + lane;
    const Lanes mirror_trace =
        finish_dense<true>(sums, near ? &images : nullptr, rows, lane, scale, view, wall, out, at,
                           Lanes::load(own.dilation_ratio + lane));
    finish_kinetic(more, sums, rows, own, lane, scale, mirror_trace, out, at);
    if constexpr (tension) finish_tension(pull, rows, lane, scale, out, at);
    if constexpr (smooth) finish_ratio(ratio, rows, lane, scale, out, at);
  }
}

inline auto pick_kinetic(const SweepConstants& c) {
  if (c.stress_smoothing > 0)
    return c.tension ? &kinetic_group<true, true> : &kinetic_group<true, false>;
  return c.tension ? &kinetic_group<false, true> : &kinetic_group<false, false>;
}

/// Whether no grain in the group or near it is dispersed.
inline bool dense_around(const NeighborView& view, const KineticView& dispersed,
                         std::size_t group) {
  const std::uint32_t* list = view.list(group);
  const std::size_t n = view.list_size(group);
  unsigned dense_group = dispersed.dense_group[group];
  for (std::size_t k = 0; k < n; ++k) dense_group &= dispersed.dense_group[list[k] / group_size];
  return dense_group != 0;
}

/// What a dense group has in the outputs that only the kinetic sums write. Its neighbours are not
/// counted: a grain that has lost them shows by its support completeness first.
inline void write_dense_group(const SweepOutput& out, std::size_t group) {
  for (std::size_t i = group * group_size; i < (group + 1) * group_size; ++i) {
    out.neighbors[i] = SweepOutput::uncounted;
    out.conducted[i] = 0;
    for (float* column : out.pair_gradient) column[i] = 0;
  }
}

inline void kinetic_sweep(const NeighborView& view, const KineticView& dispersed,
                          const SweepConstants& constants, const BoundaryView& wall,
                          const SweepOutput& out, std::size_t first_group, std::size_t last_group) {
  const DenseScale scale = dense_scale(constants, view.unit_m);
  const auto dense = pick_dense<true>(constants);
  const auto kinetic = pick_kinetic(constants);
  bool in_dispersed = false;
  std::int64_t since = 0;
  const auto turn = [&](bool to_dispersed) {  // the clock is read where the kind of group changes
    if (!dispersed.clock || in_dispersed == to_dispersed) return;
    const std::int64_t now = dispersed.clock->now_ns();
    if (in_dispersed) dispersed.clock->spent_ns += now - since;
    since = now;
    in_dispersed = to_dispersed;
  };
  for (std::size_t g = first_group; g < last_group; ++g) {
    const bool is_dense = dense_around(view, dispersed, g);
    turn(!is_dense);
    if (is_dense) {
      dense(view, scale, wall, out, g);
      write_dense_group(out, g);
    } else {
      kinetic(view, dispersed, scale, wall, out, g);
    }
  }
  turn(false);
}

inline std::size_t tight_list(const NeighborRecord* records, std::size_t first, int n_in_group,
                              const std::uint32_t* candidates, std::size_t n_candidates,
                              float radius_units, std::uint32_t* out) {
  alignas(64) std::int32_t x[group_size], y[group_size], z[group_size];
  for (int k = 0; k < group_size; ++k) {
    const NeighborRecord& p = records[first + (k < n_in_group ? k : 0)];
    x[k] = p.x, y[k] = p.y, z[k] = p.z;
  }
  const Lanes radius2 = Lanes::all(radius_units * radius_units);
  std::size_t n = 0;
  for (std::size_t c = 0; c < n_candidates; ++c) {
    const NeighborRecord& j = records[candidates[c]];
    bool near = false;
    for (int lane = 0; lane < group_size && !near; lane += Lanes::width) {
      const Lanes rx = difference(IntLanes::load(x + lane), j.x);
      const Lanes ry = difference(IntLanes::load(y + lane), j.y);
      const Lanes rz = difference(IntLanes::load(z + lane), j.z);
      near = any_less(fma(rx, rx, fma(ry, ry, rz * rz)), radius2);
    }
    out[n] = candidates[c];
    n += near;
  }
  return n;
}

}  // namespace sturz::STURZ_ISA
