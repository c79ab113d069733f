// SPDX-License-Identifier: Apache-2.0
#include "tests/support/tiny_scene.hpp"

#include <gtest/gtest.h>

namespace sturz::test {

std::string tiny_scene() {
  return R"(title: tiny slide
terrain:
  synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, width_m: 50}}
release:
  box: {x_m: [-50, -40], y_m: [-5, 5]}
  thickness_m: 3
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal:
  friction_coefficient: {uniform: [0.3, 0.7]}
  pore_pressure_ratio: {uniform: [0.0, 0.3]}
numerics: {spacing_m: 1, end_time_s: 3}
ensemble: {design: sobol, members: 6, seed: 1}
hazard: {cell_size_m: 2, thickness_m: [0.5, 1], speed_m_s: [1], energy_kj_m2: [1], pressure_kpa: [1]}
formulation: full_stress
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the scene has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace sturz::test
