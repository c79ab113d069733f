// SPDX-License-Identifier: Apache-2.0
/// Emulators of what members were asked for: one Gaussian process per quantity, on the unit cube
/// of the prior.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"
#include "ensemble/emulator/gaussian_process.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// What an emulator is made of and how good it is.
struct EmulatorReport {
  std::string quantity;
  std::int64_t n_exact = 0;        ///< members whose value is known
  std::int64_t n_used = 0;         ///< points that teach it: of those, and bounds
  std::int64_t n_at_least = 0;     ///< members of which only a lower bound is known
  std::int64_t n_bounds_used = 0;  ///< of these: bound above what the others say
  double lowest_bound_used = std::numeric_limits<double>::infinity();
  std::int64_t n_not_known = 0;   ///< members that say nothing of it: left out
  double q2 = 0, coverage95 = 0;  ///< see LeaveOneOut
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

/// The members whose value teaches an emulator, rising: all that are exact, and of more than
/// most_emulated_members the last ones. Designs draw their rows in no order, and members that were
/// chosen because an emulator knew little of their place come after them.
std::vector<std::size_t> teaching_members(std::span<const Observation> simulated);

/// Fits to the members whose value is known. A member of which a lower bound c is known that lies
/// above the mean m that the others predict there joins them with what is then expected of it, the
/// mean of a normal m, s above c: m + s phi(a) / (1 - Phi(a)), a = (c - m) / s. Where the others
/// are sure that is hardly more than c, and the truth may lie far beyond: the report keeps the
/// lowest of them. \param cube [n][n_dims] \param simulated [n] \throws SetupError naming the
/// quantity: fewer exact members than n_dims + 5, or one and the same
///   value in all of them
QuantityEmulator emulate(const std::string& quantity, const std::vector<std::vector<double>>& cube,
                         std::span<const Observation> simulated);

}  // namespace sturz
