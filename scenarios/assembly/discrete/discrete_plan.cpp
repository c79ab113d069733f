// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/discrete/discrete_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/assembly/speed/expected_speed.hpp"
#include "scenarios/placement_seed.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

/// A grain with its pairs takes about 2.5 kB.
constexpr double most_grains = 1e7;

DiscreteSpec spec_of(const Scenario& s) { return s.grains->discrete.value_or(DiscreteSpec{}); }

double diameter(const Scenario& s) {
  return spec_of(s).diameter_m.value_or(s.grains->diameter_m).value;
}

}  // namespace

Scenario with_grain_spacing(const Scenario& numbers) {
  if (numbers.formulation != Formulation::discrete || !numbers.grains) return numbers;
  Scenario s = numbers;
  const double volume = std::numbers::pi / 6 * std::pow(diameter(s), 3);
  s.numerics.spacing_m = std::cbrt(volume / s.grains->solid_fraction.value);
  return s;
}

void scale_grains(Scenario& numbers, double factor) {
  if (numbers.formulation != Formulation::discrete || !numbers.grains) return;
  const double scaled = factor * diameter(numbers);
  numbers.grains->discrete = spec_of(numbers);
  numbers.grains->discrete->diameter_m = Uncertain(scaled);
}

GrainPacking grain_packing(const Scenario& s, std::int64_t member) {
  GrainPacking packing;
  packing.diameter_m = diameter(s);
  packing.density_kg_m3 = s.grains->density_kg_m3.value;
  packing.solid_fraction = s.grains->solid_fraction.value;
  packing.size_spread = spec_of(s).size_spread;
  packing.jitter = s.numerics.jitter;
  packing.seed = placement_seed(s);
  packing.member = member;
  return packing;
}

void require_countable_grains(const Scenario& s, const Raster<double>& thickness) {
  double sum = 0;
  for (const double h : thickness.values)
    if (h > 0) sum += h;
  const double volume = sum * thickness.grid.cell_m * thickness.grid.cell_m;
  const double n = grains_in(volume, grain_packing(s, 0));
  require(n <= most_grains, "grains.discrete.diameter_m = " + short_number(diameter(s)) +
                                " (the release holds " + short_number(n) +
                                " such grains, more than 1e7). Use larger grains, " +
                                short_number(diameter(s) * std::cbrt(n / 1e5)) +
                                " m for a hundred thousand, or formulation: depth_averaged.");
}

void plan_discrete(const Scenario& s, std::vector<BasalResistance> bed, ScenePlan& plan) {
  const DiscreteSpec spec = spec_of(s);
  DiscreteSettings& c = plan.discrete.emplace();
  c.diameter = diameter(s);
  GrainMaterial rock;
  rock.youngs_modulus = spec.youngs_modulus_pa;
  rock.poisson_ratio = s.grains->poisson_ratio.value;
  rock.density = s.grains->density_kg_m3.value;
  const double load = plan.bulk_density_kg_m3 * standard_gravity * plan.release.max_thickness_m;
  c.material = softened_grains(rock, std::max(plan.reference_speed_m_s, start_speed(s)), load,
                               spec.greatest_overlap);
  c.restitution = spec.restitution.value;
  c.friction = spec.friction_coefficient.value;
  c.rolling_friction = spec.rolling_friction.value;
  c.bed_restitution = s.basal.restitution.value;
  if (spec.bed_rolling_friction) c.bed_rolling_friction = spec.bed_rolling_friction->value;
  c.bed = std::move(bed);
  c.zones = plan.zones;
  c.rasters = plan.rasters;
  // The look-up of the ground: closest points within the largest radius, and all that may touch.
  plan.contact.spacing = 1.4 * c.diameter;
  plan.contact.smoothing_length = 0.7 * c.diameter;
}

std::string discrete_text(const Scenario& s, const ScenePlan& plan) {
  const DiscreteSpec spec = spec_of(s);
  const DiscreteSettings& c = *plan.discrete;
  const double fill = std::min(s.grains->solid_fraction.value, densest_fill);
  return "`formulation: discrete`: " + std::to_string(plan.release.x.size()) + " grains of " +
         short_number(c.diameter) + " m +- " + short_number(100 * spec.size_spread) +
         " %, set down at a fill of " + short_number(fill) + "; friction " +
         short_number(c.friction) + ", rolling " + short_number(c.rolling_friction) +
         ", restitution " + short_number(c.restitution) + "; E " +
         short_number(c.material.youngs_modulus) + " Pa of " +
         short_number(spec.youngs_modulus_pa) + ", so that an impact at " +
         short_number(plan.reference_speed_m_s) + " m/s overlaps by " +
         short_number(100 * spec.greatest_overlap) + " % of a radius at most";
}

}  // namespace sturz
