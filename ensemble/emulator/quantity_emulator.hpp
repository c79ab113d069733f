// SPDX-License-Identifier: Apache-2.0
/// Emulators of what members were asked for: one Gaussian process per quantity, on the unit cube
/// of the prior.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"
#include "ensemble/emulator/gaussian_process.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// What an emulator is made of and how good it is.
struct EmulatorReport {
  std::string quantity;
  std::int64_t n_exact = 0;        ///< members that it knows
  std::int64_t n_at_least = 0;     ///< members of which only a lower bound is known
  std::int64_t n_bounds_used = 0;  ///< of these: bound above what the others say, taken as value
  std::int64_t n_not_known = 0;    ///< members that say nothing of it: left out
  double q2 = 0, coverage95 = 0;   ///< see LeaveOneOut
  double inflation = 1;
  double noise_sd = 0;  ///< of a member about the smooth function, unit of the quantity
};

/// At most so many members teach one emulator: its algebra costs the cube of their number.
inline constexpr std::size_t most_emulated_members = 400;
/// Under this Q2 half of the variance is not told by the emulator.
inline constexpr double poor_q2 = 0.5;

struct QuantityEmulator {
  GaussianProcess process;
  EmulatorReport report;
};

/// Fits to the members whose value is known. A member of which a lower bound is known that lies
/// above what the others predict there joins them with the bound: nearer to the truth than what it
/// contradicts, and still below it. With more than most_emulated_members the first ones are taken
/// (designs draw their rows in no order).
/// \param cube [n][n_dims] \param simulated [n]
/// \throws SetupError naming the quantity: fewer exact members than n_dims + 5, or one and the same
///   value in all of them
QuantityEmulator emulate(const std::string& quantity, const std::vector<std::vector<double>>& cube,
                         std::span<const Observation> simulated);

}  // namespace sturz
