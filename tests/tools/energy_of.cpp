// SPDX-License-Identifier: Apache-2.0
// Runs one scene and says where its energy went, as a line of JSON: for studies that hold
// formulations against each other. Usage: energy_of SCENE.yaml
#include "engine/simulation/member_result.hpp"
#include "engine/simulation/parts.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace sturz {
namespace {

/// Of the energy that was released, by the member's own accounts [J].
void print(const MemberResult& r, const Ledger& l) {
  const MemberScalars& s = r.scalars;
  fmt::print(
      "{{\"outcome\": \"{}\", \"n_particles\": {}, \"layers\": {:.6g}, \"front_m\": {:.6g}, "
      "\"runout_m\": {:.6g}, \"com_m\": {:.6g}, \"com_drop_m\": {:.6g}, \"com_ratio\": {:.6g}, "
      "\"speed_m_s\": {:.6g}, \"deposit_m2\": {:.6g}, \"max_deposit_m\": {:.6g}, "
      "\"end_s\": {:.6g}, \"n_steps\": {}, \"cpu_s\": {:.6g}, ",
      to_string(r.outcome), s.n_particles, s.release_layers, s.front_travel_m, s.runout_m,
      s.com_travel_m, s.com_drop_m, s.com_ratio, s.max_speed_m_s, s.deposit_area_m2,
      s.max_deposit_m, s.end_time_s, s.n_steps, s.cpu_s);
  fmt::print(
      "\"released_j\": {:.6g}, \"bed_j\": {:.6g}, \"inside_j\": {:.6g}, \"impacts_j\": {:.6g}, "
      "\"numerical_j\": {:.6g}, \"kinetic_j\": {:.6g}, \"residual_j\": {:.6g}, \"mass_kg\": "
      "{:.6g}, "
      "\"warnings\": \"{}\"}}\n",
      l.released_energy(), l.friction, l.plastic, l.collisions + l.damping() + l.rest_damping,
      l.numerical(), l.kinetic, l.residual(), l.released_mass, r.warnings);
}

int run(const char* file) {
  const Scenario scene = read_scenario_file(file, {}).scenario;
  const SceneInputs inputs = load_scene_inputs(scene);
  Simulation member = assemble(scene, inputs, 0, 1);
  const MemberResult result = member.run();
  print(result, member.parts().state.ledger());
  return 0;
}

}  // namespace
}  // namespace sturz

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: energy_of SCENE.yaml\n");
    return 2;
  }
  try {
    return sturz::run(argv[1]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
