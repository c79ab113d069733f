// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/posterior.hpp"

#include "engine/core/error.hpp"
#include "ensemble/emulator/bounded_minimum.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

/// The first look is flattened until so many of its points count.
constexpr double wanted_of_first_look = 40;

bool fully_known(const SimulatedRow& row) {
  return std::all_of(row.begin(), row.end(),
                     [](const SimulatedValue& s) { return s.known == Known::exactly; });
}

void add_censored_share(Posterior& p) {
  p.censored_share = 0;
  for (std::size_t i = 0; i < p.weights.size(); ++i)
    if (!fully_known(p.simulated[i])) p.censored_share += p.weights[i];
}

/// A sample of the prior with the logarithm of the likelihood.
struct FirstLook {
  Points points;
  std::vector<double> logs;
};

FirstLook first_look(const Likelihood& likelihood, const EmulatorSet& emulators, std::size_t n_dims,
                     int n_points, std::uint64_t seed, std::span<const std::size_t> left_out) {
  FirstLook look;
  look.points = draw_unit_cube(Design::sobol, static_cast<std::size_t>(n_points), n_dims, seed);
  for (const auto& u : look.points)
    look.logs.push_back(likelihood.log_without(emulators.at(u), left_out));
  return look;
}

/// likelihood^power as weights, the largest power in halves of which enough points count: a sharp
/// likelihood leaves a handful of points, whose spread would say nothing.
std::vector<double> flattened_weights(const std::vector<double>& logs) {
  double power = 1;
  for (int halvings = 0;; ++halvings, power /= 2) {
    std::vector<double> flat = logs;
    for (double& l : flat) l *= power;
    std::vector<double> weights = normalised_weights(flat);
    require(!weights.empty(),
            "no point of the prior explains the observations (every likelihood is 0). Check their "
            "values and units, or widen the distributions.");
    if (effective_size(weights) >= wanted_of_first_look || halvings == 60) return weights;
  }
}

Eigen::MatrixXd covariance_of(const Points& points, const std::vector<double>& weights) {
  const auto n_dims = static_cast<Eigen::Index>(points.front().size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n_dims);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n_dims, n_dims);
  const auto at = [&](std::size_t i) {
    return Eigen::Map<const Eigen::VectorXd>(points[i].data(), n_dims);
  };
  for (std::size_t i = 0; i < points.size(); ++i) mean += weights[i] * at(i);
  for (std::size_t i = 0; i < points.size(); ++i)
    covariance += weights[i] * (at(i) - mean) * (at(i) - mean).transpose();
  return covariance;
}

}  // namespace

const char* to_string(PosteriorMethod method) {
  return method == PosteriorMethod::weights ? "weights" : "emulator";
}

Posterior weighted_members(const Likelihood& likelihood, const Points& cube,
                           const std::vector<std::vector<Observation>>& members) {
  expect(cube.size() == members.size(), "a point of the prior for each member");
  require(!members.empty(), "no valid member (there is nothing to weigh). Compute members.");
  Posterior p;
  p.cube = cube;
  std::vector<double> logs;
  for (const auto& member : members) {
    p.simulated.push_back(exact_row(member));
    logs.push_back(likelihood.log_of(p.simulated.back()));
  }
  const bool something = std::any_of(p.simulated.begin(), p.simulated.end(), [](const auto& row) {
    return std::any_of(row.begin(), row.end(),
                       [](const SimulatedValue& s) { return s.known != Known::not_at_all; });
  });
  require(something,
          fmt::format("of {} valid members none says anything of what was observed: all of them "
                      "left the terrain or still moved at their end. Use a larger terrain or a "
                      "longer end time.",
                      members.size()));
  p.weights = normalised_weights(logs);
  require(!p.weights.empty(),
          fmt::format("none of {} members explains the observations (every likelihood is 0). Check "
                      "their values, units and standard deviations, or widen the distributions.",
                      members.size()));
  p.effective_size = effective_size(p.weights);
  add_censored_share(p);
  return p;
}

EmulatorSet::EmulatorSet(const std::vector<ObservedQuantity>& observed, const Points& cube,
                         const std::vector<std::vector<Observation>>& members) {
  for (std::size_t q = 0; q < observed.size(); ++q) {
    std::vector<Observation> column;
    for (const auto& member : members) column.push_back(member[q]);
    quantities_.push_back(emulate(observed[q].name, cube, column));
    least_.push_back(observed[q].least);
  }
}

SimulatedRow EmulatorSet::at(std::span<const double> point) const {
  SimulatedRow row;
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const EmulatedValue e = quantities_[q].at(point);
    SimulatedValue value{std::max(least_[q], e.likely.mean), e.likely.variance + e.likely.noise,
                         Known::exactly};
    if (e.other_share > 0) {
      value.other_share = e.other_share;
      value.other_value = std::max(least_[q], e.other.mean);
      value.other_variance = e.other.variance + e.other.noise;
    }
    row.push_back(value);
  }
  return row;
}

EmulatorSet EmulatorSet::with_point(std::span<const double> point) const {
  EmulatorSet more;
  for (const QuantityEmulator& q : quantities_) more.quantities_.push_back(q.with_point(point));
  more.least_ = least_;
  return more;
}

Posterior emulated_posterior(const Likelihood& likelihood, const EmulatorSet& emulators,
                             std::size_t n_dims, const ChainLengths& lengths, std::uint64_t seed,
                             std::span<const std::size_t> left_out) {
  const FirstLook look =
      first_look(likelihood, emulators, n_dims, lengths.first_look, seed, left_out);
  const std::vector<double> weights = flattened_weights(look.logs);
  Points starts;
  for (const std::size_t i : resampled(weights, static_cast<std::size_t>(lengths.chains)))
    starts.push_back(look.points[i]);
  const auto log_density = [&](std::span<const double> u) {
    return likelihood.log_without(emulators.at(u), left_out);
  };
  ChainSample chains =
      sample_chains(log_density, starts, covariance_of(look.points, weights), lengths, seed);
  Posterior p;
  p.method = PosteriorMethod::emulator;
  p.cube = std::move(chains.points);
  chains.points.clear();
  p.weights.assign(p.cube.size(), 1.0 / static_cast<double>(p.cube.size()));
  for (const auto& u : p.cube) p.simulated.push_back(emulators.at(u));
  p.effective_size = chains.effective_size;
  p.chains = std::move(chains);
  p.censored_share = std::numeric_limits<double>::quiet_NaN();
  return p;
}

BestFit best_fit(const Likelihood& likelihood, const EmulatorSet& emulators, std::size_t n_dims,
                 std::uint64_t seed) {
  const FirstLook look =
      first_look(likelihood, emulators, n_dims, ChainLengths{}.first_look, seed, {});
  std::vector<std::size_t> order(look.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return look.logs[a] > look.logs[b]; });
  Minimum best{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < 3; ++k) {
    const Minimum found = bounded_minimum(
        [&](std::span<const double> u) {
          return std::min(1e300, -likelihood.log_of(emulators.at(u)));
        },
        look.points[order[k]], 60 * static_cast<int>(n_dims + 1));
    if (found.value < best.value) best = found;
  }
  for (double& x : best.at) x = inside_unit(x);
  return {best.at, emulators.at(best.at), -best.value};
}

}  // namespace sturz
