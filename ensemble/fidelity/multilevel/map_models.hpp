// SPDX-License-Identifier: Apache-2.0
/// The fits of a probability map, one per cell that some members cover and others do not.
#pragma once

#include "ensemble/fidelity/multilevel/multilevel_map.hpp"

#include <vector>

namespace sturz {

/// Members of all levels by draw, as signed distances in some cells.
class DrawDistances {
 public:
  /// Looks at all draws once: which cells some cover and others do not.
  DrawDistances(const MapLevels&, const Exceedance&, CancelFlag);

  const Window& extent() const { return extent_; }
  const Grid& grid() const { return grid_; }
  /// Places in the extent.
  const std::vector<std::size_t>& cells() const { return cells_; }
  /// In the extent, of the cells that are not in cells(): whether all cover it.
  bool always(std::size_t place) const { return always_[place] != 0; }

  /// Of one draw at the levels from draw.from on. \param out [n_cells], [level]
  void read(const LevelDraw& draw, std::vector<Margins>& out) const;

 private:
  std::size_t index_of(std::size_t level, std::int64_t number) const;

  const MapLevels& levels_;
  const Exceedance what_;
  CancelFlag cancel_;
  std::vector<std::vector<std::int64_t>> numbers_;  // [level][index], ascending
  Window extent_;
  Grid grid_;
  std::vector<std::size_t> cells_;
  std::vector<std::uint8_t> always_;
};

/// Held at a time for each of the cells: fits, sums, and the dearest level's draws.
std::size_t map_bytes_a_cell(std::size_t n_levels, std::size_t n_dear);

/// The models of the cells of `distances`.
/// \param dear margins of the draws of the dearest level in order, [n_draws][n_cells]
std::vector<FoldedModels> map_models(const DrawDistances& distances,
                                     const std::vector<std::vector<Margins>>& dear,
                                     std::span<const double> spacings_m, CancelFlag);

}  // namespace sturz
