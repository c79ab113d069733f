// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/reference/sweep_alone.hpp"

#include "engine/effects/fields.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"
#include "tests/bench/measure/clocks.hpp"

#include <algorithm>

namespace sturz::bench {

SweepAlone::SweepAlone(const SimulationParts& parts, const ScenePlan& plan, InstructionSet isa)
    : set_of_instructions_(isa),
      set_(parts.state.grains()),
      lists_(2 * plan.stress.smoothing_length, plan.stress.skin * plan.stress.smoothing_length,
             sweeps(isa).tight_list) {
  const GrainStressSettings& g = plan.stress;
  constants_ = {g.smoothing_length,
                SmoothingKernel{g.smoothing_length}.discrete_gradient_factor(),
                g.reference_density,
                g.sound_speed,
                g.viscosity,
                g.density_diffusion,
                0};
  lists_.rebuild(set_, parts.state.domain, 1);
  gather_records(g);
  for (auto& r : results_) r.assign(lists_.padded_size(), 0);
  zeros_.assign(lists_.padded_size(), 0);
  const double far = GroundRecord::far * 2 * g.smoothing_length / lists_.view().unit_m;
  far_.assign(lists_.n_records_rounded(), {static_cast<float>(far), 0});
  density_gradient_.assign(lists_.n_records_rounded(), {});
  n_pairs_ = count_pairs();
}

void SweepAlone::gather_records(const GrainStressSettings& g) {
  lists_.gather_positions(set_, 0, set_.size());
  const auto& density_change = set_.scalar(fields::density_change);
  const auto& stress = set_.components(fields::stress);
  auto f = [](double v) { return static_cast<float>(v); };
  for (std::size_t i = 0; i < set_.size(); ++i) {
    NeighborRecord& r = lists_.records()[i];
    const double e = std::max(density_change[i], GrainStressSettings::separation_threshold);
    r.volume = f(set_.mass[i] / (g.reference_density * (1 + e)));
    r.vx = f(set_.vx[i]), r.vy = f(set_.vy[i]), r.vz = f(set_.vz[i]);
    r.density_change = f(e);
    r.sxx = f(stress[0][i]), r.syy = f(stress[1][i]), r.szz = f(stress[2][i]);
    r.sxy = f(stress[3][i]), r.syz = f(stress[4][i]), r.szx = f(stress[5][i]);
  }
  lists_.copy_images();
}

std::size_t SweepAlone::count_pairs() const {
  const NeighborView view = lists_.view();
  const double support = 2 * constants_.h / view.unit_m;
  std::size_t n = 0;
  for (std::size_t i = 0; i < view.n_particles; ++i) {
    const NeighborRecord& a = view.records[i];
    const std::size_t group = i / group_size;
    const std::uint32_t* list = view.list(group);
    for (std::size_t k = 0; k < view.list_size(group); ++k) {
      const NeighborRecord& b = view.records[list[k]];
      const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
      n += list[k] != i && x * x + y * y + z * z < support * support;
    }
  }
  return n;
}

SweepOutput SweepAlone::output() {
  SweepOutput o{};
  float** slots[] = {&o.ax,  &o.ay,  &o.az,  &o.lxx, &o.lxy, &o.lxz,      &o.lyx,
                     &o.lyy, &o.lyz, &o.lzx, &o.lzy, &o.lzz, &o.diffusion};
  for (int k = 0; k < 13; ++k) *slots[k] = results_[k].data();
  for (int k = 0; k < 6; ++k) o.smooth[k] = results_[13 + k].data();
  for (int k = 0; k < 3; ++k) o.density_gradient[k] = results_[19 + k].data();
  o.ground_weight = results_[22].data();
  return o;
}

double SweepAlone::run() {
  const float* zero = zeros_.data();
  const BoundaryView wall{far_.data(), zero, zero, zero, {}, {}};
  NeighborView view = lists_.view();
  view.density_gradient = density_gradient_.data();
  const SweepOutput out = output();
  return timed(thread_seconds, [&] {
    sweeps(set_of_instructions_).dense(view, constants_, wall, out, 0, lists_.n_groups());
  });
}

}  // namespace sturz::bench
