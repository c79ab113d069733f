// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/shared_events.hpp"

#include "engine/core/error.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/calibration/shown_posterior.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "io/files/atomic_file.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

struct Event {
  std::string name;
  MergeInput input;
  Comparison comparison;
  FoundAt at;
};

/// Folder names, or paths where two are alike.
std::vector<std::string> names_of(const std::vector<fs::path>& folders) {
  std::vector<std::string> names, paths;
  std::set<std::string> different;
  for (const fs::path& folder : folders) {
    const fs::path clean = (folder / "").lexically_normal().parent_path();
    names.push_back(clean.filename().string());
    paths.push_back(clean.generic_string());
    different.insert(names.back());
  }
  return different.size() == folders.size() ? names : paths;
}

void require_drawn(const fs::path& folder, const Scenario& scenario) {
  const Design design = scenario.ensemble.design;
  require(
      design == Design::latin_hypercube || design == Design::sobol || design == Design::monte_carlo,
      fmt::format("{}: ensemble.design = {} (its members are not drawn from the distributions of "
                  "the scene). Use sobol, latin_hypercube or monte_carlo.",
                  folder.string(), to_string(design)));
}

Event read_event(const fs::path& folder, std::string name, Observer& observer, CancelFlag cancel) {
  Event event{std::move(name), open_for_maps({folder, false}, observer, cancel), {}, {}};
  const Scenario& scenario = event.input.finished.scenario;
  const SceneInputs& inputs = *event.input.finished.inputs;
  require(
      inputs.event != nullptr,
      fmt::format("{}: its scene has no `observation` block (a calibration needs something that "
                  "was seen or measured). Add one to the scene and run it again on the folder; "
                  "no member is computed anew.",
                  folder.string()));
  require_drawn(folder, scenario);
  event.comparison = score_members(event.input.store, inputs.event, cancel).comparison;
  const SceneDescription d = describe(median_scenario(scenario), inputs);
  event.at = {d.formulation, d.spacing_m, d.release_volume_m3, scenario.ensemble.members};
  return event;
}

std::vector<Event> read_events(const EventsRequest& request, Observer& observer,
                               CancelFlag cancel) {
  const std::vector<std::string> names = names_of(request.folders);
  std::vector<Event> events;
  for (std::size_t i = 0; i < names.size(); ++i) {
    require(std::count(names.begin(), names.end(), names[i]) == 1,
            fmt::format("{} is given twice (each event counts once). Name each folder once.",
                        names[i]));
    events.push_back(read_event(request.folders[i], names[i], observer, cancel));
    const MergeInput &first = events.front().input, &now = events.back().input;
    const std::string what =
        what_differs(first.finished.scenario, first.design, now.finished.scenario, now.design);
    require(
        what.empty(),
        fmt::format("{} and {} do not share their uncertain values: {} (a member has to mean "
                    "the same values in every event). Compute them with the same distributions, "
                    "ensemble.design, ensemble.seed and number of members.",
                    request.folders.front().string(), request.folders[i].string(), what));
  }
  return events;
}

/// What keys mean may depend on how they are used: said, not refused.
void warn_of_unlike(const std::vector<Event>& events, std::vector<std::string>& warnings) {
  const FoundAt& first = events.front().at;
  for (const Event& e : events) {
    if (e.at.formulation != first.formulation)
      warnings.push_back(
          fmt::format("{} is computed in {}, {} in {}: a value found together belongs "
                      "to neither alone.",
                      events.front().name, first.formulation, e.name, e.at.formulation));
    if (std::abs(e.at.spacing_m - first.spacing_m) > 1e-9 * first.spacing_m)
      warnings.push_back(
          fmt::format("{} has a spacing of {} m, {} of {} m: values may mean "
                      "something else there.",
                      events.front().name, first.spacing_m, e.name, e.at.spacing_m));
  }
}

CalibrationData data_of(const std::vector<Event>& events, std::vector<std::string>& warnings) {
  std::vector<Comparison> comparisons;
  std::vector<std::string> names;
  for (const Event& e : events) {
    comparisons.push_back(e.comparison);
    names.push_back(e.name);
  }
  const DesignTable& design = events.front().input.design;
  CalibrationData data;
  data.keys = design.keys;
  data.correlation = events.front().input.finished.scenario.ensemble.correlation;
  data.comparison = joint_comparison(comparisons, names, warnings);
  for (const std::int64_t m : data.comparison.simulated.members)
    data.cube.push_back(design.unit_cube.at(static_cast<std::size_t>(m)));
  data.n_drawn = data.cube.size();
  return data;
}

/// Members that are valid in some event only have no weight, but a line: a map of that event's
/// ensemble meets them.
void add_weightless(const std::vector<Event>& events, Calibrated& c) {
  if (c.found.member_weights.empty()) return;
  std::map<std::int64_t, double> weights;
  for (std::size_t i = 0; i < c.members.size(); ++i)
    weights[c.members[i]] = c.found.member_weights[i];
  for (const Event& e : events)
    for (const std::int64_t m : e.comparison.simulated.members) weights.emplace(m, 0.0);
  c.members.clear();
  c.found.member_weights.clear();
  for (const auto& [member, weight] : weights) {
    c.members.push_back(member);
    c.found.member_weights.push_back(weight);
  }
}

/// Members that --active chose for the one event. Of several events each has others, or none.
void take_chosen(const std::vector<Event>& events, const EventsRequest& request,
                 CalibrationData& data, Observer& observer, CancelFlag cancel,
                 std::vector<std::string>& warnings) {
  if (events.size() == 1) {
    const FinishedFolder& finished = events.front().input.finished;
    append(data, finished_rounds(finished.folder, 1, data.keys, finished.inputs->event, observer,
                                 cancel));
    return;
  }
  for (const fs::path& folder : request.folders)
    if (fs::exists(round_table(OutputFolder{folder}, 1)))
      warnings.push_back(fmt::format(
          "members that --active chose in {} have no say: the other events have none with the same "
          "values.",
          folder.string()));
}

bool is_about_values(const std::string& difference, const DesignTable& design) {
  const std::string key = difference.substr(0, difference.find(": "));
  if (key == "ensemble.design" || key == "ensemble.seed" || key == "ensemble.correlation")
    return true;
  return std::find(design.keys.begin(), design.keys.end(), key) != design.keys.end();
}

}  // namespace

std::string what_differs(const Scenario& a, const DesignTable& design_a, const Scenario& b,
                         const DesignTable& design_b) {
  if (design_a.keys != design_b.keys)
    return fmt::format("{} against {}", comma_separated(design_a.keys),
                       comma_separated(design_b.keys));
  for (const std::string& difference : differences(a, b))
    if (is_about_values(difference, design_a)) return difference;
  if (design_a.n_members() != design_b.n_members())
    return fmt::format("{} members against {}", design_a.n_members(), design_b.n_members());
  for (std::size_t i = 0; i < design_a.values.size(); ++i)
    for (std::size_t k = 0; k < design_a.keys.size(); ++k)
      if (design_a.values[i][k] != design_b.values[i][k] ||
          design_a.unit_cube.at(i)[k] != design_b.unit_cube.at(i)[k])
        return fmt::format("member {} has {} = {} and {}", i, design_a.keys[k],
                           design_a.values[i][k], design_b.values[i][k]);
  return "";
}

Comparison joint_comparison(const std::vector<Comparison>& comparisons,
                            const std::vector<std::string>& events,
                            std::vector<std::string>& warnings) {
  Comparison joint;
  std::map<std::int64_t, std::vector<Observation>> rows;
  std::map<std::int64_t, std::size_t> seen;
  for (std::size_t e = 0; e < comparisons.size(); ++e) {
    for (ObservedQuantity quantity : comparisons[e].observed) {
      if (comparisons.size() > 1) quantity.name = events[e] + "/" + quantity.name;
      joint.observed.push_back(std::move(quantity));
    }
    const auto& [members, values] = comparisons[e].simulated;
    for (std::size_t i = 0; i < members.size(); ++i) {
      auto& row = rows[members[i]];
      row.insert(row.end(), values[i].begin(), values[i].end());
      ++seen[members[i]];
    }
  }
  std::size_t left_out = 0;
  for (auto& [member, row] : rows) {
    if (seen[member] < comparisons.size()) {
      ++left_out;
      continue;
    }
    joint.simulated.members.push_back(member);
    joint.simulated.values.push_back(std::move(row));
  }
  require(!joint.simulated.members.empty(),
          "no member is valid in every event (there is nothing to compare). Their reasons are in "
          "members.csv of each folder.");
  if (left_out > 0)
    warnings.push_back(fmt::format("{} of {} members are not valid in every event and have no say.",
                                   left_out, rows.size()));
  return joint;
}

Calibrated calibrate_events(const EventsRequest& request, Observer& observer, CancelFlag cancel) {
  require(!request.folders.empty(), "no folder of an ensemble is named.");
  const bool several = request.folders.size() > 1;
  require(!several || !request.out.empty(),
          "several events need a folder for what they tell together. Name one with --out.");
  const OutputFolder out{request.out.empty() ? request.folders.front() : request.out};
  const std::vector<Event> events = read_events(request, observer, cancel);
  require(!several || !fs::exists(out.manifest()),
          fmt::format("{} holds results (what several events tell belongs to none of them). Choose "
                      "another folder with --out.",
                      out.root.string()));
  const Scenario& scenario = events.front().input.finished.scenario;
  std::vector<std::string> warnings;
  warn_of_unlike(events, warnings);
  CalibrationData data = data_of(events, warnings);
  CalibrationSettings settings;
  settings.method = request.method;
  settings.discrepancy = request.discrepancy;
  settings.seed = scenario.ensemble.seed;
  take_chosen(events, request, data, observer, cancel, warnings);
  const std::string left_out = leave_to_emulators(data, settings);
  if (!left_out.empty()) warnings.push_back(left_out);
  Calibrated c;
  c.found = calibrate(data, settings);
  cancel.check();
  c.found.warnings.insert(c.found.warnings.begin(), warnings.begin(), warnings.end());
  c.values = values_at(uncertain_keys(scenario), scenario.ensemble, c.found.posterior.cube);
  c.members = data.comparison.simulated.members;
  c.members.resize(data.n_drawn);  // the chosen ones stand behind
  c.n_drawn = static_cast<std::int64_t>(data.n_drawn);
  c.n_chosen = static_cast<std::int64_t>(data.cube.size() - data.n_drawn);
  c.discrepancy = request.discrepancy;
  c.seed = settings.seed;
  c.at = events.front().at;
  for (const Event& e : events)
    c.events.push_back({e.name, e.input.finished.folder.root.string(),
                        members_hash(e.input.store, e.input.design.n_members()),
                        e.at.release_volume_m3,
                        static_cast<std::int64_t>(e.comparison.simulated.members.size())});
  if (!several) {  // the folder's own, as the page and `--posterior` know it
    c.members_hash = c.events.front().members_hash;
    c.observation_hash =
        observation_hash(scenario, events.front().input.finished.inputs->identities);
  }
  c.keys = key_summaries(scenario, c);
  add_weightless(events, c);
  make_folder(out.root);
  write_posterior(out, c);
  return c;
}

}  // namespace sturz::workflow
