// SPDX-License-Identifier: Apache-2.0
/// What lies on a bed that brakes it, under a constant pull.
#pragma once

#include "engine/core/vec.hpp"

#include <cmath>

namespace sturz {

/// Exact solution of dv/dt = pull - plastic v/|v| - rate v with the direction frozen; the plastic
/// part stops the column and never turns it.
inline Vec3 braked(const Vec3& v, const Vec3& pull, double plastic, double rate, double dt) {
  const double x = rate * dt, decay = x > 0 ? std::exp(-x) : 1;
  const double mean = x > 1e-8 ? (1 - decay) / x : 1;
  const Vec3 trial = decay * v + (mean * dt) * pull;
  const double speed = trial.norm(), stop = plastic * mean * dt;
  // What is no number is no rest.
  return speed <= stop ? Vec3(0, 0, 0) : Vec3((1 - stop / speed) * trial);
}

}  // namespace sturz
