// SPDX-License-Identifier: Apache-2.0
/// Which members would teach an emulator most about the posterior.
#pragma once

#include "ensemble/calibration/posterior.hpp"

#include <vector>

namespace sturz {

/// One after the other, the point of the posterior where the emulators' variance is largest beside
/// that of measurement and discrepancy, summed over the quantities; each choice counts as known for
/// the next. Nothing is drawn.
/// \return [at most n][n_dims]; fewer when the emulators know every point better than 1 % of that
///   variance
std::vector<std::vector<double>> next_members(const Likelihood&, const EmulatorSet&,
                                              const Posterior&, std::size_t n);

}  // namespace sturz
