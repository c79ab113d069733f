// SPDX-License-Identifier: Apache-2.0
// Even slope through the map's origin at elevation 0.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/shape.hpp"

#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

SyntheticScene build(const Numbers& p, double cell_m) {
  const Frame frame(p.at("azimuth_deg"));
  const double s = p.at("length_m") / 2, n = p.at("width_m") / 2;
  const double fall = std::tan(p.at("slope_deg") * std::numbers::pi / 180);
  return {fill(frame.grid_over(-s, s, -n, n, cell_m),
               [&](double x, double y) { return -fall * frame.s(x, y); }),
          std::nullopt};
}

}  // namespace

Shape plane() {
  return {"plane",
          false,
          {{"slope_deg", 30, 0, 80, "inclination"},
           {"length_m", 200, 0.01, 1e5, "extent downhill, on the map"},
           {"width_m", 100, 0.01, 1e5, "extent across"},
           {"azimuth_deg", 90, -360, 360, azimuth_help}},
          build};
}

}  // namespace sturz::shapes
