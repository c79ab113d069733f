// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/calibrate.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/sampling/marginal.hpp"
#include "ensemble/scores/score_sheet.hpp"
#include "ensemble/workflow/calibration/chosen_members.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/calibration/shown_posterior.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

CalibrationData data_of(const EnsembleJob& job, const MapsMade& maps) {
  CalibrationData data;
  data.keys = job.design.keys;
  data.correlation = job.scene.scenario.ensemble.correlation;
  data.comparison = maps.scores->comparison;
  for (const std::int64_t m : data.comparison.simulated.members)
    data.cube.push_back(job.design.unit_cube.at(static_cast<std::size_t>(m)));
  data.n_drawn = data.cube.size();
  return data;
}

CalibrationSettings settings_of(const CalibrateRequest& request, const EnsembleJob& job) {
  CalibrationSettings settings;
  settings.method = request.method;
  settings.discrepancy = request.discrepancy;
  settings.seed = job.scene.scenario.ensemble.seed;
  if (request.active_rounds > 0) settings.method = PosteriorMethod::emulator;
  return settings;
}

std::size_t round_size(const CalibrateRequest& request, std::size_t n_keys) {
  return request.active_members > 0 ? static_cast<std::size_t>(request.active_members)
                                    : std::max<std::size_t>(4, 2 * n_keys);
}

/// Chosen members join the data round by round, until the emulators know the posterior; then those
/// of rounds beyond that an earlier call computed.
void run_rounds(const CalibrateRequest& request, const EnsembleJob& job, CalibrationData& data,
                Observer& observer, const std::atomic<bool>& cancel) {
  const CalibrationSettings settings = settings_of(request, job);
  for (int round = 1; round <= request.active_rounds; ++round) {
    const auto table = round_table(job.folder, round);
    std::vector<std::vector<double>> points;
    if (!std::filesystem::exists(table)) {
      points = points_to_compute(data, settings, round_size(request, data.keys.size()));
      if (points.empty()) {
        observer.warning(fmt::format(
            "round {} of {} has nothing to add: the emulators know the posterior well enough.",
            round, request.active_rounds));
        return;
      }
    }
    append(data, compute_chosen(request.ensemble, job, table, points, observer, cancel));
  }
  append(data, finished_rounds(job.folder, request.active_rounds + 1, data.keys,
                               job.scene.inputs.event, observer, CancelFlag(cancel)));
}

/// More than three standard deviations from what is expected, on either side of a step that is not
/// ruled out.
bool is_far_off(double value, const SimulatedValue& expected) {
  const auto far = [value](double mean, double variance) {
    return (value - mean) * (value - mean) > 9 * variance;
  };
  constexpr double ruled_out = 0.05;
  return far(expected.value, expected.variance) &&
         (expected.other_share < ruled_out || far(expected.other_value, expected.other_variance));
}

/// The member at the best fit, beside what the emulators expected of it.
void check_best(const CalibrateRequest& request, const EnsembleJob& job, Calibrated& c,
                Observer& observer, const std::atomic<bool>& cancel) {
  // Its name tells the point: another posterior has another best fit, and both may lie there.
  std::uint64_t name = 1469598103934665603ULL;
  for (const double x : c.found.best->cube)
    name = (name ^ static_cast<std::uint64_t>(std::llround(x * 1e9))) * 1099511628211ULL;
  const auto table = job.folder.root / "best" / fmt::format("{:016x}.csv", name);
  const ChosenMembers member =
      compute_chosen(request.ensemble, job, table, {c.found.best->cube}, observer, cancel);
  if (member.comparison.simulated.values.empty()) {
    c.found.warnings.emplace_back("the member at the best fit failed: nothing confirms it.");
    return;
  }
  std::vector<Observation> row;
  for (std::size_t q = 0; q < c.found.observed.size(); ++q) {
    const ObservedQuantity& o = c.found.observed[q];
    const auto& all = member.comparison.observed;
    const auto place = std::find_if(all.begin(), all.end(),
                                    [&](const auto& other) { return other.name == o.name; });
    row.push_back(
        member.comparison.simulated.values.front()[static_cast<std::size_t>(place - all.begin())]);
    const SimulatedValue& expected = c.found.best->simulated[q];
    if (row.back().known == Known::exactly && is_far_off(row.back().value, expected))
      c.found.warnings.push_back(fmt::format(
          "{}: the member at the best fit gives {:.4g} {}, the emulator {:.4g} +- {:.2g}: the "
          "emulator is not to be trusted there. Add --active rounds.",
          o.name, row.back().value, o.unit, expected.value, std::sqrt(expected.variance)));
  }
  c.best_member = std::move(row);
}

/// A member that was computed anyway may be nearer than the one that the emulator calls best.
void compare_best(const CalibrationData& data, Calibrated& c) {
  if (!c.best_member) return;
  const Observation best = misfit(c.found.observed, *c.best_member);
  double least = best.value;
  for (const auto& member : data.comparison.simulated.values) {
    const Observation one = misfit(data.comparison.observed, member);
    if (one.known == Known::exactly) least = std::min(least, one.value);
  }
  if (least < best.value)
    c.found.warnings.insert(
        c.found.warnings.begin(),
        fmt::format("the best fit is none: its member has a misfit of {:.3g}, the nearest of the "
                    "others {:.3g}. What the emulator says of the posterior is no surer than that.",
                    best.value, least));
}

}  // namespace

void append(CalibrationData& data, const ChosenMembers& more) {
  data.cube.insert(data.cube.end(), more.cube.begin(), more.cube.end());
  auto& [members, values] = data.comparison.simulated;
  for (std::size_t i = 0; i < more.cube.size(); ++i) members.push_back(-1);  // not of the ensemble
  values.insert(values.end(), more.comparison.simulated.values.begin(),
                more.comparison.simulated.values.end());
}

std::string leave_to_emulators(CalibrationData& data, const CalibrationSettings& settings) {
  const std::size_t n_chosen = data.cube.size() - data.n_drawn;
  const PosteriorMethod method =
      settings.method.value_or(chosen_method(data.cube.size(), data.keys.size()));
  if (n_chosen == 0 || method == PosteriorMethod::emulator) return "";
  data.cube.resize(data.n_drawn);
  data.comparison.simulated.members.resize(data.n_drawn);
  data.comparison.simulated.values.resize(data.n_drawn);
  return fmt::format(
      "{} members that earlier --active rounds chose have no say: they were not drawn from the "
      "distributions, and have no weight. --method emulator learns from them.",
      n_chosen);
}

std::vector<KeySummary> key_summaries(const Scenario& scenario, const Calibrated& c) {
  const auto keys = uncertain_keys(scenario);
  std::vector<std::vector<double>> best;
  if (c.found.best) best = values_at(keys, scenario.ensemble, {c.found.best->cube});
  std::vector<KeySummary> all;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    KeySummary s;
    s.key = keys[k].path;
    s.unit = keys[k].units;
    const Marginal marginal(keys[k].distribution, keys[k].path);
    std::vector<double> column;
    for (const auto& row : c.values) column.push_back(row[k]);
    constexpr double levels[] = {0.05, 0.5, 0.95};
    for (int i = 0; i < 3; ++i) {
      s.prior[i] = marginal.quantile(levels[i]);
      s.posterior[i] = weighted_quantile(column, c.found.posterior.weights, levels[i]);
    }
    s.variance_removed = c.found.identifiability.variance_removed[k];
    if (!best.empty()) s.best = best.front()[k];
    all.push_back(s);
  }
  return all;
}

FoundAt found_at(const Scene& scene) {
  return {scene.description.formulation, scene.description.spacing_m,
          scene.description.release_volume_m3, scene.scenario.ensemble.members};
}

EnsembleJob prepare_calibration(const CalibrateRequest& request, Observer& observer) {
  const Scene scene = load_scene(request.ensemble.scene);
  const Scenario& s = scene.scenario;
  require(scene.inputs.event != nullptr,
          fmt::format("{}: no `observation` block (a calibration needs something that was seen or "
                      "measured). Add one, see the user guide.",
                      request.ensemble.scene.file));
  require(!uncertain_keys(s).empty(),
          fmt::format("{}: no value is uncertain (there is nothing to calibrate). Give a key a "
                      "distribution, such as basal.friction_coefficient: {{uniform: [0.1, 0.5]}}.",
                      request.ensemble.scene.file));
  const Design design = s.ensemble.design;
  require(
      design == Design::latin_hypercube || design == Design::sobol || design == Design::monte_carlo,
      fmt::format("ensemble.design = {} (its members are not drawn from the distributions of "
                  "the scene). Use sobol, latin_hypercube or monte_carlo.",
                  to_string(design)));
  require(request.active_rounds == 0 || request.method != PosteriorMethod::weights,
          "--active with --method weights (chosen members have no weight, only an emulator can "
          "learn from them). Use --method emulator.");
  return prepare_ensemble(request.ensemble, observer);
}

Calibrated calibrate_ensemble(const CalibrateRequest& request, const EnsembleJob& job,
                              const MapsMade& maps, Observer& observer,
                              const std::atomic<bool>& cancel) {
  expect(maps.scores.has_value(), "an ensemble with an observation is scored");
  CalibrationData data = data_of(job, maps);
  run_rounds(request, job, data, observer, cancel);
  const CalibrationSettings settings = settings_of(request, job);
  const std::string left_out = leave_to_emulators(data, settings);
  Calibrated c;
  c.found = calibrate(data, settings);
  if (!left_out.empty()) c.found.warnings.insert(c.found.warnings.begin(), left_out);
  const auto keys = uncertain_keys(job.scene.scenario);
  c.values = values_at(keys, job.scene.scenario.ensemble, c.found.posterior.cube);
  c.members = data.comparison.simulated.members;
  c.members.resize(c.found.member_weights.size());  // the chosen ones stand behind
  c.n_drawn = static_cast<std::int64_t>(data.n_drawn);
  c.n_chosen = static_cast<std::int64_t>(data.cube.size() - data.n_drawn);
  c.discrepancy = request.discrepancy;
  c.seed = job.scene.scenario.ensemble.seed;
  c.at = found_at(job.scene);
  c.members_hash = job.manifest.maps_of;
  c.observation_hash = observation_hash(job.scene.scenario, job.manifest.inputs);
  c.keys = key_summaries(job.scene.scenario, c);
  if (!c.found.best || !request.check_best) return c;
  write_posterior(job.folder, c);
  try {
    check_best(request, job, c, observer, cancel);
    compare_best(data, c);
  } catch (const SetupError& problem) {
    c.found.warnings.push_back(fmt::format(
        "nothing confirms the best fit, its member was not computed: {}", problem.what()));
  }
  return c;
}

}  // namespace sturz::workflow
