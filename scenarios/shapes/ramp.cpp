// SPDX-License-Identifier: Apache-2.0
// Even slope, parabolic transition without a kink, level ground at elevation 0: the ground of the
// energy-line test. Slope and level ground, continued, meet at s = 0.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/shape.hpp"

#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

SyntheticScene build(const Numbers& p, double cell_m) {
  const Frame frame(p.at("azimuth_deg"));
  const double fall = std::tan(p.at("slope_deg") * std::numbers::pi / 180);
  const double half = p.at("transition_m") / 2, n = p.at("width_m") / 2;
  return {fill(frame.grid_over(-p.at("slope_length_m"), p.at("level_length_m"), -n, n, cell_m),
               [&](double x, double y) {
                 const double s = frame.s(x, y);
                 if (s <= -half) return -fall * s;
                 if (s >= half) return 0.0;
                 return fall * (s - half) * (s - half) / (4 * half);
               }),
          std::nullopt};
}

}  // namespace

Shape ramp() {
  return {"ramp",
          false,
          {{"slope_deg", 30, 0, 80, "inclination of the upper part"},
           {"slope_length_m", 220, 0.01, 1e5, "extent of the slope, on the map"},
           {"transition_m", 40, 0.001, 1e4, "extent of the transition, half of it on the slope"},
           {"level_length_m", 300, 0.01, 1e5, "extent of the level ground"},
           {"width_m", 100, 0.01, 1e5, "extent across"},
           {"azimuth_deg", 90, -360, 360, azimuth_help}},
          build};
}

}  // namespace sturz::shapes
