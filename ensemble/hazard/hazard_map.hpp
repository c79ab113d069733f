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
///   ground       a cell is known ground unless the elevations have a hole there and no member came
///   intensity    Swiss classes of debris flow, from each member's own peaks: high = peak
///                thickness > 1 m and peak speed > 1 m/s, medium = reached but not high. The two
///                peaks need not coincide in time, so high errs on the safe side.
///   weighted     with HazardContext::weights: shares of weight in place of shares of members,
///   bounds
///                as of the effective number of members (Kish 1965), quantiles of weighted_quantile
/// Every number is a function of the set of members: order, shards and memory leave no trace.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "scenarios/layers/layer_stream.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What the maps need to know besides the members.
struct HazardContext {
  double spacing_m = 0;        ///< particle spacing: thickness below half of it is
                               ///< not resolved; 0 = not known
  std::int64_t n_planned = 0;  ///< members of the design; 0 = as many as there are
  std::size_t memory_bytes = MemberCells::default_memory_bytes;  ///< for members' values
  const Raster<double>* ground = nullptr;  ///< elevations; null: the ground is known everywhere
  Grid whole_ground;                       ///< of which `ground` is a window; empty: it is all
  std::vector<std::pair<std::string, std::string>> attributes;  ///< more global attributes
  ConvergenceCount* convergence = nullptr;                      ///< counts on the way, where wanted
  /// Of the valid members by ascending number, adding up to 1; empty: all count alike.
  std::span<const double> weights;
  CancelFlag cancel;
};

/// Ground around the touched cells that a map shows too [cells].
inline constexpr int map_margin_cells = 8;
/// Edge of the empty map of an ensemble in which nothing moved [cells].
inline constexpr int empty_map_cells = 16;

/// The part of the members' grid that the map covers: the hull of what valid members touched, and a
/// margin; where nothing was touched, a few cells at the centre of the grid.
Window map_extent(const Window& touched, const Grid& grid);

/// Makes the layers on the members' grid, cropped to map_extent, and hands them to `to` in blocks.
/// Values and axes have the units in which the scenario asks for thresholds:
///   number_of_members
///   probability_of_reach, ..._lower, ..._upper
///   for X in thickness [m], speed [m s-1], energy [kJ m-2], pressure [kPa]:
///     X_exceedance, ..._lower, ..._upper   [X_threshold][y][x], where the scenario gives
///     thresholds X_mean, X_quantile                   [quantile][y][x]
///   arrival_quantile [s]                   [quantile][y][x]
///   deposit_mean, deposit_quantile [m]
///   probability_of_high_intensity, probability_of_medium_intensity
/// and where grains and liquid move apart, for P in solid, liquid:
///   the share of members of which P reaches the cell, with its bounds
///   P_arrival_quantile [s]
///   P_X_exceedance, ..._mean, ..._quantile for the four X
///   liquid_fraction_quantile               over the members that reach the cell only
/// One rule for all: 0 where the ground is known and no member came, NaN where it is not known; an
/// arrival is NaN where none came. With no valid member every value is NaN and number_of_members
/// is 0.
/// \throws SetupError naming the member whose data cannot be right; Cancelled
void make_hazard_map(const MemberParts& members, const HazardSpec& spec,
                     const HazardContext& context, LayerSink& to);

/// The same, all in memory.
LayerStack make_hazard_map(const MemberParts& members, const HazardSpec& spec,
                           const HazardContext& context);

}  // namespace sturz
