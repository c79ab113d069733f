// SPDX-License-Identifier: Apache-2.0
/// Maps of a region: what several sources on one site do together, and which of them comes where.
///
/// Every number is conditional: it holds if the sources release. None says how often they do.
/// Rules, also written into the layers' comments, of the n sources with a valid member:
///   p_i            members of source i that reach the cell / its valid members
///   highest        max p_i: the cell's probability if the source that is worst for it releases
///   any hit        1 - prod(1 - p_i): if all release, each with values of its own (independent)
///   bounds         90 % of both, as any_hit.hpp says
///   any hit, rows  share of the rows of the design in which some source reaches the cell: if all
///                  release with the same uncertain values, as the members were drawn. A row counts
///                  when some source has a valid member of it
///   expected       sum p_i: how many sources reach the cell on average if all release
///   number         of sources with p_i > 0
///   likeliest      the source with the largest p_i; of equal ones that with the larger mean peak
///                  thickness there, of these the first
///   largest q      max over sources of each quantile over all valid members of the source, with 0
///                  where a member did not come (as in hazard_map.hpp)
/// Sources are taken in the order of the features, members by number: order of computing, workers,
/// shards and memory leave no trace. Work and memory follow the cells that members touched.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "scenarios/layers/layer_stream.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// One source of the region, whether or not it has members.
struct RegionSource {
  std::string name;
  std::int64_t planned = 0, valid = 0;
  /// What its valid members touched, in cells of the members' grid; empty: nothing.
  Window touched;
};

/// Whose members a region has. Members of the MemberParts are numbered through, source after
/// source.
struct RegionMembers {
  const MemberParts& members;
  std::span<const RegionSource> sources;
  std::span<const std::uint32_t> source_of_valid;  ///< of each valid member, ascending
  std::span<const std::int64_t> row_of_valid;      ///< its row of the design that all share
  std::int64_t n_rows = 0;                         ///< of that design
};

struct RegionContext {
  /// Elevations that hold the window of the members' grid; null: the ground is known everywhere.
  std::function<std::shared_ptr<const Raster<double>>(const Window&)> ground;
  Grid whole_ground;                                            ///< of which they are windows
  std::vector<std::pair<std::string, std::string>> attributes;  ///< global ones
  std::size_t memory_bytes = MemberCells::default_memory_bytes;
  CancelFlag cancel;
};

/// Places of a region's layers in LayerStack::layers.
struct RegionLayers {
  HazardLayers layers;  ///< `stack` and `untouched` of it are used
  enum Place : std::size_t {
    highest,
    any,  // then its lower and its upper bound
    any_rows = any + 3,
    expected = any_rows + 3,
    number,
    likeliest_source,
    first_peak
  };
};
/// What the maps hold besides their values; names of sources become words of classes.
/// \param n_rows of the design of which some source has a valid member
RegionLayers region_layers(const Grid& grid, std::span<const RegionSource> sources,
                           std::span<const double> quantiles, int n_censored, std::int64_t n_rows);

/// The hull of what was touched, as map_extent(). Blocks of 128 x 128 cells in which no source
/// touched anything, margin included, are missing on the map.
/// \return the lists of the same cells
/// \throws SetupError naming the member whose data cannot be right; Cancelled
SourceLists make_region_maps(const RegionMembers& region, std::span<const double> quantiles,
                             const RegionContext& context, LayerSink& to);

}  // namespace sturz
