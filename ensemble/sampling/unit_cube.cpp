// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/unit_cube.hpp"

#include "engine/core/error.hpp"

#include <Random123/philox.h>
#include <fmt/format.h>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/LHSExperiment.hxx>
#include <openturns/Log.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SobolSequence.hxx>
#include <openturns/Uniform.hxx>

#include <algorithm>
#include <mutex>

namespace sturz {
namespace {

using Cube = std::vector<std::vector<double>>;

/// Keeps apart the streams that one seed feeds.
enum class Stream : std::uint32_t { generator_seed = 0x64657369, digital_shift = 0x73686966 };

/// 32 random bits as a pure function of (seed, stream, index).
std::uint32_t philox_bits(std::uint64_t seed, Stream stream, std::uint32_t index) {
  const r123::Philox4x32_R<10>::key_type key{
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const r123::Philox4x32_R<10>::ctr_type counter{{index, 0, 0, static_cast<std::uint32_t>(stream)}};
  return r123::Philox4x32_R<10>{}(counter, key)[0];
}

/// OpenTURNS has one generator for the whole process: one design at a time, seeded each time.
std::mutex& generator_lock() {
  static std::mutex lock;
  return lock;
}

/// Its seed has 32 bits; mixing lets all 64 of ours count.
void seed_generator(std::uint64_t seed) {
  OT::RandomGenerator::SetSeed(philox_bits(seed, Stream::generator_seed, 0));
}

Cube monte_carlo(std::size_t n, std::size_t n_dims, std::uint64_t seed) {
  seed_generator(seed);
  Cube cube(n, std::vector<double>(n_dims));
  for (auto& row : cube)  // row by row: a longer table starts with the shorter one
    for (double& u : row) u = OT::RandomGenerator::Generate();
  return cube;
}

Cube latin_hypercube(std::size_t n, std::size_t n_dims, std::uint64_t seed) {
  seed_generator(seed);
  // Independent marginals only: LHSExperiment refuses a dependent copula.
  const OT::ComposedDistribution uniform(
      OT::ComposedDistribution::DistributionCollection(n_dims, OT::Uniform(0.0, 1.0)));
  const OT::Sample sample = OT::LHSExperiment(uniform, n, true, true).generate();
  Cube cube(n, std::vector<double>(n_dims));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t d = 0; d < n_dims; ++d) cube[i][d] = sample(i, d);
  return cube;
}

/// XOR of the top 32 bits with one random word per dimension keeps the nets of the sequence and
/// makes every point uniform; half a step keeps it off 0 and 1.
double shifted(double u, std::uint32_t shift) {
  const auto bits = static_cast<std::uint32_t>(u * 0x1p32);
  return (static_cast<double>(bits ^ shift) + 0.5) * 0x1p-32;
}

Cube sobol(std::size_t n, std::size_t n_dims, std::uint64_t seed) {
  require(n_dims <= OT::SobolSequence::MaximumDimension,
          fmt::format("ensemble.design: sobol has no more than {} dimensions (the scenario has {} "
                      "uncertain keys). Use latin_hypercube.",
                      OT::UnsignedInteger(OT::SobolSequence::MaximumDimension), n_dims));
  const OT::SobolSequence sequence(n_dims);
  Cube cube(n, std::vector<double>(n_dims, 0.0));
  // OpenTURNS leaves out the origin, the first point of the sequence: without it 2^k rows are no
  // net any more. The shift moves it off the corner.
  for (std::size_t i = 1; i < n; ++i) {
    const OT::Point point = sequence.generate();
    for (std::size_t d = 0; d < n_dims; ++d) cube[i][d] = point[d];
  }
  for (std::size_t d = 0; d < n_dims; ++d) {
    const std::uint32_t shift =
        philox_bits(seed, Stream::digital_shift, static_cast<std::uint32_t>(d));
    for (auto& row : cube) row[d] = shifted(row[d], shift);
  }
  return cube;
}

}  // namespace

double inside_unit(double value) { return std::clamp(value, unit_margin, 1 - unit_margin); }

std::vector<std::vector<double>> draw_unit_cube(Design design, std::size_t n, std::size_t n_dims,
                                                std::uint64_t seed) {
  expect(design != Design::table, "a user's own table is not drawn");
  if (n == 0 || n_dims == 0) return Cube(n);
  const std::lock_guard guard(generator_lock());
  OT::Log::Show(OT::Log::NONE);
  Cube cube = design == Design::sobol         ? sobol(n, n_dims, seed)
              : design == Design::monte_carlo ? monte_carlo(n, n_dims, seed)
                                              : latin_hypercube(n, n_dims, seed);
  for (auto& row : cube)
    for (double& u : row) u = inside_unit(u);
  return cube;
}

}  // namespace sturz
