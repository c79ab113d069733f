// SPDX-License-Identifier: Apache-2.0
/// A small slide with what was measured of it, and calibrate in a folder of its own.
#pragma once

#include "tests/app/app_fixture.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace sturz::test {

/// Columns down a slope onto level ground, where every member comes to rest; hundredths of a
/// second.
inline const std::string slide = R"(title: small slide onto level ground
terrain:
  synthetic: {ramp: {cell_size_m: 2, slope_deg: 30, slope_length_m: 80, transition_m: 20, level_length_m: 300, width_m: 160}}
release:
  box: {x_m: [-60, -48], y_m: [-6, 6]}
  thickness_m: 2
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal:
  friction_coefficient: {uniform: [0.25, 0.5]}
  pore_pressure_ratio: {uniform: [0.0, 0.3]}
numerics: {spacing_m: 1, end_time_s: 60}
ensemble: {design: sobol, members: 6, seed: 1}
hazard: {cell_size_m: 2, thickness_m: [0.5], speed_m_s: [1], energy_kj_m2: [1], pressure_kpa: [1]}
formulation: depth_averaged
)";

class Calibrate : public App {
 protected:
  Calibrate() {
    write("plain.yaml", slide);
    write("scene.yaml", slide +
                            "observation:\n"
                            "  runout_m: {value: 100, sd: 2}\n"
                            "  speeds: [{point_m: [-12, 0], speed_m_s: 14, sd_m_s: 1}]\n");
  }

  Ended calibrate(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"calibrate", path("scene.yaml"), "-o", path("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sturz(arguments);
  }
};

inline std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace sturz::test
