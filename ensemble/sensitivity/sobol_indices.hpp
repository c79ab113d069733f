// SPDX-License-Identifier: Apache-2.0
/// Which share of a result's variance is whose: Sobol' indices with their intervals.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"
#include "ensemble/emulator/quantity_emulator.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sturz {

struct Share {
  double value = 0, lower = 0, upper = 0;  ///< with its 95 % interval
};

/// Of one result.
struct SobolIndices {
  std::vector<Share> first;     ///< [n_dims], by the value alone
  std::vector<Share> total;     ///< [n_dims], with every joint effect it has a part in
  std::int64_t n_sets = 0;      ///< sets of n_dims + 2 evaluations that count
  std::int64_t n_left_out = 0;  ///< sets left out: one of their members is not fully known
};

/// From the members of a Saltelli design by Martinez' estimator, interval by its asymptotic
/// distribution (Baudin and others 2016; by OpenTURNS). A set with a censored member is left out
/// whole: where the longest are lost that is no small matter, so n_left_out belongs beside every
/// number. Empty with fewer than 8 sets or a result that does not vary.
/// \param cube [n][n_dims] as saltelli_cube, \param results [n]
std::optional<SobolIndices> sobol_indices(const std::vector<std::vector<double>>& cube,
                                          std::span<const Observation> results);

/// From an emulator of the members, whatever their design. The intervals hold the estimator's error
/// and the emulator's: a jackknife over ten groups of members left out, lengths kept. What the
/// emulator does not know, 1 - Q2 of the variance, is in no share.
struct EmulatedIndices {
  SobolIndices indices;
  EmulatorReport emulator;
};
/// \param cube [n][n_dims], any design \param results [n]
/// \throws SetupError when no emulator can be made, see emulate()
EmulatedIndices emulated_indices(const std::string& quantity,
                                 const std::vector<std::vector<double>>& cube,
                                 std::span<const Observation> results, std::uint64_t seed);

}  // namespace sturz
