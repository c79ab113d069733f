// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/levels.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/increments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace sturz::workflow {
namespace {

const char* const wanted_shape =
    "Write a formulation and a spacing in metres, such as full_stress 12, depth_averaged 9.";

LevelPart part_of(std::string formulation, double spacing_m) {
  LevelPart part{{}, std::move(formulation), spacing_m};
  part.name = fmt::format("{}_{:g}m", part.formulation, part.spacing_m);
  return part;
}

LevelPart parsed(const std::string& text) {
  const auto space = text.find(' ');
  const std::string word = text.substr(0, space);
  const std::string number = space == std::string::npos ? "" : text.substr(space + 1);
  const auto formulation = from_word<Formulation>(word);
  require(
      formulation && *formulation != Formulation::automatic,
      fmt::format("ensemble.levels: '{}' (no formulation of that name). {}", text, wanted_shape));
  double spacing = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), spacing);
  require(error == std::errc{} && end == number.data() + number.size() && spacing > 0 &&
              spacing <= 1000,
          fmt::format("ensemble.levels: '{}' (no spacing above 0 after the formulation). {}", text,
                      wanted_shape));
  return part_of(word, spacing);
}

/// Between commas, without spaces around.
std::vector<std::string> parts_of_list(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

std::vector<LevelPart> usual_levels(const LevelPart& own) {
  const double d = own.spacing_m;
  if (own.formulation == to_string(Formulation::full_stress))
    return {part_of(own.formulation, 2 * d), part_of("depth_averaged", 1.5 * d),
            part_of("depth_averaged", 3 * d)};
  return {part_of(own.formulation, 2 * d), part_of(own.formulation, 3 * d)};
}

}  // namespace

std::vector<LevelPart> level_parts(const Scene& scene) {
  std::vector<LevelPart> parts{part_of(scene.description.formulation, scene.description.spacing_m)};
  std::vector<LevelPart> cheaper;
  for (const std::string& text : parts_of_list(scene.scenario.ensemble.levels))
    cheaper.push_back(parsed(text));
  if (cheaper.empty()) cheaper = usual_levels(parts.front());
  require(cheaper.size() <= 6, "ensemble.levels (at most six cheaper levels). Name fewer.");
  for (LevelPart& part : cheaper) {
    require(std::none_of(parts.begin(), parts.end(),
                         [&](const LevelPart& p) { return p.name == part.name; }),
            fmt::format("ensemble.levels: {} {:g} (it stands there twice, or is the scene's own). "
                        "Remove it.",
                        part.formulation, part.spacing_m));
    parts.push_back(std::move(part));
  }
  return parts;
}

EnsembleRequest level_request(const EnsembleRequest& request, const LevelPart& part, double cell_m,
                              std::int64_t members) {
  EnsembleRequest r = request;
  std::vector<std::string>& set = r.scene.overrides;
  set.push_back("formulation=" + part.formulation);
  set.push_back(fmt::format("numerics.spacing_m={}", part.spacing_m));
  set.push_back(fmt::format("hazard.cell_size_m={}", cell_m));
  // A longer table begins with the shorter one, and its rows are independent.
  set.emplace_back("ensemble.design=monte_carlo");
  r.folder = request.folder / "levels" / part.name;
  r.members = static_cast<int>(members);
  return r;
}

void forget_estimator(Scenario& scenario) {
  const EnsembleSpec bare;
  scenario.ensemble.estimator = bare.estimator;
  scenario.ensemble.target = bare.target;
  scenario.ensemble.levels = bare.levels;
  scenario.ensemble.pilot = bare.pilot;
}

EnsembleJob prepare_level(const EnsembleRequest& request, const LevelPart& part, double cell_m,
                          std::int64_t members, Observer& observer) {
  const EnsembleRequest r = level_request(request, part, cell_m, members);
  try {
    Scene scene = load_scene(scene_of(r));
    forget_estimator(scene.scenario);
    return prepare_ensemble(r, std::move(scene), observer);
  } catch (const SetupError& problem) {
    throw SetupError(fmt::format("level {}: {}", part.name, problem.what()));
  }
}

}  // namespace sturz::workflow
