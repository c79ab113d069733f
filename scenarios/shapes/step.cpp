// SPDX-License-Identifier: Apache-2.0
// Two slopes, one above the other, and the even face between them: a cliff. The face starts at
// s = 0, elevation 0.
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {
namespace {

SyntheticScene build(const Numbers& p, double cell_m) {
  constexpr double degree = std::numbers::pi / 180;
  const Frame frame(p.at("azimuth_deg"));
  const double s = p.at("length_m") / 2, n = p.at("width_m") / 2;
  const double fall = std::tan(p.at("slope_deg") * degree);
  const double face = std::tan(p.at("face_deg") * degree);
  const double run = p.at("drop_m") / face;
  return {fill(frame.grid_over(-s, s, -n, n, cell_m),
               [&](double x, double y) {
                 const double at = frame.s(x, y);
                 const double on_face = std::clamp(at, 0.0, run);
                 return -face * on_face - fall * (at - on_face);
               }),
          std::nullopt};
}

}  // namespace

Shape step() {
  return {"step",
          false,
          {{"drop_m", 20, 0.001, 5000, "height of the face"},
           {"face_deg", 60, 1, 85, "inclination of the face"},
           {"slope_deg", 0, 0, 60, "inclination above and below the face"},
           {"length_m", 200, 0.01, 1e5, "extent downhill, on the map; the face is in its middle"},
           {"width_m", 100, 0.01, 1e5, "extent across"},
           {"azimuth_deg", 90, -360, 360, azimuth_help}},
          build};
}

}  // namespace sturz::shapes
