// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/fidelity/cost_study.hpp"

#include "engine/core/error.hpp"
#include "ensemble/comparison/member_pairs.hpp"
#include "ensemble/fidelity/level_values.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/multilevel/multilevel_run.hpp"
#include "ensemble/workflow/without_folder.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr int usual_members = 16;
/// What a hazard map stands on; results that a scene does not have fall out by themselves.
const std::vector<std::string> looked_at{"runout_m",      "reached_area_m2", "com_travel_m",
                                         "max_speed_m_s", "max_thickness_m", "max_energy_j_m2"};

std::string name_of(const CostPart& part) {
  std::string name = fmt::format("{}_{:g}m", part.formulation, part.spacing_m);
  if (part.displaced) name += "_displaced";
  if (!part.variant.empty()) {
    name += "_";
    for (const char c : part.variant)
      name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ? c : '_';
  }
  return name;
}

std::vector<std::string> results_of(const CostRequest& request) {
  std::vector<std::string> results = looked_at;
  for (const std::string& name : request.results)
    if (std::find(results.begin(), results.end(), name) == results.end()) results.push_back(name);
  return results;
}

/// Each once, with the parts that it is true of where not all say it.
std::vector<std::string> warnings_of(const CostJob& job) {
  std::vector<std::pair<std::string, std::vector<std::string>>> all;
  for (std::size_t i = 0; i < job.jobs.size(); ++i)
    for (const std::string& warning : job.jobs[i].scene.description.warnings) {
      const auto known =
          std::find_if(all.begin(), all.end(), [&](const auto& w) { return w.first == warning; });
      auto& where = known == all.end()
                        ? all.emplace_back(warning, std::vector<std::string>{}).second
                        : known->second;
      where.push_back(job.parts[i].name);
    }
  std::vector<std::string> lines;
  for (const auto& [warning, where] : all)
    lines.push_back(where.size() == job.jobs.size()
                        ? warning
                        : fmt::format("{}: {}", fmt::join(where, ", "), warning));
  return lines;
}

std::vector<double> spacings_of(const CostRequest& request, const Scene& scene) {
  std::vector<double> spacings = request.spacings_m;
  if (spacings.empty())
    for (const double factor : {2.0, 1.5, 1.0})
      spacings.push_back(factor * scene.description.spacing_m);
  std::sort(spacings.rbegin(), spacings.rend());
  require(std::adjacent_find(spacings.begin(), spacings.end()) == spacings.end() &&
              spacings.size() >= 2 && spacings.back() > 0,
          "--spacings (two or more different ones above 0 are needed; three tell an order). Such "
          "as --spacings 8,6,4.");
  return spacings;
}

std::vector<CostPart> parts_of(const CostRequest& request, const Scene& scene) {
  const std::vector<double> spacings = spacings_of(request, scene);
  std::vector<std::string> formulations = request.formulations;
  if (formulations.empty()) formulations.push_back(scene.description.formulation);
  const double middle = spacings[spacings.size() / 2];
  const bool draws = !uncertain_keys(scene.scenario).empty();
  std::vector<CostPart> parts;
  require(
      !(request.check_m > 0) || request.check_m < spacings.back(),
      fmt::format("--check {:g} (it is no finer than the finest spacing, {:g} m, and would check "
                  "nothing). Such as --check {:g}.",
                  request.check_m, spacings.back(), spacings.back() / 2));
  for (const std::string& formulation : formulations) {
    for (const double spacing : spacings) parts.push_back({{}, formulation, spacing, {}, false});
    if (draws) parts.push_back({{}, formulation, middle, {}, true});
    if (request.check_m > 0) parts.push_back({{}, formulation, request.check_m, {}, false, true});
  }
  for (const std::string& variant : request.variants)
    parts.push_back({{}, formulations.front(), middle, variant, false});
  for (CostPart& part : parts) part.name = name_of(part);
  // The cheap ones tell first what is wrong.
  std::stable_sort(parts.begin(), parts.end(),
                   [](const CostPart& a, const CostPart& b) { return a.spacing_m > b.spacing_m; });
  return parts;
}

/// Each value moved by 1e-7 of its way to the median: inside every distribution.
std::string displaced_table(const EnsembleJob& twin) {
  const Scenario& scenario = twin.scene.scenario;
  const std::vector<std::vector<double>> middle =
      values_at(uncertain_keys(scenario), scenario.ensemble,
                {std::vector<double>(twin.design.keys.size(), 0.5)});
  std::string text = fmt::format("{}\n", fmt::join(twin.design.keys, ","));
  for (std::vector<double> row : twin.design.values) {
    for (std::size_t k = 0; k < row.size(); ++k) row[k] += 1e-7 * (middle.front()[k] - row[k]);
    std::string line;
    for (const double v : row) line += fmt::format("{}{:.17g}", line.empty() ? "" : ",", v);
    text += line + "\n";
  }
  return text;
}

EnsembleRequest request_of(const CostRequest& request, const CostPart& part, double cell_m) {
  EnsembleRequest r;
  r.scene = request.scene;
  std::vector<std::string>& set = r.scene.overrides;
  set.push_back("formulation=" + part.formulation);
  set.push_back(fmt::format("numerics.spacing_m={}", part.spacing_m));
  set.push_back(fmt::format("hazard.cell_size_m={}", cell_m));  // maps of one grid
  if (is_multilevel(request.scene)) set.emplace_back("ensemble.estimator=plain");
  if (!part.variant.empty()) set.push_back(part.variant);
  r.folder = request.folder / part.name;
  r.members = request.members > 0 ? request.members : usual_members;
  r.workers = request.workers;
  r.command = request.command;
  return r;
}

EnsembleRequest displaced_request(EnsembleRequest r, const EnsembleJob& twin) {
  const fs::path table = fs::path(r.folder).concat(".csv");
  make_folder(table.parent_path());
  write_text_atomic(table, displaced_table(twin));
  r.scene.overrides.insert(
      r.scene.overrides.end(),
      {"ensemble.design=table", "ensemble.table=" + yaml_quoted(fs::absolute(table)),
       "ensemble.correlation={}"});
  return r;
}

const EnsembleJob& job_of(const CostJob& study, const CostPart& wanted) {
  for (std::size_t i = 0; i < study.jobs.size(); ++i)
    if (study.parts[i].name == wanted.name) return study.jobs[i];
  throw std::logic_error("no part " + wanted.name);
}

/// A variant beside its rung tells an effect only where both drew the same.
void require_pairs(const CostJob& study) {
  for (std::size_t i = 0; i < study.parts.size(); ++i) {
    const CostPart& part = study.parts[i];
    if (part.variant.empty()) continue;
    CostPart twin = part;
    twin.variant.clear();
    const EnsembleJob& rung = job_of(study, {name_of(twin), {}, 0, {}, false});
    const std::string why = why_no_pairs(rung.design, study.jobs[i].design);
    require(why.empty(),
            fmt::format("--variant {}: members are no pairs of those without it ({}). Change a key "
                        "that is one number.",
                        part.variant, why));
  }
}

struct Found {
  std::vector<CostPart> parts;
  std::map<std::string, MemberStore> stores;  // by the part's name

  const MemberParts& of(const CostPart& part) const { return stores.at(part.name); }
};

/// The parts of one formulation's ladder, coarsest first.
std::vector<CostPart> rungs_of(const std::vector<CostPart>& parts, const std::string& formulation) {
  std::vector<CostPart> rungs;
  for (const CostPart& part : parts)
    if (part.formulation == formulation && part.variant.empty() && !part.displaced &&
        !part.held_out)
      rungs.push_back(part);
  return rungs;
}

LadderAccuracy ladder_of(const Found& found, const std::string& formulation,
                         LadderQuestions questions, CancelFlag cancel) {
  const std::vector<CostPart> parts = rungs_of(found.parts, formulation);
  std::vector<Rung> rungs;
  for (const CostPart& part : parts) rungs.push_back({part.spacing_m, &found.of(part)});
  const MemberParts* displaced = nullptr;
  std::size_t twin = 0;
  for (const CostPart& part : found.parts) {
    if (part.formulation == formulation && part.held_out)
      questions.held_out = {part.spacing_m, &found.of(part)};
    if (part.formulation != formulation || !part.displaced) continue;
    displaced = &found.of(part);
    while (parts[twin].spacing_m != part.spacing_m) ++twin;
  }
  return ladder_accuracy(formulation, rungs, displaced, twin, questions, cancel);
}

void look_beside(CostStudy& study, const Found& found, const std::vector<std::string>& results) {
  for (const CostPart& part : found.parts) {
    if (part.variant.empty()) continue;
    CostPart twin = part;
    twin.variant.clear();
    const MemberParts &rung = found.of({name_of(twin), {}, 0, {}, false}), &other = found.of(part);
    study.variants.push_back({part.variant, part.formulation, part.spacing_m,
                              seconds_ratio(rung, other), changes(rung, other, results)});
  }
  const auto finest = [&](const LadderAccuracy& ladder) -> const MemberParts& {
    return found.of(rungs_of(found.parts, ladder.formulation).back());
  };
  for (std::size_t i = 0; i < study.ladders.size(); ++i)
    for (std::size_t j = i + 1; j < study.ladders.size(); ++j)
      study.models.push_back(
          {study.ladders[i].formulation, study.ladders[j].formulation,
           changes(finest(study.ladders[i]), finest(study.ladders[j]), results)});
}

/// All rungs, the dearest first; of more than eight the cheapest of each formulation stay.
void look_at_levels(CostStudy& study, const Found& found, const LadderQuestions& questions,
                    CancelFlag cancel) {
  std::vector<std::pair<double, CostPart>> rungs;
  for (const LadderAccuracy& ladder : study.ladders) {
    const std::vector<CostPart> parts = rungs_of(found.parts, ladder.formulation);
    for (std::size_t l = 0; l < parts.size(); ++l)
      rungs.emplace_back(ladder.member_cpu_s[l], parts[l]);
  }
  std::sort(rungs.begin(), rungs.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  while (rungs.size() > 8) rungs.erase(rungs.begin() + 1);
  std::vector<std::string> names;
  std::vector<double> cost_s;
  std::vector<const MemberParts*> levels;
  for (const auto& [seconds, part] : rungs) {
    names.push_back(part.name);
    cost_s.push_back(seconds);
    levels.push_back(&found.of(part));
  }
  const double threshold = questions.thickness_m.empty() ? 0.1 : questions.thickness_m.front();
  const std::vector<std::string> headline{"runout_m", "reached_area_m2", "com_travel_m"};
  std::vector<LevelValues> numbers = level_values(levels, headline, threshold, cancel);
  std::vector<LevelValues> map;
  if (!numbers.empty() && numbers.back().name == map_word) {
    map.push_back(std::move(numbers.back()));
    numbers.pop_back();
  }
  for (const std::vector<LevelValues>& values : {numbers, map}) {
    if (values.empty()) continue;
    MultilevelForecast forecast{names, cost_s, {}, {}, {}};
    for (const LevelValues& r : values) {
      forecast.results.push_back(r.name);
      auto& row = forecast.squared_correlations.emplace_back();
      for (std::size_t l = 0; l < levels.size(); ++l) row.push_back(squared_correlation(r, l));
    }
    forecast.gain = multilevel_gain(values, cost_s, questions.seed);
    study.multilevel.push_back(std::move(forecast));
  }
}

}  // namespace

CostJob prepare_cost(const CostRequest& request, Observer& observer) {
  const Scene scene = load_scene(request.scene);
  const Design design = scene.scenario.ensemble.design;
  require(
      design == Design::sobol || design == Design::monte_carlo || design == Design::latin_hypercube,
      fmt::format("ensemble.design = {} (its members are no sample of what may happen). Use "
                  "--set ensemble.design=sobol.",
                  to_string(design)));
  CostJob study;
  study.request = request;
  study.planned_members = scene.scenario.ensemble.members;
  study.parts = parts_of(request, scene);
  WithoutFolder quiet(observer);
  for (const CostPart& part : study.parts) {
    EnsembleRequest r = request_of(request, part, scene.inputs.hazard_grid.cell_m);
    if (part.displaced) {
      CostPart twin = part;
      twin.displaced = false;
      r = displaced_request(std::move(r), job_of(study, {name_of(twin), {}, 0, {}, false}));
    }
    study.jobs.push_back(prepare_ensemble(r, quiet));
  }
  require_pairs(study);
  return study;
}

CostStudy compute_cost(const CostJob& job, Observer& observer, const std::atomic<bool>& cancel) {
  WithoutFolder quiet(observer);
  CostStudy study;
  study.folder = job.request.folder;
  study.parts = job.parts;
  Found found{job.parts, {}};
  for (std::size_t i = 0; i < job.jobs.size(); ++i) {
    const EnsembleJob& part = job.jobs[i];
    const MembersRun run = run_ensemble(part, quiet, cancel);
    require(run.stop_error.empty(), run.stop_error);
    if (run.interrupted) throw Cancelled();
    study.members = static_cast<int>(part.design.n_members());
    found.stores.emplace(job.parts[i].name,
                         members_of(part.folder, part.manifest, part.design, {}, cancel));
  }
  study.planned_given = job.planned_members > 0;
  study.planned_members = study.planned_given ? job.planned_members : study.members;
  study.warnings = warnings_of(job);
  const Scenario& scenario = job.jobs.front().scene.scenario;
  study.title = scenario.title;
  const LadderQuestions questions{results_of(job.request), scenario.hazard.thickness_m,
                                  scenario.ensemble.seed};
  observer.maps_begin();
  std::vector<std::string> done;
  for (const CostPart& part : job.parts) {
    if (std::find(done.begin(), done.end(), part.formulation) != done.end()) continue;
    done.push_back(part.formulation);
    study.ladders.push_back(ladder_of(found, part.formulation, questions, cancel));
  }
  look_beside(study, found, questions.results);
  look_at_levels(study, found, questions, cancel);
  return study;
}

}  // namespace sturz::workflow
