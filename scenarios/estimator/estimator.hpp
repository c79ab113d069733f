// SPDX-License-Identifier: Apache-2.0
/// What the results of an ensemble are made of, and what they are to reach.
#pragma once

#include "engine/core/words.hpp"

namespace sturz {

/// Of its members, or of few of them and many cheaper ones.
enum class Estimator { plain, multilevel };
constexpr auto words_of(Estimator) {
  using enum Estimator;
  return std::array{Word{plain, "plain"}, Word{multilevel, "multilevel"}};
}

/// What a multilevel ensemble is to reach; 0: not asked for.
struct TargetSpec {
  double relative_error = 0;  ///< half width of 90 % bounds of mean runout, area, centre of mass
  double map_error = 0;       ///< root mean square standard error of P(reached), doubtful cells
  double core_hours = 0;      ///< of all members together, instead of the two
  bool operator==(const TargetSpec&) const = default;
};

}  // namespace sturz
