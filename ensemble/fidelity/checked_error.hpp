// SPDX-License-Identifier: Apache-2.0
/// A prediction of an error beside what a finer run showed.
#pragma once

#include "engine/terrain/raster.hpp"

#include <string>

namespace sturz {

/// What was said of a finer spacing that no estimate knew, and what its members showed.
struct CheckedError {
  std::string name, units;  ///< of scalar_table(); "map" with the threshold in metres
  double spacing_m = 0;     ///< that is compared with the finer one
  double threshold_m = nan_d;
  /// Differences over scale(), of maps over the mean area: root mean square over the members, and
  /// of the mean (NaN for maps).
  double said = nan_d, found = nan_d, said_mean = nan_d, found_mean = nan_d;
  double noise = nan_d;  ///< of a difference of two members (of two maps) that should be the same

  /// Both sizes are numbers: a map threshold that no member reaches has none.
  bool is_told() const;
  /// The larger over the smaller.
  double factor() const;
  /// Told, and within a factor of two; where what was found is noise, what was said is no more than
  /// twice it.
  bool is_met() const;
};

}  // namespace sturz
