// SPDX-License-Identifier: Apache-2.0
/// Distributions in one call each.
#pragma once

#include "scenarios/uncertain.hpp"

namespace sturz::test {

/// uniform, log_uniform, triangular, beta: those that lie between two bounds.
inline Distribution bounded(Distribution::Kind kind, double min, double max) {
  Distribution d;
  d.kind = kind;
  d.min = min;
  d.max = max;
  return d;
}

inline Distribution normal(double mean, double sd) {
  Distribution d;
  d.kind = Distribution::Kind::normal;
  d.mean = mean;
  d.sd = sd;
  return d;
}

inline Distribution lognormal(double median, double sigma_ln) {
  Distribution d;
  d.kind = Distribution::Kind::lognormal;
  d.median = median;
  d.sigma_ln = sigma_ln;
  return d;
}

}  // namespace sturz::test
