// SPDX-License-Identifier: Apache-2.0
/// Would more members change the map? Probabilities made from the first N members, N growing.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/hazard/member_cells.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// What the first `n_members` valid members (in order of their number) say. Means go over the
/// cells that any valid member of the whole ensemble reached, so all points share one area.
struct ConvergencePoint {
  std::int64_t n_members = 0;
  double mean_probability_reached = 0;
  double area_likely_m2 = 0;  ///< where P(reached) >= 0.5
  /// Where the 95 % interval of P(reached) lies above 0.5, and where it does so or touches it.
  double area_likely_lower_m2 = 0, area_likely_upper_m2 = 0;
  double area_possible_m2 = 0;  ///< where P(reached) >= 0.05
  double mean_half_width = 0;   ///< half of the 95 % Wilson interval of P(reached)
};

/// Counts cells as they pass by; a map in the making does it on the way.
class ConvergenceCount {
 public:
  /// At most `max_points` points, evenly spaced in N; the last is the whole ensemble.
  explicit ConvergenceCount(std::size_t n_members, int max_points = 40);
  /// Looks at who arrived: the rows must hold PeakLayer::arrival.
  void add(const CellRows& rows);
  /// Empty when there is no valid member; areas and means are 0 when no member reached a cell.
  std::vector<ConvergencePoint> points(double cell_area_m2) const;

 private:
  std::vector<std::int64_t> sizes_;
  /// For each size: cells by how many of the first N members reached them. Whole numbers, so no
  /// order of cells can change what follows from them.
  std::vector<std::vector<std::int64_t>> histograms_;
};

/// The same from stored members alone.
std::vector<ConvergencePoint> probability_convergence(
    const MemberParts& members, std::size_t memory_bytes = MemberCells::default_memory_bytes,
    int max_points = 40, CancelFlag cancel = {});

}  // namespace sturz
