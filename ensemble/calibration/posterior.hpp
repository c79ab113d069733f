// SPDX-License-Identifier: Apache-2.0
/// What the uncertain values are after the observations: a sample of points in the unit cube of the
/// prior, where the prior is even.
#pragma once

#include "ensemble/calibration/likelihood.hpp"
#include "ensemble/calibration/markov_chains.hpp"
#include "ensemble/emulator/quantity_emulator.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

enum class PosteriorMethod { weights, emulator };
const char* to_string(PosteriorMethod);

struct Posterior {
  PosteriorMethod method = PosteriorMethod::weights;
  std::vector<std::vector<double>> cube;  ///< [n][n_dims], independent coordinates (no copula yet)
  std::vector<double> weights;            ///< [n], they add up to 1
  std::vector<SimulatedRow> simulated;    ///< [n][n_quantities], what is expected there
  double effective_size = 0;
  /// Weight of members whose values are not all fully known; NaN by emulator, whose points are
  /// none.
  double censored_share = 0;
  std::optional<ChainSample> chains;  ///< of an emulator, without the points
};

/// The members of an ensemble that was drawn from the prior, weighted by their likelihood.
/// \param cube [n][n_dims] \param members [n][n_quantities]
/// \throws SetupError when there is no member, or none explains anything
Posterior weighted_members(const Likelihood&, const std::vector<std::vector<double>>& cube,
                           const std::vector<std::vector<Observation>>& members);

/// One emulator per quantity.
class EmulatorSet {
 public:
  /// \throws SetupError naming the quantity, see emulate()
  EmulatorSet(const std::vector<ObservedQuantity>& observed,
              const std::vector<std::vector<double>>& cube,
              const std::vector<std::vector<Observation>>& members);
  /// What is expected of a member there: variance of the emulator and of the member's own noise.
  /// An emulator is a sum of curves and may fall below the least that a quantity can be (a distance
  /// below 0): there it expects the least. A logarithm would not do instead: values of 0 are good
  /// ones, and near them it would tell millimetres from one another.
  SimulatedRow at(std::span<const double> point) const;
  const std::vector<QuantityEmulator>& quantities() const { return quantities_; }
  /// See GaussianProcess::with_point.
  EmulatorSet with_point(std::span<const double> point) const;

 private:
  EmulatorSet() = default;

  std::vector<QuantityEmulator> quantities_;
  std::vector<double> least_;  ///< [n_quantities]
};

/// Draws by chains on the emulators. They start where a Sobol' sample of the prior is likely, and
/// step as wide as it spreads there.
/// \param left_out quantities that have no say
/// \throws SetupError when no point of the prior explains anything
Posterior emulated_posterior(const Likelihood&, const EmulatorSet&, std::size_t n_dims,
                             const ChainLengths&, std::uint64_t seed,
                             std::span<const std::size_t> left_out = {});

/// The point of the largest likelihood (a bounded search from the three best of a Sobol' sample).
struct BestFit {
  std::vector<double> cube;  ///< [n_dims]
  SimulatedRow simulated;
  double log_likelihood = 0;
};
BestFit best_fit(const Likelihood&, const EmulatorSet&, std::size_t n_dims, std::uint64_t seed);

}  // namespace sturz
