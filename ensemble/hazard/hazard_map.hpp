// SPDX-License-Identifier: Apache-2.0
/// From finished members to hazard maps.
///
/// Rules, also written into the layers' comments:
///   members      settled, out_of_time and left_terrain count; diverged, failed and cancelled do
///                not, and are named in the attributes
///   probability  members above the threshold / valid members; `above` is strict
///   bounds       95 % Wilson interval of that probability
///   quantiles    over all valid members, with 0 where a member did not come; linear between
///                order statistics (definition 7 of Hyndman & Fan 1996, the default of numpy)
///   arrival      quantiles over the members that reached the cell only; NaN where none did
///   intensity    Swiss classes of debris flow, from each member's own peaks: high = peak
///                thickness > 1 m and peak speed > 1 m/s, medium = reached but not high. The two
///                peaks need not coincide in time, so high errs on the safe side.
/// Every number is a function of the set of members: order, shards and tile size leave no trace.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "scenarios/layers/layer_stack.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What the maps need to know besides the members.
struct HazardContext {
  double spacing_m = 0;        ///< particle spacing: thickness below half of it is
                               ///< not resolved; 0 = not known
  std::int64_t n_planned = 0;  ///< members of the design; 0 = as many as there are
  std::size_t memory_limit_bytes = std::size_t{512} << 20;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< more global attributes
};

/// Layers in SI units on the members' grid; axis values as the scenario gives them (energy
/// kJ m-2, pressure kPa):
///   number_of_members
///   probability_reached, ..._lower, ..._upper
///   for X in thickness, speed, energy, pressure, where the scenario gives thresholds:
///     probability_of_peak_X_above_threshold, ..._lower, ..._upper    [X_threshold][y][x]
///   for X in the four: peak_X_mean, and peak_X_quantile               [quantile][y][x]
///   arrival_time_quantile                                            [quantile][y][x]
///   deposit_thickness_mean, deposit_thickness_quantile
///   probability_of_high_debris_flow_intensity, probability_of_medium_debris_flow_intensity
/// With no valid member every value is NaN and number_of_members is 0.
/// \throws SetupError naming the member whose data cannot be right
LayerStack make_hazard_map(const MemberSource& members, const HazardSpec& spec,
                           const HazardContext& context);

}  // namespace sturz
