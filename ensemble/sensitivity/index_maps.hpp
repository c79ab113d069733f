// SPDX-License-Identifier: Apache-2.0
/// Which uncertain value decides whether a cell is reached: Sobol' indices cell by cell, from the
/// members of a Saltelli design.
///
/// A cell's result is 0 or 1 of each member: reached, or thicker than a threshold. First and total
/// index of value k by Martinez' estimator (Baudin and others 2016) over the whole sets,
///   first = r(b, e_k), total = 1 - r(a, e_k), r Pearson's correlation,
/// with 95 % intervals by Fisher's z (standard error 1 / sqrt(sets - 3)). Rows that agree in every
/// set have r = 1; the far end of their interval is then that of rows that differ in one set, as an
/// interval without width would say what no number of sets can. A member that is cut off
/// and did not exceed is not known there, and its set is left out in that cell alone.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// What one member says of one cell.
enum class Exceeds : std::uint8_t { no, yes, not_known };

/// An index and its interval; NaN where it is not known.
struct CellIndex {
  double value = nan_d, lower = nan_d, upper = nan_d;
};
struct CellIndices {
  std::vector<CellIndex> first, total;  ///< [n_dims]
  std::int64_t n_sets = 0;              ///< that count
};

/// Of one cell. An index is NaN where fewer than 8 whole sets say yes, or fewer than 8 say no, in
/// one of the two rows that it compares: a handful that happens to agree has no interval.
/// \param rows of saltelli_cube, [n]; a last set that is not whole does not count
CellIndices cell_indices(std::span<const Exceeds> rows, std::size_t n_dims);

struct IndexMapRequest {
  std::vector<std::string> keys;    ///< [n_dims]
  std::int64_t n_rows = 0;          ///< of the design
  std::vector<double> thickness_m;  ///< thresholds besides reached
  std::size_t memory_bytes = MemberCells::default_memory_bytes;
  CancelFlag cancel;
};

/// Layers for each key, of `reach` and of `thickness_exceedance` [thickness_threshold][y][x]:
///   sobol_first_<key>_of_..., _lower, _upper, sobol_total_<key>_of_..., _lower, _upper
/// and sobol_sets_of_...: sets that count. NaN where an index is not known, dots of keys are
/// underlines. \throws SetupError; Cancelled
void make_index_maps(const MemberParts& members, const IndexMapRequest&, LayerSink& to);

}  // namespace sturz
