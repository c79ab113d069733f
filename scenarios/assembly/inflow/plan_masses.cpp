// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/inflow/plan_masses.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "scenarios/placement_seed.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// Of what the mass can reach, whatever part of the raster is held [m].
double lowest_ground(const SceneInputs& in) {
  if (in.reach) return in.reach->lowest_m;
  double lowest = 1e300;
  for (double z : in.elevation->values)
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  return lowest;
}

double released_energy(const Scenario& s, const Release& release, double lowest_m) {
  const auto& v0 = s.release.velocity_m_s;
  const double start = std::sqrt(v0[0] * v0[0] + v0[1] * v0[1] + v0[2] * v0[2]);
  double mass = 0, height = 0;
  for (std::size_t i = 0; i < release.x.size(); ++i) {
    mass += release.mass[i];
    height += release.mass[i] * release.z[i];
  }
  return standard_gravity * (height - mass * lowest_m) + 0.5 * mass * start * start;
}

}  // namespace

void plan_masses(const Scenario& s, const SceneInputs& in, const Raster<double>& thickness,
                 std::int64_t member, const std::function<double(double)>& density,
                 ScenePlan& plan) {
  StaggeredRelease starts =
      staggered_release(s, in, plan.bed, thickness,
                        {s.numerics.spacing_m, plan.bulk_density_kg_m3, s.numerics.jitter,
                         placement_seed(s), member, plan.formulation.depth_averaged});
  expect(starts.n_later() == 0 || plan.formulation.depth_averaged, "only columns start later");
  plan.later = later_columns(starts, s, plan.bed);
  plan.n_present = starts.n_present;
  plan.release_start_s = std::move(starts.start_s);
  plan.release = std::move(starts.all);
  if (in.inflow.empty()) return;
  expect(plan.formulation.depth_averaged, "only columns enter over time");
  plan.inflow = plan_inflow(
      s, in, plan.bed,
      [&](double m) { return std::isnan(m) ? plan.bulk_density_kg_m3 : density(m); }, member);
}

void plan_end(const Scenario& s, const SceneInputs& in, ScenePlan& plan) {
  const double thickness = std::max(plan.release.median_thickness_m, plan.inflow.most_thickness_m);
  plan.end = time_cap(s, in, thickness, plan.bulk_density_kg_m3);
  const double last =
      std::max(plan.inflow.last_s, plan.later.empty() ? 0 : plan.later.back().time_s);
  if (s.numerics.end_time_s || !(last > 0)) return;
  plan.end.end_time_s = std::ceil(plan.end.end_time_s + last);
  plan.end.reason +=
      ", counted from the last mass that starts or enters, at " + short_number(last) + " s";
}

double available_energy(const Scenario& s, const SceneInputs& in, const ScenePlan& plan) {
  const double lowest = lowest_ground(in);
  return released_energy(s, plan.release, lowest) + available_energy(plan.inflow, lowest);
}

}  // namespace sturz
