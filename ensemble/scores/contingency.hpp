// SPDX-License-Identifier: Apache-2.0
/// Where simulated and observed areas agree: a table of four areas and what is made of it.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstdint>

namespace sturz {

/// Areas [m2] over a domain. A cell that the observed outline covers in part counts with its share.
struct Contingency {
  double hit_m2 = 0;      ///< simulated and observed (TP)
  double false_m2 = 0;    ///< simulated, not observed (FP); also beyond the domain
  double missed_m2 = 0;   ///< observed, not simulated (FN)
  double neither_m2 = 0;  ///< of the domain (TN): the only one that depends on it
};

// NaN where nothing was simulated or observed that the score could be a share of.
double intersection_over_union(const Contingency&);  ///< TP / (TP + FP + FN): the CSI, too
double hit_rate(const Contingency&);                 ///< TP / (TP + FN)
double false_alarm_ratio(const Contingency&);        ///< FP / (TP + FP)
/// Heidke's skill: 2 (TP TN - FP FN) / ((TP + FN)(FN + TN) + (TP + FP)(FP + TN)); 1 agrees
/// everywhere, 0 is chance, below 0 is worse.
double heidke_skill(const Contingency&);

/// An observed area with what does not depend on the member.
class ObservedCells {
 public:
  /// \param cover share 0..1, on cells of `maps`
  ObservedCells(const Raster<double>& cover, const Grid& maps);

  /// The smallest rectangle around the observed area, widened on every side by half its longer
  /// side, as far as it lies on the maps: it follows from the observation alone, so members of any
  /// ensemble compare.
  const Window& domain() const { return domain_; }
  /// Share of a cell of the maps that was observed as covered.
  double cover(int row, int col) const {
    return window_.contains(row, col) ? cover_.at(row - window_.row0, col - window_.col0) : 0;
  }
  /// \param simulated not 0 where covered, on cells of the maps; nothing lies beyond
  Contingency against(const Raster<std::uint8_t>& simulated) const;

 private:
  const Raster<double>& cover_;
  Grid maps_;
  Window window_, domain_;
  double covered_ = 0;  ///< cells
};

}  // namespace sturz
