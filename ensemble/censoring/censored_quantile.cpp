// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/censored_quantile.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

struct Weighed {
  double value, weight;
};

/// Sorted by value, and what all of it weighs.
struct WeighedSample {
  std::vector<Weighed> sorted;
  double sum = 0;

  void add(double value, double weight) {
    sorted.push_back({value, weight});
    sum += weight;
  }
  void sort() {
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
  }
  /// Smallest value with more than this share at or below it; where one has exactly this share, the
  /// middle between it and the next.
  double quantile(double fraction) const {
    double passed = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      passed += sorted[i].weight;
      const bool meets = std::abs(passed - fraction * sum) < 1e-12 * sum;
      if (meets && i + 1 < sorted.size())
        return sorted[i].value == sorted[i + 1].value ? sorted[i].value  // also of two infinities
                                                      : (sorted[i].value + sorted[i + 1].value) / 2;
      if (passed > fraction * sum) return sorted[i].value;
    }
    return sorted.back().value;
  }
};

struct WeighedObservation {
  Observation seen;
  double weight;
};

double weighted_kaplan_meier(std::vector<WeighedObservation> known, double fraction) {
  std::stable_sort(known.begin(), known.end(), [](const auto& a, const auto& b) {
    return a.seen.value != b.seen.value ? a.seen.value < b.seen.value : a.seen.known < b.seen.known;
  });
  double at_risk = 0;
  for (const WeighedObservation& o : known) at_risk += o.weight;
  double survival = 1, since = nan_d;
  bool flat = false;
  for (const auto& [seen, weight] : known) {
    if (seen.known == Known::exactly) {
      if (flat) return (since + seen.value) / 2;
      survival *= at_risk > weight ? (at_risk - weight) / at_risk : 0;
      since = seen.value;
      flat = std::abs(survival - (1 - fraction)) < 1e-12;
      if (!flat && survival < 1 - fraction) return since;
    }
    at_risk -= weight;
  }
  return flat ? since : nan_d;
}

/// What the quantiles with all that is not known at its least and at its most leave to say.
/// \param estimate  of the quantile between them
template <class Estimate>
void conclude(CensoredEstimate& e, double smallest, double largest, Estimate&& estimate) {
  if (!std::isfinite(smallest)) return;
  e.at_least = !std::isfinite(largest);
  if (e.at_least) {
    e.value = smallest;
  } else if (e.n_not_at_all == 0 || smallest == largest) {
    e.value = estimate();
  } else {
    e.least = smallest;
    e.most = largest;
  }
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
  conclude(e, smallest, largest, [&] { return kaplan_meier(std::move(known), fraction); });
  return e;
}

CensoredEstimate weighted_censored_quantile(std::span<const Observation> sample,
                                            std::span<const double> weights, double fraction,
                                            double confidence) {
  expect(weights.size() == sample.size(), "a weight for each value");
  CensoredEstimate e;
  e.weighted = true;
  std::vector<WeighedObservation> known;
  WeighedSample least, most;
  double squares = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const Observation& o = sample[i];
    const double w = weights[i];
    if (!(w > 0)) continue;
    if (o.known == Known::not_at_all || (o.known == Known::at_least && !std::isfinite(o.value))) {
      ++e.n_not_at_all;
      least.add(-infinite, w), most.add(infinite, w);
    } else if (std::isfinite(o.value)) {
      e.n_at_least += o.known == Known::at_least;
      known.push_back({o, w});
      least.add(o.value, w), most.add(o.known == Known::exactly ? o.value : infinite, w);
    } else {
      continue;
    }
    squares += w * w;
  }
  e.n = least.sorted.size();
  if (e.n == 0) return e;
  least.sort(), most.sort();
  const auto worth = static_cast<std::size_t>(least.sum * least.sum / squares * (1 + 1e-12));
  const Ranks ranks = interval_ranks(worth, fraction, (1 - confidence) / 2);
  const auto place = [&](std::size_t rank) {
    return (static_cast<double>(rank) - 0.5) / static_cast<double>(worth);
  };
  if (ranks.lower >= 1) e.lower = least.quantile(place(ranks.lower));
  if (ranks.upper <= worth) e.upper = most.quantile(place(ranks.upper));
  const double smallest = least.quantile(fraction), largest = most.quantile(fraction);
  conclude(e, smallest, largest, [&] { return weighted_kaplan_meier(std::move(known), fraction); });
  return e;
}

}  // namespace sturz
