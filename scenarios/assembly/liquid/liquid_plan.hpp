// SPDX-License-Identifier: Apache-2.0
/// A liquid in three dimensions, alone or among grains: its numbers, its release, its words.
#pragma once

#include "engine/effects/bed/effect.hpp"
#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/dilatancy/settings.hpp"
#include "engine/effects/liquid/settings.hpp"
#include "engine/effects/state.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

struct ScenePlan;

/// Friction of a liquid where a bound needs one and its yield stress gives less: on gentler slopes
/// only viscosity and yield stress decide where it stops [-].
inline constexpr double liquid_friction = 0.05;

/// A liquid without grains.
bool is_liquid_alone(const Scenario&);
/// Drag and buoyancy, not the paper's drag alone.
bool has_buoyancy(const Scenario&);
/// Index of the liquid in State::sets.
std::size_t liquid_set(const Scenario&);

/// Share of the bulk volume that the liquid fills at the start: all of it without grains.
double liquid_share(const Scenario& numbers);
/// Mass over bulk volume of grains and liquid as they are set down [kg/m^3].
double wet_bulk_density(const Scenario& numbers);
/// Share of the release's height that stands in liquid: its saturation; all of it in a pool, at the
/// latest when it lies there.
double filled_height(const Scenario& numbers);
/// Share of the grains' own weight that their contacts bear at the bed; less than 1 as far as the
/// liquid, whose pressure is hydrostatic below its surface, stands in the pores and lifts them.
double weight_on_contacts(const Scenario& numbers);
/// Share of the weight of grains and liquid together that rests on grains; not of a liquid alone.
double weight_on_grains(const Scenario& numbers);

/// Viscosity by itself, or K of Herschel and Bulkley's law: what grains feel [Pa s].
double plain_viscosity(const FluidSpec&);
HerschelBulkley liquid_law(const FluidSpec&);

/// Of a plan whose release, expected speed and contact are known.
LiquidSettings plan_liquid(const Scenario& numbers, const ScenePlan&);
CouplingSettings plan_coupling(const Scenario& numbers);
/// Absent: packings only change under load.
std::optional<DilatancySettings> plan_dilatancy(const Scenario& numbers);
/// For `describe`.
std::string dilatancy_text(const Scenario& numbers);
/// What the bed does to the liquid, decided where the scene leaves it to the program.
FluidBed liquid_bed(const Scenario& numbers, const FormulationChoice&);
/// The ground as the liquid meets it: no friction of grains.
ContactSettings liquid_contact(const Scenario& numbers, const ScenePlan&);
/// For `describe`: "no_slip (auto: 12 layers)".
std::string liquid_bed_text(const Scenario& numbers, const FormulationChoice&);

/// Leaves the grains of the released mass in set 0 and puts the liquid into set 1; into set 0 where
/// there are no grains.
void lay_liquid(State&, const Scenario& numbers, const ScenePlan&);

/// Adds fields, ground, walls and stress of the liquid to the step.
struct SceneParts;
void add_liquid_parts(SceneParts&);

std::string liquid_text(const Scenario& numbers, const ScenePlan&);
std::string coupling_text(const Scenario& numbers, const ScenePlan&);
/// What a reader of the results has to know of liquid and drag.
std::vector<std::string> liquid_warnings(const Scenario& numbers, const ScenePlan&);

}  // namespace sturz
