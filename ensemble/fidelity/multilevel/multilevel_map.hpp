// SPDX-License-Identifier: Apache-2.0
/// The probability, cell by cell, that members of the dearest level exceed a threshold, from few of
/// them and more of cheaper levels.
///
/// The control of a cell is not what cheaper members do there: whether a cell at the edge is
/// covered is a matter of spacing. It is how far the cell lies inside or outside what they cover.
/// The fit (margin_model.hpp) of the dearest level's distance to those of the cheaper ones, with
/// weights that fall with the distance and sums that are shared with the cells within one spacing
/// of the coarsest level, turns these distances into a probability: an indicator smoothed over what
/// the cheaper levels cannot tell. Members correct its mean (increments.hpp).
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/fidelity/multilevel/covered_cells.hpp"
#include "ensemble/fidelity/multilevel/level_draws.hpp"
#include "ensemble/fidelity/multilevel/share_bounds.hpp"

#include <span>
#include <vector>

namespace sturz {

/// Draws of cheaper levels that are added up together.
inline constexpr std::size_t most_waiting = 32;

struct MapLevels {
  std::vector<const MemberParts*> levels;  ///< the dearest first; all on one grid
  std::vector<double> spacings_m;          ///< [n_levels]
  std::vector<LevelDraw> draws;            ///< level_draws() of them
  double memory_bytes = 0;                 ///< that a map may take; 0: not bounded
};

struct MultilevelMap {
  Window extent;  ///< of the levels' grid; P = 0 beyond
  /// Within [0, 1]; 90 % bounds (share_bounds()), nowhere nearer to 0 and 1 than the number of
  /// draws of the dearest level allows.
  Raster<double> probability, low, high;
  /// 1 where the upper bound is told: a draw of the dearest level comes there, or what the others
  /// foretell of one is a chance of least_foretold or more. Beyond, the probability (below half a
  /// per cent) is 0 and `high` unseen_share(), there and everywhere alike: a matter of numbers, not
  /// of the place.
  Raster<std::uint8_t> told;
  /// Cells whose probability is between 0.05 and 0.95, and over them: the root mean square of the
  /// standard error, sums of the variances of the increments [n_levels], and of P (1 - P), which is
  /// what plain sampling has.
  std::size_t doubtful = 0;
  double rms_error = nan_d;
  std::vector<double> variances;
  double plain_variance = 0;
  /// The mean of what members of the dearest level correct is taken over so many cells to each
  /// side: the number of least estimated risk (Stein 1981, Ann. Statist. 9, 1135-1151).
  int smoothed_cells = 0;
  double smoothing_error = 0;  ///< root mean square of what that shifts, estimated; in the bounds
};

/// Two standard deviations of the fit's remainder outside the fitted outline.
inline constexpr double least_foretold = 0.025;

/// All cells are held at a time, see map_bytes_a_cell(). \pre at least least_draws at the dearest
/// level \throws Cancelled; SetupError where the map would take more than memory_bytes
MultilevelMap multilevel_map(const MapLevels&, const Exceedance&, CancelFlag cancel = {});

/// Maps of one quantity at rising thresholds as they must be: none above the one before. The
/// nearest such maps in the mean square (pool adjacent violators), of bounds as well. Where an
/// upper bound is told, those of lower thresholds are. \pre one extent
void make_monotone(std::span<MultilevelMap> rising);

}  // namespace sturz
