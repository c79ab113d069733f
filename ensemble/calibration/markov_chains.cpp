// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/markov_chains.hpp"

#include "engine/core/error.hpp"
#include "ensemble/emulator/openturns_function.hpp"
#include "ensemble/sampling/random_words.hpp"

#include <openturns/CovarianceMatrix.hxx>
#include <openturns/Interval.hxx>
#include <openturns/Normal.hxx>
#include <openturns/RandomWalkMetropolisHastings.hxx>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// OpenTURNS compares logarithms by subtraction, and -infinity less itself is no number.
constexpr double impossible = -1e300;

OT::Normal step_of(const Eigen::MatrixXd& covariance) {
  const auto n = static_cast<OT::UnsignedInteger>(covariance.rows());
  OT::CovarianceMatrix matrix(n);
  const double factor = 2.38 * 2.38 / static_cast<double>(n);
  for (OT::UnsignedInteger i = 0; i < n; ++i)
    for (OT::UnsignedInteger j = 0; j <= i; ++j)
      matrix(i, j) =
          factor * covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) +
          (i == j ? 1e-8 : 0);
  return {OT::Point(n, 0.0), matrix};
}

using Chain = std::vector<double>;  ///< one coordinate of one chain

struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(std::span<const double> x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) m.variance += (v - m.mean) * (v - m.mean) / (n - 1);
  return m;
}

/// Within and between halves of chains.
struct Spread {
  double within = 0, between = 0, pooled = 0;
};
Spread spread_of(const std::vector<Chain>& chains) {
  std::vector<double> means;
  Spread s;
  const std::size_t half = chains.front().size() / 2;
  for (const Chain& chain : chains)
    for (const std::size_t from : {std::size_t{0}, half}) {
      const Moments m = moments(std::span(chain).subspan(from, half));
      means.push_back(m.mean);
      s.within += m.variance;
    }
  s.within /= static_cast<double>(means.size());
  const auto n = static_cast<double>(half);
  s.between = n * moments(means).variance;
  s.pooled = (n - 1) / n * s.within + s.between / n;
  return s;
}

/// Autocovariance of a chain at a lag, over n.
double autocovariance(std::span<const double> x, double mean, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) sum += (x[i] - mean) * (x[i + lag] - mean);
  return sum / static_cast<double>(x.size());
}

double effective_draws(const std::vector<Chain>& chains) {
  const Spread s = spread_of(chains);
  const auto total = static_cast<double>(chains.size() * chains.front().size());
  if (!(s.pooled > 0)) return 0;
  std::vector<double> means;
  for (const Chain& chain : chains) means.push_back(moments(chain).mean);
  const auto rho = [&](std::size_t lag) {
    double covariance = 0;
    for (std::size_t c = 0; c < chains.size(); ++c)
      covariance += autocovariance(chains[c], means[c], lag) / static_cast<double>(chains.size());
    return 1 - (s.within - covariance) / s.pooled;
  };
  double sum = 0;
  for (std::size_t lag = 1; lag + 1 < chains.front().size() / 2; lag += 2) {
    const double pair = rho(lag) + rho(lag + 1);
    if (pair < 0) break;
    sum += pair;
  }
  return std::min(total, total / (1 + 2 * sum));
}

}  // namespace

ChainSample sample_chains(const std::function<double(std::span<const double>)>& log_density,
                          const std::vector<std::vector<double>>& starts,
                          const Eigen::MatrixXd& covariance, const ChainLengths& lengths,
                          std::uint64_t seed) {
  expect(
      static_cast<int>(starts.size()) == lengths.chains && lengths.chains > 1 && lengths.kept >= 8,
      "a start for each of several chains");
  const std::size_t n_dims = starts.front().size();
  const OT::Function target = openturns_function(n_dims, [&](std::span<const double> u) {
    for (const double x : u)
      if (!(x > 0 && x < 1)) return impossible;
    const double value = log_density(u);
    return std::isfinite(value) ? value : impossible;
  });
  const OT::Interval cube{OT::Point(n_dims, 0.0), OT::Point(n_dims, 1.0)};
  const OT::Normal step = step_of(covariance);
  ChainSample sample;
  std::vector<std::vector<Chain>> by_coordinate(n_dims);
  for (std::size_t c = 0; c < starts.size(); ++c) {
    const SeededGenerator generator(seed, Stream::chain, static_cast<std::uint32_t>(c));
    OT::RandomWalkMetropolisHastings walk(target, cube, openturns_point(starts[c]), step);
    walk.setBurnIn(static_cast<OT::UnsignedInteger>(lengths.burn_in));
    const OT::Sample drawn = walk.getSample(static_cast<OT::UnsignedInteger>(lengths.kept));
    for (std::size_t d = 0; d < n_dims; ++d) by_coordinate[d].emplace_back();
    for (OT::UnsignedInteger i = 0; i < drawn.getSize(); ++i) {
      auto& point = sample.points.emplace_back(n_dims);
      for (std::size_t d = 0; d < n_dims; ++d) {
        point[d] = drawn(i, d);
        by_coordinate[d].back().push_back(point[d]);
      }
    }
    sample.acceptance.push_back(walk.getAcceptanceRate());
  }
  sample.effective_size = static_cast<double>(sample.points.size());
  for (const auto& chains : by_coordinate) {
    const Spread s = spread_of(chains);
    sample.r_hat.push_back(s.within > 0 ? std::sqrt(s.pooled / s.within) : INFINITY);
    sample.effective_size = std::min(sample.effective_size, effective_draws(chains));
  }
  return sample;
}

}  // namespace sturz
