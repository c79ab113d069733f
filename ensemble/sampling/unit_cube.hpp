// SPDX-License-Identifier: Apache-2.0
/// Points in the unit cube: independent coordinates, each uniform on the open interval (0, 1).
#pragma once

#include "scenarios/choices.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// No coordinate comes closer to 0 or 1 than this, so every quantile of it is finite. It is half
/// a step of the 32 bits that the digital shift works on.
inline constexpr double unit_margin = 0x1p-33;

/// `value` moved into [unit_margin, 1 - unit_margin].
double inside_unit(double value);

/// Draws n points of n_dims coordinates, [n][n_dims]; n_dims may be 0.
/// \param design any but `table`
/// \throws SetupError on more dimensions than the Sobol' sequence has
std::vector<std::vector<double>> draw_unit_cube(Design design, std::size_t n, std::size_t n_dims,
                                                std::uint64_t seed);

}  // namespace sturz
