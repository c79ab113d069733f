// SPDX-License-Identifier: Apache-2.0
/// What was observed of one event beside what members give for it: what calibration reads.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sturz {

/// One number that was measured. Fields enter as one number each, with its standard deviation as
/// the scale of one independent measurement: an outline as its mean boundary distance to the
/// simulated one with value 0 and outline_sd_m, a thickness raster as the root mean square of
/// differences with value 0 and thickness_sd_m.
struct ObservedQuantity {
  std::string name;  ///< as the columns of members.csv, without "score_": "outline_distance_m"
  double value = 0;
  double sd = 0;  ///< standard deviation in the same unit, > 0
  std::string unit;
  /// No value is smaller: lengths, distances, areas and times end at 0.
  double least = -std::numeric_limits<double>::infinity();
};

/// The same quantities of every valid member. `Known` says whether a value is the member's own, a
/// lower bound of it (its end was not seen), or says nothing; NaN goes with not_at_all.
struct SimulatedQuantities {
  std::vector<std::int64_t> members;             ///< their numbers, rising
  std::vector<std::vector<Observation>> values;  ///< [members][observed quantities]
};

/// One event. Events that share parameters are a list of these.
struct Comparison {
  std::vector<ObservedQuantity> observed;
  SimulatedQuantities simulated;
};

}  // namespace sturz
