// SPDX-License-Identifier: Apache-2.0
/// The scores of one member as they are worked out: name, meaning and value in one place.
#pragma once

#include "ensemble/scores/comparison.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Which values of a score are good ones.
enum class Better { larger, smaller, nearer_zero, nearer_one };

struct ScoreInfo {
  std::string
      name;  ///< with its unit, "outline_distance_m"; a column of members.csv behind "score_"
  std::string unit;  ///< UDUNITS text
  std::string long_name;
  Better better = Better::nearer_zero;
};

/// Scores and quantities in the order in which they were added: the same for every member.
class ScoreSheet {
 public:
  void add(ScoreInfo info, double value, Known known) {
    if (std::isnan(value)) known = Known::not_at_all;
    columns.push_back(std::move(info));
    scores.push_back({value, known});
  }
  /// All that is compared of an event is a length, a distance, an area, a volume, a ratio of
  /// lengths, a time or a speed: none is below 0.
  void compare(ObservedQuantity quantity, double value, Known known) {
    if (std::isnan(value)) known = Known::not_at_all;
    quantity.least = 0;
    observed.push_back(std::move(quantity));
    simulated.push_back({value, known});
  }

  std::vector<ScoreInfo> columns;
  std::vector<Observation> scores;  ///< [columns]
  std::vector<ObservedQuantity> observed;
  std::vector<Observation> simulated;  ///< [observed]
};

/// Root mean square of (simulated - observed) / sd over the quantities: 1 where a member differs as
/// much as the observations are uncertain. A lower bound where all that is not known fully is a
/// lower bound above what was observed; not known where something else is not known, and then of
/// the others.
Observation misfit(const std::vector<ObservedQuantity>& observed,
                   const std::vector<Observation>& simulated);

}  // namespace sturz
