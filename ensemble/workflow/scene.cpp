// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/scene.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/readable.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"

#include <fmt/core.h>

namespace sturz::workflow {

Scene load_scene(const SceneRequest& request) {
  Scene scene;
  scene.scenario = read_scenario(request.file, request.overrides);
  scene.medians = median_scenario(scene.scenario);
  scene.inputs = load_scene_inputs(scene.scenario);
  SceneDescription& d = scene.description;
  d = describe(scene.medians, scene.inputs);
  d.predicted_seconds = d.n_steps * static_cast<double>(d.n_particles) /
                        updates_per_second(d.formulation, request.speed_cache);
  return scene;
}

std::vector<std::string> description_lines(const Scene& scene) {
  const SceneDescription& d = scene.description;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("formulation: {} ({})", d.formulation, d.formulation_reason));
  for (const EffectNote& effect : d.effects)
    lines.push_back(fmt::format("effect {}: {} ({})", effect.name, effect.active ? "on" : "off",
                                effect.reason));
  std::string passes;
  for (const std::string& pass : d.passes) passes += (passes.empty() ? "" : " > ") + pass;
  lines.push_back("step: " + passes);
  lines.push_back(fmt::format("release: {} m3 on {} m2", grouped(d.release_volume_m3),
                              grouped(d.release_area_m2)));
  const bool columns = d.formulation == to_string(Formulation::depth_averaged);
  lines.push_back(fmt::format("{}: {}, {} m apart; {:.1f} spacings thick at release",
                              columns ? "columns" : "particles", d.n_particles, d.spacing_m,
                              d.layers));
  if (columns)
    lines.emplace_back(
        "not in columns: vertical structure, dilute states, a resolved pore fluid "
        "(pore_pressure_ratio stands for it)");
  lines.push_back(
      fmt::format("memory: {:.1f} MB a member", static_cast<double>(d.memory_bytes) / 1e6));
  if (d.sound_speed_m_s > 0)
    lines.push_back(fmt::format("expected speed: {:.1f} m/s; numerical sound speed {:.0f} m/s",
                                d.reference_speed_m_s, d.sound_speed_m_s));
  lines.push_back(fmt::format("time step: {:.2g} s ({}); about {} steps", d.dt_s, d.binding_limit,
                              grouped(d.n_steps)));
  lines.push_back(fmt::format("predicted: at most {} a member on one core",
                              duration_text(d.predicted_seconds)));
  return lines;
}

Manifest manifest_of(const Scene& scene, const std::string& kind, const std::string& command) {
  Manifest m;
  m.kind = kind;
  m.started = utc_now();
  m.command = as_utf8(command);  // names of files in it are bytes
  m.design = to_string(scene.scenario.ensemble.design);
  m.seed = scene.scenario.ensemble.seed;
  m.inputs = scene.inputs.checksums;
  m.description = description_lines(scene);
  m.notes = scene.inputs.notes;
  m.warnings = scene.description.warnings;
  m.spacing_m = scene.scenario.numerics.spacing_m;
  return m;
}

void save_scenario(const OutputFolder& folder, const Scenario& scenario) {
  const std::string text = write_scenario(scenario, folder.root);
  if (const auto byte = first_unreadable(text))
    throw SetupError(
        fmt::format("{}: a name of a file or folder that the scene needs holds {} (scenario files "
                    "are UTF-8 and "
                    "cannot name it). Rename it, or choose another place.",
                    folder.root.string(), byte->what));
  write_text_atomic(folder.scenario(), text);
}

}  // namespace sturz::workflow
