// SPDX-License-Identifier: Apache-2.0
/// The tank of SPHERIC test 2 (Kleefsman and others 2005): a column of water, a box on the floor.
#pragma once

#include "tests/support/liquid/liquid_scene.hpp"

namespace sturz::test {

struct ImpactTank {
  static constexpr double length = 3.22, half_width = 0.5;  ///< [m]
  static constexpr double column = 1.228, height = 0.55;    ///< of the water
  static constexpr double west = -0.5 * length;             ///< x of the wall behind it
  /// Of the box: its upstream face is where the gauges are, from that wall.
  static constexpr double face = 2.42, box_length = 0.161, box_half_width = 0.2015,
                          box_height = 0.161;

  /// Tank walls are planes, the box is a step of the ground. \param across  particles over the
  /// width
  static LiquidBox scene(int across);
};

}  // namespace sturz::test
