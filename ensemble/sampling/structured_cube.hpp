// SPDX-License-Identifier: Apache-2.0
/// Points of the unit cube that belong together in sets: designs that ask what matters.
///
/// Set i is a function of seed and i alone, so a longer table starts with the shorter one. A last
/// set that is not whole is cut off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// Step of a Morris trajectory: half of the unit cube, whatever the prior.
inline constexpr double morris_step = 0.5;

/// Trajectories (Morris 1991) of n_dims + 1 rows: from one row to the next a single coordinate
/// moves by morris_step, every coordinate once, in random order. Coordinates lie in the middle of
/// eighths: the ends of the cube are infinite for priors without bounds.
/// \return [n][n_dims]
std::vector<std::vector<double>> morris_cube(std::size_t n, std::size_t n_dims, std::uint64_t seed);

/// Sets of n_dims + 2 rows (Saltelli and others 2010): a, b, and for each coordinate k the row a
/// with that of b in place k. a and b are the halves of one shifted Sobol' point of 2 n_dims
/// coordinates. \return [n][n_dims]
std::vector<std::vector<double>> saltelli_cube(std::size_t n, std::size_t n_dims,
                                               std::uint64_t seed);

}  // namespace sturz
