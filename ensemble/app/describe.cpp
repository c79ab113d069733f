// SPDX-License-Identifier: Apache-2.0
// sturz describe: what a scene is and what it will cost, before anything is computed.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/forecast_json.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/region/region.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/cost_warnings.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/ensemble_warnings.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "ensemble/workflow/scene.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sturz::app {
namespace {

struct Options {
  std::string scenario;
  std::vector<std::string> set;  ///< "key=value"
  bool measure_again = false;    ///< forget the cached speed of this machine
};

using workflow::Scene;

std::string as_json(const Scene& scene, const workflow::Forecast& forecast,
                    const std::vector<std::string>& warnings) {
  const SceneDescription& d = scene.description;
  nlohmann::ordered_json effects = nlohmann::ordered_json::array();
  for (const EffectNote& e : d.effects)
    effects.push_back({{"name", e.name}, {"active", e.active}, {"reason", e.reason}});
  nlohmann::ordered_json uncertain = nlohmann::ordered_json::object();
  for (const UncertainKey& key : uncertain_keys(scene.scenario))
    uncertain[key.path] = distribution_text(key.distribution);
  const nlohmann::ordered_json all = {{"title", scene.scenario.title},
                                      {"formulation", d.formulation},
                                      {"formulation_reason", d.formulation_reason},
                                      {"effects", effects},
                                      {"passes", d.passes},
                                      {"n_particles", d.n_particles},
                                      {"spacing_m", d.spacing_m},
                                      {"layers", d.layers},
                                      {"release_volume_m3", d.release_volume_m3},
                                      {"release_area_m2", d.release_area_m2},
                                      {"inflow_volume_m3", d.inflow_volume_m3},
                                      {"inflow_end_s", d.inflow_end_s},
                                      {"normal_over_vertical", d.normal_over_vertical},
                                      {"bulk_density_kg_m3", d.bulk_density_kg_m3},
                                      {"narrow_side_m", d.narrow_side_m},
                                      {"memory_bytes", d.memory_bytes},
                                      {"reference_speed_m_s", d.reference_speed_m_s},
                                      {"sound_speed_m_s", d.sound_speed_m_s},
                                      {"dt_s", d.dt_s},
                                      {"binding_limit", d.binding_limit},
                                      {"n_steps", d.n_steps},
                                      {"predicted_seconds", d.predicted_seconds},
                                      {"forecast", forecast_json(forecast)},
                                      {"members", scene.scenario.ensemble.members},
                                      {"uncertain", uncertain},
                                      {"notes", scene.inputs.notes},
                                      {"warnings", warnings}};
  return json_text(all);
}

void print_uncertain(const Scene& scene, Console& console) {
  const auto keys = uncertain_keys(scene.scenario);
  if (keys.empty()) return console.say("uncertain: nothing; every value is a number");
  console.say("uncertain:");
  for (const UncertainKey& key : keys)
    console.say(
        fmt::format("  {} [{}]: {}", key.path, key.units, distribution_text(key.distribution)));
}

/// The members that an ensemble would have; none where the scene has none.
DesignTable design_of(const Scene& scene) {
  const EnsembleSpec& ensemble = scene.scenario.ensemble;
  if (ensemble.members > 0 || ensemble.design == Design::table)
    return workflow::new_design(scene.scenario);
  return {};
}

/// Its seconds and steps are the scene's from then on.
workflow::Forecast forecast_for(Scene& scene, const DesignTable& design,
                                const workflow::SpeedCache& cache) {
  workflow::ForecastRequest request;
  request.design = &design;
  request.members = design.n_members();
  request.workers = static_cast<int>(
      std::clamp<std::int64_t>(design.n_members(), 1, workflow::available_cores()));
  request.speed_cache = cache;
  request.start_s = process_seconds();
  workflow::Forecast forecast = workflow::forecast(scene, request);
  scene.description.predicted_seconds = forecast.member_s.likely;
  scene.description.n_steps = std::round(forecast.median_steps.likely);
  return forecast;
}

/// Those of the medians, of the members together, and of the time that all of it takes.
std::vector<std::string> all_warnings(const Scene& scene, const DesignTable& design,
                                      const workflow::Forecast& forecast) {
  std::vector<std::string> all = scene.description.warnings;
  const auto add = [&all](const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  if (design.n_members() > 0) add(workflow::ensemble_warnings(scene, design));
  add(workflow::cost_warnings(scene, std::max<std::int64_t>(design.n_members(), 1),
                              workflow::available_cores(), forecast.maps_s.likely));
  return all;
}

int describe(const Options& options, Console& console) {
  const workflow::SpeedCache cache = speed_cache(options.measure_again);
  const workflow::SceneRequest request{options.scenario, options.set, cache};
  if (workflow::is_region(request)) return region_describe(request, console);
  Scene scene = workflow::load_scene(request);
  const DesignTable design = design_of(scene);
  const workflow::Forecast forecast = forecast_for(scene, design, cache);
  const std::vector<std::string> warnings = all_warnings(scene, design, forecast);
  if (console.json()) {
    console.event(as_json(scene, forecast, warnings));
    return ok;
  }
  if (!scene.scenario.title.empty()) console.say(scene.scenario.title);
  for (const std::string& line : workflow::description_lines(scene)) console.say(line);
  print_uncertain(scene, console);
  for (const std::string& line : workflow::forecast_lines(forecast)) console.say(line);
  for (const std::string& note : scene.inputs.notes) console.say("note: " + note);
  for (const std::string& warning : warnings) console.warn(warning);
  return ok;
}

}  // namespace

void add_describe(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "describe",
                  "Say what a scene is and what it will take, from a trial of a second", describe);
  add_scenario(parser, options.scenario, options.set);
  parser.add_flag("--measure-again", options.measure_again, "Measure this machine's speed anew");
  add_json(grammar, parser, "One JSON object instead of words");
}

}  // namespace sturz::app
