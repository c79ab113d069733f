// SPDX-License-Identifier: Apache-2.0
/// Where mass crossed the edge of the known ground, in words.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <string>

namespace sturz {

/// "over the eastern edge (y 4625100 to 4626300)"; several places joined by "and", the one that
/// most simulations crossed first; "where the raster holds no elevation (x .., y ..)" for cells
/// that do not lie at the terrain's sides: holes, or the edge of a turned raster. Empty where the
/// maps hold no layer of what left, or it is 0. \param terrain the ground's grid: its sides are the
/// edge
std::string where_mass_left(const LayerStack& maps, const Grid& terrain);

}  // namespace sturz
