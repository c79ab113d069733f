// SPDX-License-Identifier: Apache-2.0
/// Two ensembles of one site cell by cell: how much their probabilities differ, and how far both
/// reach together.
///
/// Rules, also written into the layers' comments:
///   difference  P(B) - P(A) over pairs of members, with 95 % intervals from the pairs and, for
///               comparison, from the same members as if they were none (paired_difference.hpp).
///               Without pairs both are of all members, and the same
///   band        smallest and largest of both probabilities; and both Wilson intervals of 95 %
///               together, from the lower lower end to the upper upper end
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/comparison/member_pairs.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "ensemble/members/joined_members.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

struct DifferenceContext {
  std::vector<double> thickness_m;         ///< thresholds besides `reached`; may be empty
  const Raster<double>* ground = nullptr;  ///< elevations; null: the ground is known everywhere
  Grid whole_ground;                       ///< of which `ground` is a window; empty: it is all
  std::vector<std::pair<std::string, std::string>> attributes;  ///< global ones
  std::size_t memory_bytes = MemberCells::default_memory_bytes;
  CancelFlag cancel;
};

/// What the maps say as a whole.
struct DifferenceSummary {
  /// Width of the unpaired interval over that of the paired one, median over the cells that some
  /// members reach and not all do; NaN without such cells or pairs.
  double median_gain = nan_d;
  std::size_t n_cells = 0;             ///< of these
  std::size_t n_less = 0, n_more = 0;  ///< cells whose interval lies below or above 0
  double least = 0, most = 0;          ///< smallest and largest difference
};

/// Makes the layers on the members' grid, cropped to map_extent, and hands them to `to` in blocks.
/// For probability_... and thickness_exceedance_... (one plane per threshold):
///   ..._difference, ..._difference_lower, ..._difference_upper (paired; without pairs unpaired),
///   ..._difference_unpaired_lower, ..._difference_unpaired_upper, ..._smallest, ..._largest,
///   ..._band_lower, ..._band_upper
/// NaN where the ground is not known. \throws SetupError, Cancelled as make_hazard_map()
/// \param joined the members of A and B, in this order
DifferenceSummary make_difference_maps(const JoinedMembers& joined, const MemberPairs&,
                                       const DifferenceContext&, LayerSink& to);

}  // namespace sturz
