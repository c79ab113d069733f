// SPDX-License-Identifier: Apache-2.0
/// Maps by year, from several ensembles of one site of which each comes with its own frequency.
///
/// Rules, also written into the layers' comments:
///   rate         sum over scenarios of frequency x members / valid members of it
///   return level the largest peak of a member that is reached or exceeded at least once in T years
///                on average (see return_level.hpp); of members that reached the cell, 0 where
///                fewer do; the smoothing's tail beyond the last column counts nowhere
///   intensity    3 strong: peak thickness and peak speed of one member beyond their thresholds
///                (they need not coincide), 2 medium: reached otherwise, 0 none; at least once in T
///                years. A debris flow has no weak intensity
///   matrix field 3 x (intensity - 1) + probability, 1 low, 2 medium, 3 high; 0 where there is
///                neither. Which field has which colour is the authority's to say
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "ensemble/members/joined_members.hpp"
#include "ensemble/risk/return_level.hpp"
#include "scenarios/layers/layer_stream.hpp"
#include "scenarios/risk/risk_spec.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

struct RateContext {
  const Raster<double>* ground = nullptr;  ///< elevations; null: the ground is known everywhere
  Grid whole_ground;                       ///< of which `ground` is a window; empty: it is all
  std::vector<std::pair<std::string, std::string>> attributes;  ///< global ones
  std::size_t memory_bytes = MemberCells::default_memory_bytes;
  CancelFlag cancel;
};

/// Frequency and valid members of each scenario. \pre as many scenarios as ensembles
std::vector<ScenarioRate> scenario_rates(const RiskSpec&, const JoinedMembers&);

/// Class of a return period: 3 high, 2 medium, 1 low, 0 rarer than all classes.
int probability_class(const RiskSpec&, double period_years);

/// Makes the layers on the members' grid, cropped to map_extent, and hands them to `to` in blocks:
///   annual_rate [year-1], ..._standard_error
///   annual_rate_of_high_intensity [year-1]
///   X_return_level [return_period][y][x] for X in thickness [m], speed [m s-1], energy [kJ m-2],
///     pressure [kPa]
///   intensity_class [return_period][y][x], matrix_field [return_period][y][x],
///   highest_matrix_field
/// NaN where the ground is not known. The axis is in years.
/// \pre every scenario has a valid member \throws SetupError, Cancelled as make_hazard_map()
void make_rate_maps(const JoinedMembers&, const RiskSpec&, const RateContext&, LayerSink& to);

}  // namespace sturz
