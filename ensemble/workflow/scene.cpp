// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/scene.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/map_models.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/readable.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/text_files.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/materials/materials.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <sstream>
#include <utility>

namespace sturz::workflow {

std::string at_their_places(const std::string& lines, const std::map<std::string, Position>& at) {
  std::string placed;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    std::string key = line.substr(0, line.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                            "0123456789_.[]"));
    auto found = at.find(key);
    while (found == at.end() && key.find_last_of(".[") != std::string::npos) {
      key.erase(key.find_last_of(".["));
      found = at.find(key);
    }
    if (!placed.empty()) placed += '\n';
    placed += (found != at.end() ? found->second.text() + ": " : "") + line;
  }
  return placed;
}

namespace {

/// Inputs and table of a scene, with what is wrong with either of them in one message.
void load_files(Scene& scene, const std::map<std::string, Position>& at) {
  std::string wrong;
  const auto collect = [&](const auto& read) {
    try {
      read();
    } catch (const SetupError& problem) {
      wrong.append(wrong.empty() ? "" : "\n").append(problem.what());
    }
  };
  // A single run keeps the table's name and has nothing left that it could say.
  if (scene.scenario.ensemble.design == Design::table && !uncertain_keys(scene.scenario).empty())
    collect([&] { new_design(scene.scenario); });
  collect([&] { require_language(scene.scenario.report.language, "report.language"); });
  collect([&] { scene.inputs = load_scene_inputs(scene.scenario); });
  require(wrong.empty(), at_their_places(wrong, at));
}

}  // namespace

Scene load_scene(const SceneRequest& request) {
  return scene_of(read_scenario_file(request.file, request.overrides),
                  request.predicts ? std::optional(request.speed_cache) : std::nullopt);
}

Scene scene_of(ScenarioFile file, const std::optional<SpeedCache>& cache) {
  Scene scene;
  scene.scenario = std::move(file.scenario);
  require(
      !scene.scenario.release.each_feature,
      at_their_places("release.each_feature: makes a region of the scene (one ensemble for each "
                      "feature; only `sturz ensemble`, `describe` and `merge` know regions). "
                      "Name one of them with release.feature and set release.each_feature: "
                      "false.",
                      file.positions));
  scene.medians = median_scenario(scene.scenario);
  load_files(scene, file.positions);
  for (std::string& note : material_notes(scene.scenario))
    scene.inputs.notes.push_back(std::move(note));
  scene.ground = std::make_shared<GrowingGround>(scene.scenario, scene.inputs);
  SceneDescription& d = scene.description;
  d = scene.ground->computed(
      [&](const SceneInputs& inputs) { return describe(scene.medians, inputs); });
  d.warnings.insert(d.warnings.begin(), scene.inputs.warnings.begin(), scene.inputs.warnings.end());
  if (!cache) return scene;
  d.predicted_seconds =
      d.n_steps * static_cast<double>(d.n_particles) / updates_per_second(d.formulation, *cache);
  return scene;
}

namespace {

/// When a member is over.
std::string end_line(const Scene& scene) {
  const SceneDescription& d = scene.description;
  return fmt::format(
      "end: {}{:.6g} s ({})",
      scene.scenario.numerics.stop_at_rest ? "at rest, at the latest after " : "after ",
      d.end_time_s, d.end_time_reason);
}

/// "bulk density: 1 560 kg/m3 (grains of 2600 kg/m3, solid fraction 0.6)".
std::string bulk_density_line(const Scene& scene) {
  const auto& fluid = scene.medians.fluid;
  if (!scene.medians.grains)
    return fmt::format("bulk density: {:.0f} kg/m3 (liquid alone)",
                       scene.description.bulk_density_kg_m3);
  const GrainsSpec& g = *scene.medians.grains;
  std::string line = fmt::format("bulk density: {:.0f} kg/m3 (grains of {:.6g} kg/m3",
                                 scene.description.bulk_density_kg_m3, g.density_kg_m3.value);
  if (scene.medians.mixture)
    line += fmt::format(", solid fraction {:.4g}, fluid of {:.6g} kg/m3", g.solid_fraction.value,
                        scene.medians.mixture->fluid_density_kg_m3.value);
  else if (fluid)
    line += fmt::format(", solid fraction {:.4g}, fluid of {:.6g} kg/m3 in {:.4g} % of the pores",
                        g.solid_fraction.value, fluid->density_kg_m3.value,
                        100 * fluid->saturation.value);
  else
    line += fmt::format(", solid fraction {:.4g}",
                        scene.description.bulk_density_kg_m3 / g.density_kg_m3.value);
  // Ice is the lightest grain there is; a lower number mostly was a bulk density.
  if (g.density_kg_m3.value < 900)
    line += fmt::format("; grains lighter than ice: if {:.6g} is the bulk density, write {:.5g}",
                        g.density_kg_m3.value, g.density_kg_m3.value / g.solid_fraction.value);
  return line + ")";
}

/// The volume that the other reading of the thicknesses gives, where there is a difference.
std::string readings_text(const Scene& scene) {
  const SceneDescription& d = scene.description;
  const ReleaseSpec& r = scene.scenario.release;
  const bool own_source =
      r.polygon.empty() && r.thickness_raster.empty() && !r.box && !r.paraboloid && !r.cylinder;
  const double ratio = d.normal_over_vertical;
  if (r.volume_m3 || own_source || ratio < 1.01) return "";
  if (r.thickness == ThicknessDirection::normal)
    return fmt::format(", thickness normal to the slope ({} m3 if it were vertical)",
                       grouped(d.release_volume_m3 / ratio));
  return fmt::format(", thickness vertical ({} m3 if it were normal to the slope)",
                     grouped(d.release_volume_m3 * ratio));
}

/// Maps of multilevel ensembles are not made in blocks.
std::string map_memory_line(const Scene& scene) {
  constexpr std::size_t some = 32;
  const std::size_t each = map_bytes_a_cell(most_levels, some),
                    more = map_bytes_a_cell(most_levels, some + 1) - each,
                    cells = scene.inputs.hazard_grid.n_cells();
  return fmt::format(
      "memory of multilevel maps: {:.1f} kB for each cell that some members reach and others do "
      "not, {} B more for each member of the scene's own above {}; at most {:.2g} GB, if that were "
      "all of the grid's {} cells",
      static_cast<double>(each) / 1e3, more, some, static_cast<double>(each * cells) / 1e9, cells);
}

}  // namespace

std::vector<std::string> description_lines(const Scene& scene) {
  const SceneDescription& d = scene.description;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("formulation: {} ({})", d.formulation, d.formulation_reason));
  std::string off;
  for (const EffectNote& effect : d.effects)
    if (effect.active)
      lines.push_back(fmt::format("effect {}: on ({})", effect.name, effect.reason));
    else
      off += fmt::format("{}{} ({})", off.empty() ? "" : ", ", effect.name, effect.reason);
  if (!off.empty()) lines.push_back("effects off: " + off);
  std::string passes;
  for (const std::string& pass : d.passes) passes += (passes.empty() ? "" : " > ") + pass;
  lines.push_back("step: " + passes);
  if (d.release_volume_m3 > 0)
    lines.push_back(fmt::format("release: {} m3 on {} m2", grouped(d.release_volume_m3),
                                grouped(d.release_area_m2)) +
                    readings_text(scene));
  if (d.inflow_volume_m3 > 0)
    lines.push_back(
        fmt::format("inflow: {} m3 until {:.6g} s", grouped(d.inflow_volume_m3), d.inflow_end_s));
  lines.push_back(bulk_density_line(scene));
  const bool columns = d.formulation == to_string(Formulation::depth_averaged);
  lines.push_back(fmt::format("{}: {}, {} m apart; {:.1f} spacings thick at {}",
                              columns ? "columns" : "particles", d.n_particles, d.spacing_m,
                              d.layers, d.release_volume_m3 > 0 ? "release" : "the inflow's peak"));
  if (columns)
    lines.emplace_back(
        has_two_phases(scene.scenario.mixture) ? "not in columns: vertical structure, dilute "
                                                 "states, excess pore pressure of two phases"
        : scene.scenario.mixture
            ? "not in columns: vertical structure, dilute states, water that runs ahead of the "
              "grains"
            : "not in columns: vertical structure, dilute states, a resolved pore fluid "
              "(pore_pressure_ratio stands for it; `mixture` computes it)");
  if (const auto idle = idle_keys(scene.scenario, columns, d.friction_inside); !idle.empty())
    lines.push_back(fmt::format("without effect in {}: {}", d.formulation, comma_separated(idle)));
  if (const auto idle = idle_layer_keys(scene.scenario); !idle.empty())
    lines.push_back(fmt::format("without effect here: {} (no `erosion`)", comma_separated(idle)));
  lines.push_back(
      fmt::format("memory: {:.1f} MB a member", static_cast<double>(d.memory_bytes) / 1e6));
  if (scene.scenario.ensemble.estimator.value_or(Estimator::plain) == Estimator::multilevel)
    lines.push_back(map_memory_line(scene));
  if (d.sound_speed_m_s > 0)
    lines.push_back(fmt::format("expected speed: {:.1f} m/s; numerical sound speed {:.0f} m/s",
                                d.reference_speed_m_s, d.sound_speed_m_s));
  lines.push_back(d.ground);
  lines.push_back(end_line(scene));
  lines.push_back(
      fmt::format("time step: {:.2g} s ({}) at half the expected speed", d.dt_s, d.binding_limit));
  return lines;
}

Manifest manifest_of(const Scene& scene, const std::string& kind, const std::string& command) {
  Manifest m;
  m.kind = kind;
  m.started = utc_now();
  m.command = as_utf8(command);  // names of files in it are bytes
  m.design = to_string(scene.scenario.ensemble.design);
  m.seed = scene.scenario.ensemble.seed;
  m.inputs = scene.ground->identities();
  m.description = description_lines(scene);
  m.notes = scene.inputs.notes;
  m.warnings = scene.description.warnings;
  m.spacing_m = scene.description.spacing_m;
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
