// SPDX-License-Identifier: Apache-2.0
/// Clouds of particles with fields, put through lists and sweep and through the slow twin.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"
#include "tests/support/sweep/slow_sweep.hpp"

#include <array>
#include <functional>
#include <random>
#include <vector>

namespace sturz::test {

/// What the sweep wrote, in the order of the particles it was given.
struct SweepRun {
  std::vector<SlowRates> rates;
  std::vector<float> raw;  ///< all outputs in storage order, to compare bits
};

SweepConstants usual_constants(double spacing);

/// Runs lists and sweep on copies of the particles. Positions may lie anywhere.
SweepRun fast_sweep(const std::vector<SlowParticle>&, const SweepConstants&, InstructionSet,
                    const Domain& = {}, bool no_slip = false);

/// The same through the sweep of grains that may disperse.
SweepRun kinetic_sweep(const std::vector<SlowParticle>&, const SweepConstants&, InstructionSet,
                       const Domain& = {}, DispersedClock* = nullptr);

/// A jittered cubic lattice of n[0] x n[1] x n[2] particles at spacing dx around `center`.
std::vector<SlowParticle> lattice(std::array<int, 3> n, double dx, double jitter,
                                  const Vec3& center = {0, 0, 0}, unsigned seed = 1);

/// Random velocity, stress, density change and volume for every particle.
void roughen(std::vector<SlowParticle>&, double dx, unsigned seed = 2);

/// sqrt(sum |a - b|^2 / sum |b|^2) of one part of the rates.
double relative_error(const std::vector<SlowRates>& a, const std::vector<SlowRates>& b,
                      const std::function<Eigen::MatrixXd(const SlowRates&)>& part);

}  // namespace sturz::test
