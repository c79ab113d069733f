// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/marginal.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <fmt/format.h>
#include <openturns/Beta.hxx>
#include <openturns/Distribution.hxx>
#include <openturns/Exception.hxx>
#include <openturns/Log.hxx>
#include <openturns/LogNormal.hxx>
#include <openturns/LogUniform.hxx>
#include <openturns/Normal.hxx>
#include <openturns/Triangular.hxx>
#include <openturns/TruncatedDistribution.hxx>
#include <openturns/TruncatedNormal.hxx>
#include <openturns/Uniform.hxx>
#include <openturns/UserDefined.hxx>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace sturz {
namespace {

using Kind = Distribution::Kind;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Below this share of kept mass the truncated quantile loses its digits.
constexpr double least_kept_mass = 1e-6;

void check(bool good, const char* problem, const char* suggestion) {
  require(good, fmt::format("{}. {}", problem, suggestion));
}

void check_bounds(const Distribution& d) {
  check(d.min && d.max && *d.min < *d.max,
        "needs min below max (the distribution has no width otherwise)",
        "Give both, or a plain number for a fixed value.");
}

/// `whole` cut to the bounds that are given.
OT::Distribution truncated(const OT::Distribution& whole, const Distribution& d) {
  if (!d.min && !d.max) return whole;
  const double from = d.min ? whole.computeCDF(*d.min) : 0.0;
  const double to = d.max ? whole.computeCDF(*d.max) : 1.0;
  check(to - from >= least_kept_mass,
        "min and max keep less than a millionth of the distribution (nothing is left to draw)",
        "Move the bounds towards the middle of the distribution.");
  if (d.min && d.max) {
    if (d.kind == Kind::normal) return OT::TruncatedNormal(d.mean, d.sd, *d.min, *d.max);
    return OT::TruncatedDistribution(whole, *d.min, *d.max);
  }
  if (d.min) return OT::TruncatedDistribution(whole, *d.min, OT::TruncatedDistribution::LOWER);
  return OT::TruncatedDistribution(whole, *d.max, OT::TruncatedDistribution::UPPER);
}

OT::Distribution discrete(const Distribution& d) {
  check(!d.values.empty(), "has no values (there is nothing to draw)", "List some.");
  check(d.weights.empty() || d.weights.size() == d.values.size(),
        "has not as many weights as values (each value needs one)", "Correct the lists.");
  const auto n = d.values.size();
  std::vector<double> weights = d.weights.empty() ? std::vector<double>(n, 1.0) : d.weights;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  check(std::all_of(weights.begin(), weights.end(), [](double w) { return w >= 0; }) && sum > 0 &&
            std::isfinite(sum),
        "has weights that make no distribution (none may be negative, one must be positive)",
        "Correct the weights.");
  OT::Sample points(n, 1);
  OT::Point probabilities(n);
  for (std::size_t i = 0; i < n; ++i) {
    points(i, 0) = d.values[i];
    probabilities[i] = weights[i] / sum;
  }
  return OT::UserDefined(points, probabilities);
}

OT::Distribution open_turns(const Distribution& d) {
  switch (d.kind) {
    case Kind::uniform:
      check_bounds(d);
      return OT::Uniform(*d.min, *d.max);
    case Kind::log_uniform:
      check_bounds(d);
      check(*d.min > 0, "needs min above 0 (its logarithm is drawn)", "Use uniform otherwise.");
      return OT::LogUniform(std::log(*d.min), std::log(*d.max));
    case Kind::normal:
      check(d.sd > 0, "needs sd above 0 (the distribution has no width otherwise)",
            "Give a plain number for a fixed value.");
      return truncated(OT::Normal(d.mean, d.sd), d);
    case Kind::lognormal:
      check(d.median > 0 && d.sigma_ln > 0,
            "needs median and sigma_ln above 0 (its logarithm is drawn)", "Correct them.");
      return truncated(OT::LogNormal(std::log(d.median), d.sigma_ln, 0.0), d);
    case Kind::triangular:
      check_bounds(d);
      check(*d.min <= d.mode && d.mode <= *d.max, "needs min <= mode <= max (its three corners)",
            "Correct the order.");
      return OT::Triangular(*d.min, d.mode, *d.max);
    case Kind::beta:
      check_bounds(d);
      check(d.alpha > 0 && d.beta > 0, "needs alpha and beta above 0 (its density diverges)",
            "Correct them.");
      return OT::Beta(d.alpha, d.beta, *d.min, *d.max);
    case Kind::discrete:
      return discrete(d);
    case Kind::table:
      break;
  }
  throw std::logic_error("a table of observations has no OpenTURNS distribution");
}

/// Straight lines through the sorted observations (definition 7 of Hyndman & Fan 1996).
std::function<double(double)> empirical(const Distribution& d) {
  check(!d.values.empty(), "has no observations (there is nothing to draw)", "List some.");
  std::vector<double> sorted = d.values;
  std::sort(sorted.begin(), sorted.end());
  return [x = std::move(sorted)](double u) {
    const double place = u * static_cast<double>(x.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), x.size() - 1);
    const auto above = std::min(below + 1, x.size() - 1);
    return x[below] + (place - static_cast<double>(below)) * (x[above] - x[below]);
  };
}

std::pair<double, double> support(const Distribution& d) {
  if (d.kind == Kind::discrete || d.kind == Kind::table) {
    const auto [low, high] = std::minmax_element(d.values.begin(), d.values.end());
    return {*low, *high};
  }
  const double lowest = d.kind == Kind::lognormal ? 0.0 : -infinity;
  return {std::max(d.min.value_or(lowest), lowest), d.max.value_or(infinity)};
}

bool all_finite(const Distribution& d) {
  const auto finite = [](double v) { return std::isfinite(v); };
  return finite(d.min.value_or(0)) && finite(d.max.value_or(0)) && finite(d.mean) && finite(d.sd) &&
         finite(d.median) && finite(d.sigma_ln) && finite(d.mode) && finite(d.alpha) &&
         finite(d.beta) && std::all_of(d.values.begin(), d.values.end(), finite) &&
         std::all_of(d.weights.begin(), d.weights.end(), finite);
}

}  // namespace

Marginal::Marginal(const Distribution& d, const std::string& path) {
  const std::string who = path.empty() ? "distribution" : path;
  OT::Log::Show(OT::Log::NONE);
  try {
    check(all_finite(d), "has a parameter that is not a finite number (it cannot be drawn from)",
          "Correct it.");
    if (d.kind == Kind::table)
      quantile_ = empirical(d);
    else
      quantile_ = [ot = open_turns(d)](double u) { return ot.computeQuantile(u)[0]; };
  } catch (const SetupError& error) {
    throw SetupError(who + ": " + error.what());
  } catch (const OT::Exception& error) {
    throw SetupError(
        fmt::format("{}: no such distribution ({}). Correct its parameters.", who, error.what()));
  }
  std::tie(lower_, upper_) = support(d);
}

double Marginal::quantile(double u) const {
  return std::clamp(quantile_(inside_unit(u)), lower_, upper_);
}

}  // namespace sturz
