// SPDX-License-Identifier: Apache-2.0
// Hash of the final state of every shipped scene: a change of structure must not change one.
#include "ensemble/sampling/design.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/bench/commands.hpp"
#include "tests/hard/states.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::bench {
namespace {

/// About so many steps a scene: enough to slide, sort anew and leave the initial state behind.
constexpr double steps_per_scene = 300;

struct Named {
  std::string name;
  Scenario scenario;
};

std::vector<Named> catalogue() {
  std::vector<Named> out;
  for (const std::string& name : catalogue_names()) out.push_back({name, catalogue_scene(name)});
  for (const char* name : {"ramp_slide", "cliff"})
    out.push_back({fmt::format("{}, all states", name),
                   test::with_states(catalogue_scene(name), test::States::all, 0.7, true)});
  return out;
}

std::vector<Named> shipped() {
  std::vector<Named> out;
  for (const char* name : {"zhangjiawan", "shuicheng_dry"})
    for (const char* formulation : {"full_stress", "depth_averaged"}) {
      const std::string file =
          fmt::format("{}/scenarios/cases/{}/scenario.yaml", STURZ_SOURCE_DIR, name);
      Scenario s = median_scenario(
          read_scenario(file, {fmt::format("formulation={}", formulation),
                               "numerics.accept_unresolved=true", "numerics.spacing_m=6"}));
      out.push_back({fmt::format("{}, {}", name, formulation), std::move(s)});
    }
  return out;
}

std::uint64_t hash_of(const Scenario& s, const SceneInputs& inputs, int threads,
                      InstructionSet set) {
  return assemble(s, inputs, 0, threads, set).run().state_hash;
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> out;
  for (const auto set : {InstructionSet::avx2, InstructionSet::avx512})
    if (supports(set)) out.push_back(set);
  if (out.empty()) out.push_back(best_instruction_set());
  return out;
}

}  // namespace

Report hashes(const Options&) {
  Report report;
  Table table("hashes", "State hash after about 300 steps",
              {{"scene", "scene"},
               {"formulation", "formulation"},
               {"hash", "hash"},
               {"same", "same on 1 and 2 threads, on every instruction set"}});
  std::vector<Named> scenes = catalogue();
  for (Named& n : shipped()) scenes.push_back(std::move(n));
  for (Named& n : scenes) {
    const SceneInputs inputs = load_scene_inputs(n.scenario);
    const SceneDescription d = describe(n.scenario, inputs);
    Scenario& s = n.scenario;
    s.numerics.end_time_s = std::min(d.end_time_s, steps_per_scene * d.dt_s);
    const std::uint64_t first = hash_of(s, inputs, 1, instruction_sets().front());
    bool same = true;
    for (const auto set : instruction_sets())
      for (int threads : {1, 2}) same = same && hash_of(s, inputs, threads, set) == first;
    report.failed = report.failed || !same;
    table.add(
        {cell(n.name), cell(d.formulation), cell(fmt::format("{:016x}", first)), yes_no(same)});
  }
  report.tables.push_back(std::move(table));
  return report;
}

}  // namespace sturz::bench
