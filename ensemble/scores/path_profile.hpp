// SPDX-License-Identifier: Apache-2.0
/// What lies across a thalweg, band by band down the path, as AvaFrame's AIMEC looks at results.
#pragma once

#include "engine/terrain/raster.hpp"

#include <map>

namespace sturz {

/// One band across the path.
struct CrossBand {
  double area_m2 = 0;  ///< covered
  double largest = 0;  ///< of what is followed, say thickness [m]
};

/// Bands of equal length down the path, by number: band k holds distances k step .. (k + 1) step.
class PathProfile {
 public:
  explicit PathProfile(double step_m) : step_m_(step_m) {}

  void add(double distance_m, double area_m2, double value);
  const std::map<int, CrossBand>& bands() const { return bands_; }
  double step_m() const { return step_m_; }
  /// The farthest distance at which at least half a cell is covered; NaN when none is.
  double runout_m() const { return runout_m_; }
  /// One more place that is covered by half or more.
  void reach(double distance_m);

 private:
  double step_m_;
  std::map<int, CrossBand> bands_;
  double runout_m_ = nan_d;
};

/// Root mean square over the bands that either covers of the difference in width (area over step)
/// [m], and of the difference of the largest values. NaN when neither covers any.
double width_rmse_m(const PathProfile& a, const PathProfile& b);
double largest_rmse(const PathProfile& a, const PathProfile& b);

}  // namespace sturz
