// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/unit_cube.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/random_words.hpp"
#include "ensemble/sampling/structured_cube.hpp"

#include <fmt/format.h>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/LHSExperiment.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SobolSequence.hxx>
#include <openturns/Uniform.hxx>

#include <algorithm>

namespace sturz {
namespace {

using Cube = std::vector<std::vector<double>>;

Cube monte_carlo(std::size_t n, std::size_t n_dims) {
  Cube cube(n, std::vector<double>(n_dims));
  for (auto& row : cube)  // row by row: a longer table starts with the shorter one
    for (double& u : row) u = OT::RandomGenerator::Generate();
  return cube;
}

Cube latin_hypercube(std::size_t n, std::size_t n_dims) {
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
        random_word(seed, Stream::digital_shift, static_cast<std::uint32_t>(d));
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
  if (design == Design::morris) return morris_cube(n, n_dims, seed);
  if (design == Design::saltelli) return saltelli_cube(n, n_dims, seed);
  const SeededGenerator generator(seed);
  Cube cube = design == Design::sobol         ? sobol(n, n_dims, seed)
              : design == Design::monte_carlo ? monte_carlo(n, n_dims)
                                              : latin_hypercube(n, n_dims);
  for (auto& row : cube)
    for (double& u : row) u = inside_unit(u);
  return cube;
}

}  // namespace sturz
