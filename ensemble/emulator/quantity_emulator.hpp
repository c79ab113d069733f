// SPDX-License-Identifier: Apache-2.0
/// Emulators of what members were asked for: Gaussian processes on the unit cube of the prior, one
/// for each quantity, or one for each side of its step.
///
/// Where values jump (a member stops at a bench or runs past it) one smooth function through all of
/// them lies in the gap, where no member ends. There each side has a process of its own, and a
/// third tells the side: of the members' sides as 0 and 1, P(above) = Phi((m - 1/2) / s) with its
/// mean m and standard deviation s, noise included (label regression; Rasmussen and Williams 2006,
/// 6.5). What is expected is then the one or the other, and never what lies between.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"
#include "ensemble/emulator/smooth_part.hpp"
#include "ensemble/emulator/value_step.hpp"

#include <cstdint>
#include <limits>
#include <optional>
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
  std::optional<ValueStep> step{};
};

/// At most so many members teach one emulator: its algebra costs the cube of their number.
inline constexpr std::size_t most_emulated_members = 400;
/// Under this Q2 half of the variance is not told by the emulator.
inline constexpr double poor_q2 = 0.5;

/// What is expected of one more member at a point.
struct EmulatedValue {
  GaussianPrediction likely;  ///< on the likelier side of a step; without one, all there is
  GaussianPrediction other;   ///< on the other side
  double other_share = 0;     ///< probability of that one, 0..0.5; 0 without a step
  double variance = 0;        ///< of what is not known, the side included; more members lessen it
  double noise = 0;           ///< of a member, the side included where its place does not tell it

  double mean() const { return (1 - other_share) * likely.mean + other_share * other.mean; }
};

class QuantityEmulator {
 public:
  QuantityEmulator(SmoothPart whole, EmulatorReport report)
      : below_(std::move(whole)), report_(std::move(report)) {}
  /// \param side knows members below the step as 0, those above as 1
  QuantityEmulator(SmoothPart below, SmoothPart above, GaussianProcess side, EmulatorReport report)
      : below_(std::move(below)),
        above_(std::move(above)),
        side_(std::move(side)),
        report_(std::move(report)) {}

  EmulatedValue at(std::span<const double> point) const;
  /// The expected value; beside a step a mean of both sides, as a share of variance wants it.
  double mean_at(std::span<const double> point) const;
  /// See GaussianProcess::with_point; of a step, the likelier side there.
  QuantityEmulator with_point(std::span<const double> point) const;
  /// Of other members, with the same scales, trends and step. Nothing where they cannot be
  /// emulated: too few, all alike, or on one side of the step.
  std::optional<QuantityEmulator> of_others(const std::vector<std::vector<double>>& points,
                                            std::span<const double> values) const;
  const EmulatorReport& report() const { return report_; }

 private:
  SmoothPart below_;  ///< without a step the whole
  std::optional<SmoothPart> above_;
  std::optional<GaussianProcess> side_;
  EmulatorReport report_;
};

/// The members whose value teaches an emulator, rising: all that are exact, and of more than
/// most_emulated_members the last ones. Designs draw their rows in no order, and members that were
/// chosen because an emulator knew little of their place come after them.
std::vector<std::size_t> teaching_members(std::span<const Observation> simulated);

/// Fits to the members whose value is known. A member of which a lower bound c is known that lies
/// above the mean m that the others predict there joins them with what is then expected of it, the
/// mean of a normal m, s above c: m + s phi(a) / (1 - Phi(a)), a = (c - m) / s. Where the others
/// are sure that is hardly more than c, and the truth may lie far beyond: the report keeps the
/// lowest of them. Of a step a bound above its lower side joins the upper one; others say nothing.
/// \param cube [n][n_dims] \param simulated [n] \throws SetupError naming the quantity: fewer exact
///   members than n_dims + 5, or one and the same value in all of them
QuantityEmulator emulate(const std::string& quantity, const std::vector<std::vector<double>>& cube,
                         std::span<const Observation> simulated);

}  // namespace sturz
