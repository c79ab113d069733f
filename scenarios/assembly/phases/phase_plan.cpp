// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/phases/phase_plan.hpp"

#include "engine/core/constants.hpp"
#include "engine/core/sum.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>

namespace sturz {
namespace {

double released_mass(const MovingSet& p) {
  Sum sum;
  for (const double m : p.mass) sum.add(m);
  return sum.value();
}

}  // namespace

TwoPhaseSettings plan_phases(const Scenario& s, const DepthAveragedSettings& columns,
                             const std::vector<BasalResistance>& bed) {
  const MixtureSpec& wet = *s.mixture;
  const GrainsSpec& grains = *s.grains;
  TwoPhaseSettings out;
  PhaseDrag& drag = out.drag;
  drag.solid_density = grains.density_kg_m3.value;
  drag.fluid_density = wet.fluid_density_kg_m3.value;
  drag.fluid_viscosity = wet.fluid_viscosity_pa_s.value;
  drag.permeability = wet.permeability_m2.value;
  drag.reference_fraction = wet.permeability_fraction.value;
  drag.grain_diameter = grains.diameter_m.value;
  if (wet.drag_law == PhaseDragLaw::settling)
    drag.settling = wet.settling_speed_m_s ? wet.settling_speed_m_s->value
                                           : settling_speed(drag.grain_diameter, drag.solid_density,
                                                            drag.fluid_density,
                                                            drag.fluid_viscosity, standard_gravity);
  // As grains.states has it: poorly sorted grains pack somewhat closer than they were released.
  out.densest_fraction = std::min(0.9, std::max(0.64, grains.solid_fraction.value + 0.08));
  out.grains = columns;
  out.grains.mixture.reset();
  out.grains.internal_friction = 0;
  out.liquid = out.grains;
  out.grains.density = drag.solid_density;
  out.liquid.density = drag.fluid_density;
  out.grains.bed.clear(), out.liquid.bed.clear();
  for (const BasalResistance& b : bed) {
    BasalResistance of_grains;
    of_grains.friction_coefficient = b.friction_coefficient;
    of_grains.cohesion_pa = b.cohesion_pa;
    BasalResistance of_liquid;
    of_liquid.friction_coefficient = 0;
    of_liquid.turbulent_coefficient = b.turbulent_coefficient;
    of_liquid.viscosity_pa_s = drag.fluid_viscosity;
    out.grains.bed.push_back(of_grains);
    out.liquid.bed.push_back(of_liquid);
  }
  return out;
}

void split_phases(State& state, const TwoPhaseSettings& settings, double m) {
  state.sets.push_back(state.sets.front());
  MovingSet &grains = state.sets[0], &liquid = state.sets[1];
  liquid.name = "liquid";
  const PhaseDrag& of = settings.drag;
  const double solid = m * of.solid_density, fluid = (1 - m) * of.fluid_density;
  const double share = solid / (solid + fluid);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    liquid.mass[i] = (1 - share) * grains.mass[i];
    grains.mass[i] = share * grains.mass[i];
  }
  grains.bulk_density = of.solid_density, liquid.bulk_density = of.fluid_density;
  for (MovingSet* set : {&grains, &liquid}) {
    set->reference_fraction = 1;
    set->ledger.released_mass = released_mass(*set);
  }
}

std::vector<double> thickness_of(const Release& release, double share) {
  std::vector<double> out = release.thickness;
  for (double& h : out) h *= share;
  return out;
}

std::string drag_text(const Scenario& s, const TwoPhaseSettings& settings, double thickness_m) {
  const PhaseDrag& drag = settings.drag;
  const double m = s.grains->solid_fraction.value;
  const double mass_ratio = m * drag.solid_density / ((1 - m) * drag.fluid_density);
  const double rate = drag.rate(m, standard_gravity) * (1 + mass_ratio);
  const std::string law =
      drag.settling > 0
          ? "`mixture.drag_law: settling`, one grain settles at " + short_number(drag.settling) +
                " m/s"
          : "`mixture.phases: two`, permeability_m2 " + short_number(drag.permeability);
  return law + ": slip dies out within " + short_number(1 / rate) + " s; it is held below " +
         short_number(drag.largest_slip(m, standard_gravity * thickness_m)) +
         " m/s where the mass is as thick as at release";
}

}  // namespace sturz
