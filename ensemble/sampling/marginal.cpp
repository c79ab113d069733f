// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/marginal.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/unit_cube.hpp"
#include "scenarios/checks/distribution_check.hpp"

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
#include <numeric>
#include <vector>

namespace sturz {
namespace {

using Kind = Distribution::Kind;

/// `whole` cut to the bounds that are given.
OT::Distribution truncated(const OT::Distribution& whole, const Distribution& d) {
  if (!d.min && !d.max) return whole;
  if (d.min && d.max) {
    if (d.kind == Kind::normal) return OT::TruncatedNormal(d.mean, d.sd, *d.min, *d.max);
    return OT::TruncatedDistribution(whole, *d.min, *d.max);
  }
  if (d.min) return OT::TruncatedDistribution(whole, *d.min, OT::TruncatedDistribution::LOWER);
  return OT::TruncatedDistribution(whole, *d.max, OT::TruncatedDistribution::UPPER);
}

OT::Distribution discrete(const Distribution& d) {
  const auto n = d.values.size();
  std::vector<double> weights = d.weights.empty() ? std::vector<double>(n, 1.0) : d.weights;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
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
      return OT::Uniform(*d.min, *d.max);
    case Kind::log_uniform:
      return OT::LogUniform(std::log(*d.min), std::log(*d.max));
    case Kind::normal:
      return truncated(OT::Normal(d.mean, d.sd), d);
    case Kind::lognormal:
      return truncated(OT::LogNormal(std::log(d.median), d.sigma_ln, 0.0), d);
    case Kind::triangular:
      return OT::Triangular(*d.min, d.mode, *d.max);
    case Kind::beta:
      return OT::Beta(d.alpha, d.beta, *d.min, *d.max);
    case Kind::discrete:
      return discrete(d);
    case Kind::table:
      break;
  }
  throw std::logic_error("a table of observations has no OpenTURNS distribution");
}

/// Straight lines through the observations, which rise (definition 7 of Hyndman & Fan 1996).
std::function<double(double)> empirical(const Distribution& d) {
  return [x = d.values](double u) {
    const double place = u * static_cast<double>(x.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), x.size() - 1);
    const auto above = std::min(below + 1, x.size() - 1);
    return x[below] + (place - static_cast<double>(below)) * (x[above] - x[below]);
  };
}

}  // namespace

Marginal::Marginal(const Distribution& d, const std::string& path) {
  const std::string subject = path.empty() ? "distribution" : path;
  const auto problems = parameter_problems(d);
  require(problems.empty(),
          fmt::format("{}: {}. Correct its parameters.", subject, fmt::join(problems, ", ")));
  OT::Log::Show(OT::Log::NONE);
  try {
    if (d.kind == Kind::table)
      quantile_ = empirical(d);
    else
      quantile_ = [ot = open_turns(d)](double u) { return ot.computeQuantile(u)[0]; };
  } catch (const OT::Exception& error) {
    throw SetupError(fmt::format("{}: no such distribution ({}). Correct its parameters.", subject,
                                 error.what()));
  }
  std::tie(lower_, upper_) = support(d);
}

double Marginal::quantile(double u) const {
  return std::clamp(quantile_(inside_unit(u)), lower_, upper_);
}

}  // namespace sturz
