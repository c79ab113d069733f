// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/level_draws.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/level_scatter.hpp"
#include "ensemble/fidelity/multilevel/share_bounds.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace sturz {
namespace {

/// The distribution function is looked at in so many places.
constexpr int n_places = 256;

using Known = std::function<bool(const MemberSummary&)>;

std::vector<LevelDraw> draws_where(std::span<const ByNumber> levels, const Known& known,
                                   double MemberScalars::*field) {
  std::vector<LevelDraw> draws;
  const std::size_t n = levels.size();
  for (const auto& [number, summary] : levels[n - 1]) {
    if (!known(*summary)) continue;
    LevelDraw draw{number, n - 1, {}};
    if (field != nullptr) draw.values[n - 1] = summary->scalars.*field;
    while (draw.from > 0) {
      const auto found = levels[draw.from - 1].find(number);
      if (found == levels[draw.from - 1].end() || !known(*found->second)) break;
      --draw.from;
      if (field != nullptr) draw.values[draw.from] = found->second->scalars.*field;
    }
    draws.push_back(draw);
  }
  return draws;
}

/// What the draws of the dearest level tell of it from those of the others, without each fold.
class Predictions {
 public:
  Predictions(std::span<const LevelDraw> draws, std::size_t n_levels)
      : draws_(draws), n_levels_(n_levels), models_(fitted(draws, n_levels)) {}

  /// \param own the result itself, of a draw that has it \param tell predictions of the others
  /// \param use called with each draw's dearest level, and with what all from there on tell
  template <class Own, class Tell, class Use>
  void each(Own own, Tell tell, Use use) const {
    std::array<double, most_levels> told{};
    std::size_t place = 0;
    for (const LevelDraw& draw : draws_) {
      const bool is_dear = draw.from == 0;
      std::optional<std::size_t> fold;
      if (is_dear) {
        told[0] = own(draw.values[0]);
        fold = fold_of(place++);
      }
      const std::size_t skip = is_dear ? 1 : 0;
      tell(models_, draw, fold, std::span(told).subspan(skip, n_levels_ - draw.from - skip));
      use(draw.from, std::span<const double>(told).first(n_levels_ - draw.from));
    }
  }

 private:
  static FoldedModels fitted(std::span<const LevelDraw> draws, std::size_t n_levels) {
    const std::size_t n = draws_of_levels(draws, n_levels).front();
    const std::size_t n_folds = std::min(n, most_folds);
    std::vector<MarginSums> folds(n_folds, MarginSums(n_levels));
    std::vector<double> counts(n_folds, 0);
    std::size_t place = 0;
    for (const LevelDraw& draw : draws) {
      if (draw.from > 0) continue;
      const std::size_t fold = fold_of(place++);
      folds[fold].add(draw.values, 1);
      counts[fold] += 1;
    }
    return {folds, counts, 0};
  }

  std::span<const LevelDraw> draws_;
  std::size_t n_levels_;
  FoldedModels models_;
};

bool enough(std::span<const LevelDraw> draws, std::size_t n_levels) {
  const auto counts = draws_of_levels(draws, n_levels);
  return counts.front() >= least_draws;
}

double squared_correlation_with(std::span<const LevelDraw> draws, std::size_t level) {
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (const LevelDraw& d : draws)
    if (d.from == 0) n += 1, x += d.values[level], y += d.values[0];
  for (const LevelDraw& d : draws) {
    if (d.from > 0) continue;
    const double dx = d.values[level] - x / n, dy = d.values[0] - y / n;
    xx += dx * dx, yy += dy * dy, xy += dx * dy;
  }
  return xx > 0 && yy > 0 ? xy * xy / (xx * yy) : 0;
}

/// Of freedom of the variance of the mean, by Satterthwaite (1946): twice its square over what it
/// scatters by itself. Far outliers leave few.
double degrees_of(const MultilevelScalar& s, std::span<const double> doubt) {
  double variance = 0, scatter = 0;
  for (std::size_t l = 0; l < doubt.size(); ++l) {
    const double part = s.variances[l] / s.draws[l];
    variance += part;
    scatter += part * part * doubt[l] * doubt[l];
  }
  return scatter > 0 ? 2 * variance * variance / scatter : 1e6;
}

/// P(result <= t) at rising places.
struct Distribution {
  std::vector<double> places, low, middle, high;
};

/// Where a rising function reaches `level`, between its places. \param before what is said where it
/// is above at the first \param beyond where it is below at the last
double reached(const Distribution& d, const std::vector<double>& f, double level, double before,
               double beyond) {
  const auto at = std::lower_bound(f.begin(), f.end(), level) - f.begin();
  if (at == 0) return before;
  if (at == static_cast<std::ptrdiff_t>(f.size())) return beyond;
  const auto i = static_cast<std::size_t>(at);
  const double share = (level - f[i - 1]) / (f[i] - f[i - 1]);
  return d.places[i - 1] + share * (d.places[i] - d.places[i - 1]);
}

/// 90 % bounds of a share. Draws of one level alone are counted.
Interval bounds_of_share(const IncrementMoments& sums, double noise, const Surprises& surprises) {
  if (sums.n_levels() > 1) {
    const MultilevelMean e = sums.estimate(std::array{noise / sums.draws(0)});
    return share_bounds(e.mean, e.standard_error, e.degrees, surprises);
  }
  const double n = sums.draws(0), unseen = unseen_share(static_cast<std::size_t>(n));
  const ProbabilityBounds b = wilson_interval(std::llround(sums.mean() * n), std::llround(n), z_90);
  return {std::min(b.lower, 1 - unseen), std::max(b.upper, unseen)};
}

/// P(result <= t), which may lie beyond 0 and 1.
ShareEstimate share_below(const Predictions& predictions, std::size_t n_levels, double t) {
  double noise = 0;  // of the indicator, as the predictions have it
  IncrementMoments sums(n_levels);
  Surprises surprises;
  predictions.each(
      [&](double v) { return v <= t ? 1.0 : 0.0; },
      [&](const FoldedModels& models, const LevelDraw& draw, auto fold, std::span<double> told) {
        models.shares_below(t, draw.values, draw.from, fold, told);
        if (draw.from == 0 && !told.empty()) noise += told[0] * (1 - told[0]);
      },
      [&](std::size_t from, std::span<const double> told) {
        sums.add(from, told);
        if (from == 0) surprises.add(told[0] - (told.size() > 1 ? told[1] : 0));
      });
  return {sums.mean(), bounds_of_share(sums, noise, surprises)};
}

Distribution distribution(std::span<const LevelDraw> draws, std::size_t n_levels) {
  const Predictions predictions(draws, n_levels);
  double least = nan_d, most = nan_d;
  const auto widen = [&](double v) {
    if (!(v >= least)) least = v;
    if (!(v <= most)) most = v;
    return v;
  };
  predictions.each(
      widen,
      [&](const FoldedModels& models, const LevelDraw& draw, auto fold, std::span<double> told) {
        models.margins(draw.values, draw.from, fold, told);
        for (const double v : told) widen(v);
      },
      [](std::size_t, std::span<const double>) {});
  Distribution d;
  const double margin = 0.05 * (most - least);
  for (int i = 0; i < n_places; ++i) {
    const double t = least - margin + (most - least + 2 * margin) * i / (n_places - 1);
    const ShareEstimate below = share_below(predictions, n_levels, t);
    d.places.push_back(t);
    d.low.push_back(below.bounds_90.low);
    d.middle.push_back(below.share);
    d.high.push_back(below.bounds_90.high);
  }
  for (std::vector<double>* f : {&d.low, &d.middle, &d.high}) make_rising(*f);
  return d;
}

}  // namespace

std::vector<LevelDraw> level_draws(std::span<const ByNumber> levels) {
  return draws_where(
      levels, [](const MemberSummary&) { return true; }, nullptr);
}

std::vector<LevelDraw> level_draws(std::span<const ByNumber> levels, double MemberScalars::*field) {
  return draws_where(
      levels, [field](const MemberSummary& m) { return is_known(m, field); }, field);
}

std::vector<std::size_t> draws_of_levels(std::span<const LevelDraw> draws, std::size_t n_levels) {
  std::vector<std::size_t> counts(n_levels, 0);
  for (const LevelDraw& draw : draws)
    for (std::size_t l = draw.from; l < n_levels; ++l) ++counts[l];
  return counts;
}

MultilevelScalar multilevel_scalar(std::span<const LevelDraw> draws, std::size_t n_levels) {
  MultilevelScalar s;
  for (const std::size_t n : draws_of_levels(draws, n_levels))
    s.draws.push_back(static_cast<double>(n));
  s.variances.assign(n_levels, nan_d);
  s.squared_correlations.assign(n_levels, nan_d);
  if (!enough(draws, n_levels)) return s;
  IncrementMoments sums(n_levels);
  LevelScatter scatter(n_levels);
  Predictions(draws, n_levels)
      .each([](double v) { return v; },
            [](const FoldedModels& models, const LevelDraw& draw, auto fold,
               std::span<double> told) { models.margins(draw.values, draw.from, fold, told); },
            [&](std::size_t from, std::span<const double> told) {
              sums.add(from, told);
              scatter.add(from, told);
            });
  const std::vector<double> least = scatter.expected(), doubt = scatter.doubt();
  s.cautious_variances.assign(n_levels, nan_d);
  s.mean = sums.estimate(least);
  s.variance = 0;
  for (std::size_t l = 0; l < n_levels; ++l) {
    s.variances[l] = std::max(sums.variance(l), least[l]);
    s.cautious_variances[l] = s.variances[l] * (1 + doubt[l]);
    s.variance += s.variances[l];
    s.squared_correlations[l] = l == 0 ? 1 : squared_correlation_with(draws, l);
  }
  s.mean.degrees = std::min(s.mean.degrees, degrees_of(s, doubt));
  return s;
}

std::vector<QuantileEstimate> multilevel_quantiles(std::span<const LevelDraw> draws,
                                                   std::size_t n_levels,
                                                   std::span<const double> levels) {
  std::vector<QuantileEstimate> all;
  for (const double level : levels) all.push_back({level, nan_d, {}, 0});
  if (!enough(draws, n_levels)) return all;
  const Distribution d = distribution(draws, n_levels);
  const double first = d.places.front(), last = d.places.back();
  // Beyond all draws nothing is known, unless they are all the same.
  const double nowhere = last > first ? std::numeric_limits<double>::infinity() : 0;
  for (QuantileEstimate& q : all) {
    q.value = reached(d, d.middle, q.level, first, last);
    // The function's upper bound is at `level` first.
    q.bounds_90 = {reached(d, d.high, q.level, first - nowhere, last),
                   reached(d, d.low, q.level, first, last + nowhere)};
    if (std::isinf(q.bounds_90.low) || std::isinf(q.bounds_90.high))
      q.draws_needed =
          std::max(draws_for_quantile(q.level), draws_of_levels(draws, n_levels).front() + 1);
  }
  return all;
}

ShareEstimate multilevel_share_above(std::span<const LevelDraw> draws, std::size_t n_levels,
                                     double threshold) {
  const std::size_t n_dear = draws_of_levels(draws, n_levels).front();
  if (n_dear < (n_levels > 1 ? least_draws : 1)) return {};
  const ShareEstimate below = share_below(Predictions(draws, n_levels), n_levels, threshold);
  return {std::clamp(1 - below.share, 0.0, 1.0),
          {1 - below.bounds_90.high, 1 - below.bounds_90.low}};
}

void make_rising(std::vector<double>& f) {
  struct Block {
    double sum = 0, n = 0;
    double mean() const { return sum / n; }
  };
  std::vector<Block> blocks;
  for (const double v : f) {
    blocks.push_back({v, 1});
    while (blocks.size() > 1 && blocks.back().mean() < blocks[blocks.size() - 2].mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().n += last.n;
    }
  }
  auto at = f.begin();
  for (const Block& b : blocks)
    at = std::fill_n(at, static_cast<std::ptrdiff_t>(b.n), std::clamp(b.mean(), 0.0, 1.0));
}

}  // namespace sturz
