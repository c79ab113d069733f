// SPDX-License-Identifier: Apache-2.0
/// Quantiles of a sample of which some values are not fully known.
#pragma once

#include "engine/terrain/raster.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// What one value of a sample says about the true one.
enum class Known {
  exactly,
  at_least,  ///< the true value is this or larger: right-censored
  not_at_all
};

struct Observation {
  double value = 0;
  Known known = Known::exactly;
};

/// A quantile with its interval, as far as the sample lets one know it.
struct CensoredEstimate {
  double value = nan_d;   ///< NaN: cannot be told
  bool at_least = false;  ///< `value` is a lower bound: the quantile lies beyond what was seen
  double least = nan_d;   ///< where `value` cannot be told: the quantile of these n members lies
  double most = nan_d;    ///< between these; NaN: even that is not known
  double lower = nan_d;   ///< NaN: too few values for the confidence; -inf: no lower end is known
  double upper = nan_d;   ///< NaN: too few values for the confidence; +inf: no upper end is known
  std::size_t n = 0, n_at_least = 0, n_not_at_all = 0;
  bool weighted = false;  ///< the values did not count alike
};

/// Quantile of a sample with values censored from the right (and others not known at all).
///
/// Value: Kaplan & Meier's (1958) estimate over the values that are known, the middle of the flat
/// piece where the survival meets 1 - fraction exactly; so the ordinary median where nothing is
/// censored. It supposes that what was censored would have gone on like the others that came as
/// far. Where the sample cannot tell the quantile without that (all censored values infinite would
/// make it infinite), the value is the least that it can be, and `at_least` is set. Values that are
/// not known at all are not left out of the sample, because they may be the longest: there is then
/// no value, only the two ends between which it lies whatever they are.
///
/// Interval: between two order statistics (binomial, no distribution supposed), the lower one of
/// the sample with every censored value at where it was lost and every unknown one at -inf, the
/// upper one with both at +inf. Both samples bracket the true one value by value, so the interval
/// holds its confidence however censoring depends on the value. Intervals from the variance of the
/// Kaplan-Meier curve (Brookmeyer & Crowley 1982) suppose independence and do not hold it where the
/// longest are lost first (docs/decisions/0021).
/// Values that are not finite are left out; where they are censored, they are not known at all.
/// \param fraction, confidence in (0, 1)
CensoredEstimate censored_quantile(std::span<const Observation> sample, double fraction,
                                   double confidence);

/// The same of values that do not count alike. Value: weighted Kaplan-Meier. Interval: as of so
/// many values of equal weight as the weights are worth (Kish 1965, rounded down): the k-th of m
/// such values stands where the weighted distribution passes (k - 1/2) / m. So it is rough where
/// few weights carry the sample. Equal weights give what censored_quantile() gives.
/// \param weights [sample.size()], not negative; values of weight 0 are left out
CensoredEstimate weighted_censored_quantile(std::span<const Observation> sample,
                                            std::span<const double> weights, double fraction,
                                            double confidence);

}  // namespace sturz
