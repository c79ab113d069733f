// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/censored_quantile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// How many values may be dropped at either end so that the quantile lies between the next two
/// with each tail at most `tail`: ranks from 1; 0 and n + 1 where the sample is too small.
struct Ranks {
  std::size_t lower = 0, upper = 0;
};

/// The number of values below the quantile is binomial (n, fraction).
Ranks interval_ranks(std::size_t n, double fraction, double tail) {
  // Largest number of outermost terms of the binomial that together stay within the tail, from
  // the side where `p` is the chance of the others.
  const auto terms = [&](double p) {
    double sum = 0, log_choose = 0;
    std::size_t k = 0;
    for (; k <= n; ++k) {
      sum += std::exp(log_choose + static_cast<double>(k) * std::log(p) +
                      static_cast<double>(n - k) * std::log1p(-p));
      if (sum > tail) break;
      log_choose += std::log(static_cast<double>(n - k) / static_cast<double>(k + 1));
    }
    return k;
  };
  return {terms(fraction), n + 1 - terms(1 - fraction)};
}

/// Quantile of the ordinary kind that agrees with the Kaplan-Meier one where nothing is censored.
double quantile_of(const std::vector<double>& sorted, double fraction) {
  const double place = fraction * static_cast<double>(sorted.size());
  const auto k = static_cast<std::size_t>(std::llround(place));
  if (std::abs(place - static_cast<double>(k)) < 1e-9 * place && k > 0 && k < sorted.size()) {
    if (sorted[k - 1] == sorted[k]) return sorted[k];  // also of two infinities
    return (sorted[k - 1] + sorted[k]) / 2;
  }
  return sorted[std::min(static_cast<std::size_t>(place), sorted.size() - 1)];
}

/// Kaplan-Meier quantile of values of which some are known to be at least what they are.
double kaplan_meier(std::vector<Observation> known, double fraction) {
  std::sort(known.begin(), known.end(), [](const Observation& a, const Observation& b) {
    return a.value != b.value ? a.value < b.value : a.known < b.known;  // events come first
  });
  double survival = 1;
  bool flat = false;  // the survival is 1 - fraction since the last event
  double since = nan_d;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].known != Known::exactly) continue;
    if (flat) return (since + known[i].value) / 2;
    const auto at_risk = static_cast<double>(known.size() - i);
    survival *= (at_risk - 1) / at_risk;
    since = known[i].value;
    flat = std::abs(survival - (1 - fraction)) < 1e-12;
    if (!flat && survival < 1 - fraction) return since;
  }
  return flat ? since : nan_d;
}

}  // namespace

CensoredEstimate censored_quantile(std::span<const Observation> sample, double fraction,
                                   double confidence) {
  CensoredEstimate e;
  std::vector<Observation> known;
  std::vector<double> least, most;
  for (const Observation& o : sample) {
    if (o.known == Known::not_at_all || (o.known == Known::at_least && !std::isfinite(o.value))) {
      ++e.n_not_at_all;
      least.push_back(-infinite), most.push_back(infinite);
    } else if (std::isfinite(o.value)) {
      e.n_at_least += o.known == Known::at_least;
      known.push_back(o);
      least.push_back(o.value);
      most.push_back(o.known == Known::exactly ? o.value : infinite);
    }
  }
  e.n = least.size();
  if (e.n == 0) return e;
  std::sort(least.begin(), least.end());
  std::sort(most.begin(), most.end());
  const Ranks ranks = interval_ranks(e.n, fraction, (1 - confidence) / 2);
  if (ranks.lower >= 1) e.lower = least[ranks.lower - 1];
  if (ranks.upper <= e.n) e.upper = most[ranks.upper - 1];
  const double smallest = quantile_of(least, fraction), largest = quantile_of(most, fraction);
  if (!std::isfinite(smallest)) return e;
  e.at_least = !std::isfinite(largest);
  if (e.at_least) {
    e.value = smallest;
  } else if (e.n_not_at_all == 0 || smallest == largest) {
    e.value = kaplan_meier(std::move(known), fraction);
  } else {
    e.least = smallest;
    e.most = largest;
  }
  return e;
}

}  // namespace sturz
