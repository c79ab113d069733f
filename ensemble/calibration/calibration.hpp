// SPDX-License-Identifier: Apache-2.0
/// From members and what was observed to what is then known of the uncertain values.
#pragma once

#include "ensemble/calibration/identifiability.hpp"
#include "ensemble/calibration/posterior.hpp"
#include "ensemble/calibration/prediction_check.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

struct CalibrationData {
  std::vector<std::string> keys;                ///< [n_dims], for words
  std::vector<std::vector<double>> cube;        ///< [n members][n_dims], independent coordinates
  std::map<std::string, double> correlation{};  ///< "key/key", see Copula
  Comparison comparison;                        ///< of these members
  /// So many first members were drawn from the prior; those after them were chosen, and have no
  /// weight of their own.
  std::size_t n_drawn = 0;
};

struct CalibrationSettings {
  std::optional<PosteriorMethod> method;  ///< absent: see chosen_method()
  double discrepancy = default_discrepancy;
  ChainLengths lengths;
  ChainLengths held_out_lengths{2, 300, 700};
  std::uint64_t seed = 1;
};

/// The emulator from about ten members per uncertain value on (Loeppky, Sacks and Welch 2009),
/// weights below: few members make no emulator, and many with weights are too few where several
/// quantities agree.
inline constexpr std::size_t members_per_key = 10;
PosteriorMethod chosen_method(std::size_t n_members, std::size_t n_dims);

/// Discrepancy of one kind of quantity, as a share of the scale (likelihood.hpp).
struct DiscrepancyFound {
  std::string kind;
  double mean = 0, lower = 0, upper = 0;  ///< 5 % and 95 %
};

struct Calibration {
  Posterior posterior;
  /// Of the members that were drawn, by their likelihood, adding up to 1; empty when none explains
  /// anything. By weights the same as the posterior's.
  std::vector<double> member_weights;
  std::string reason;                      ///< why this method
  std::vector<ObservedQuantity> observed;  ///< those that count
  std::vector<DiscrepancyFound> discrepancies;
  Identifiability identifiability;
  std::vector<PredictedQuantity> check;
  HeldOut held_out;
  std::optional<BestFit> best;            ///< by emulator
  std::vector<EmulatorReport> emulators;  ///< by emulator
  std::vector<std::string> warnings;      ///< whole sentences
};

/// \throws SetupError: no member, nothing observed, all members censored, one and the same value
///   everywhere, all likelihoods 0, weights of chosen members
Calibration calibrate(const CalibrationData&, const CalibrationSettings&);

/// Points worth computing next for an emulator, at most n: see next_members(). Needs the posterior
/// and nothing else of a calibration. \throws SetupError as calibrate()
std::vector<std::vector<double>> points_to_compute(const CalibrationData&,
                                                   const CalibrationSettings&, std::size_t n);

}  // namespace sturz
