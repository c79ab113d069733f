// SPDX-License-Identifier: Apache-2.0
/// Small fixed-size vectors used at the engine's doors; hot loops work on plain arrays.
#pragma once

#include <Eigen/Core>

namespace sturz {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

}  // namespace sturz
