// SPDX-License-Identifier: Apache-2.0
#include "tests/support/liquid/impact_tank.hpp"

#include "engine/core/constants.hpp"

#include <cmath>

namespace sturz::test {

LiquidBox ImpactTank::scene(int across) {
  LiquidBox b;
  b.spacing = 2 * half_width / across;
  b.n = {static_cast<int>(std::lround(column / b.spacing)), across,
         static_cast<int>(std::lround(height / b.spacing))};
  b.corner = {west, -half_width, 0};
  b.half_width = 0.5 * length + 0.3;
  b.cell = b.spacing / 4;
  b.ground = [](double x, double y) {
    const double at = x - west;
    const bool on_box = at > face && at < face + box_length && std::abs(y) < box_half_width;
    return on_box ? box_height : 0.0;
  };
  b.domain.walls = {Wall{{west, 0, 0}, {1, 0, 0}}, Wall{{-west, 0, 0}, {-1, 0, 0}},
                    Wall{{0, -half_width, 0}, {0, 1, 0}}, Wall{{0, half_width, 0}, {0, -1, 0}}};
  b.settings.sound_speed = 20 * std::sqrt(standard_gravity * height);
  b.settings.least_sound_speed = 0.5 * b.settings.sound_speed;
  return b;
}

}  // namespace sturz::test
