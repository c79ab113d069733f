// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/calibration/posterior_files.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "io/files/text_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Equal rows, scattered so that the first n of them are as even as all: an ensemble may want few.
std::vector<std::size_t> scattered_rows(const std::vector<double>& weights) {
  const std::vector<std::size_t> rows = resampled(weights, posterior_rows);
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [](std::size_t i) {  // golden section, modulo 1
    const double x = 0.6180339887498949 * static_cast<double>(i);
    return x - std::floor(x);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  std::vector<std::size_t> scattered;
  for (const std::size_t i : order) scattered.push_back(rows[i]);
  return scattered;
}

std::string table_text(const Calibrated& c) {
  std::string units, keys;
  for (const KeySummary& k : c.keys) {
    units += (units.empty() ? "" : ",") + k.unit;
    keys += (keys.empty() ? "" : ",") + k.key;
  }
  std::string text = fmt::format(
      "# posterior: rows of equal weight, scattered; a table for ensemble.table\n"
      "# units: {}\n{}\n",
      units, keys);
  for (const std::size_t i : scattered_rows(c.found.posterior.weights)) {
    std::string line;
    for (const double v : c.values[i]) line += fmt::format("{}{:.17g}", line.empty() ? "" : ",", v);
    text += line + "\n";
  }
  return text;
}

std::string weights_text(const Calibrated& c) {
  std::string text = "member,weight\n";
  for (std::size_t i = 0; i < c.members.size(); ++i)
    text += fmt::format("{},{}\n", c.members[i], c.found.member_weights[i]);
  return text;
}

Json three(const double (&v)[3]) {
  return {{"p5", number(v[0])}, {"median", number(v[1])}, {"p95", number(v[2])}};
}

Json keys_json(const Calibrated& c) {
  Json all = Json::array();
  for (const KeySummary& k : c.keys) {
    Json one{{"key", k.key},
             {"unit", k.unit},
             {"prior", three(k.prior)},
             {"posterior", three(k.posterior)},
             {"variance_removed", number(k.variance_removed)}};
    if (k.best) one["best_fit"] = number(*k.best);
    all.push_back(std::move(one));
  }
  return all;
}

Json predicted_json(const PredictedQuantity& p) {
  return {{"name", p.name},
          {"unit", p.unit},
          {"observed", number(p.observed)},
          {"p5", number(p.lower)},
          {"median", number(p.median)},
          {"p95", number(p.upper)},
          {"below", number(p.below)},
          {"ends_at_least", p.ends_at_least}};
}

Json held_out_events_json(const std::vector<HeldOutEvent>& events) {
  Json all = Json::array();
  for (const HeldOutEvent& e : events) {
    Json quantities = Json::array();
    for (const PredictedQuantity& p : e.quantities) quantities.push_back(predicted_json(p));
    all.push_back({{"event", e.event},
                   {"log_score", number(e.log_score)},
                   {"prior_log_score", number(e.prior_log_score)},
                   {"effective_size", number(e.effective_size)},
                   {"inside90", e.n_inside90},
                   {"quantities", std::move(quantities)}});
  }
  return all;
}

Json events_json(const std::vector<EventUsed>& events) {
  Json all = Json::array();
  for (const EventUsed& e : events)
    all.push_back({{"name", e.name},
                   {"folder", e.folder},
                   {"members_hash", e.members_hash},
                   {"release_volume_m3", number(e.release_volume_m3)},
                   {"members", e.n_valid}});
  return all;
}

Json held_out_json(const HeldOut& h) {
  Json quantities = Json::array(), reliability = Json::array();
  for (const HeldOutQuantity& q : h.quantities) {
    Json one = predicted_json(q.predicted);
    one["log_score"] = number(q.log_score);
    one["prior_log_score"] = number(q.prior_log_score);
    one["effective_size"] = number(q.effective_size);
    quantities.push_back(std::move(one));
  }
  for (const auto& [nominal, inside] : h.reliability)
    reliability.push_back({{"nominal", nominal}, {"inside", inside}});
  if (h.quantities.empty()) return nullptr;
  return {{"mean_log_score", number(h.mean_log_score)},
          {"prior_mean_log_score", number(h.prior_mean_log_score)},
          {"coverage50", h.coverage50},
          {"coverage90", h.coverage90},
          {"reliability", std::move(reliability)},
          {"quantities", std::move(quantities)}};
}

Json emulators_json(const Calibration& c) {
  Json all = Json::array();
  for (const EmulatorReport& e : c.emulators) {
    Json step = nullptr;
    if (e.step)
      step = {{"below", e.step->below},     {"above", e.step->above},
              {"least", e.step->least},     {"most", e.step->most},
              {"n_below", e.step->n_below}, {"n_above", e.step->n_above},
              {"sides_told", e.step->told}};
    all.push_back({{"quantity", e.quantity},
                   {"q2", number(e.q2)},
                   {"coverage95", number(e.coverage95)},
                   {"inflation", number(e.inflation)},
                   {"noise_sd", number(e.noise_sd)},
                   {"members", e.n_exact},
                   {"members_used", e.n_used},
                   {"at_least", e.n_at_least},
                   {"bounds_used", e.n_bounds_used},
                   {"not_known", e.n_not_known},
                   {"step", std::move(step)}});
  }
  return all;
}

Json identifiability_json(const Calibrated& c) {
  const Identifiability& id = c.found.identifiability;
  Json directions = Json::array(), ridges = Json::array();
  for (const Direction& d : id.directions)
    directions.push_back({{"variance_left", number(d.variance_left)}, {"along", d.along}});
  for (const Ridge& r : id.ridges)
    ridges.push_back(
        {{"keys", {c.keys[r.a].key, c.keys[r.b].key}}, {"correlation", number(r.correlation)}});
  Json correlation = Json::array();
  for (const auto& row : id.correlation) {
    Json& to = correlation.emplace_back(Json::array());
    for (const double v : row) to.push_back(number(v));
  }
  return {{"correlation", std::move(correlation)},
          {"directions", std::move(directions)},
          {"ridges", std::move(ridges)}};
}

Json best_json(const Calibrated& c) {
  if (!c.found.best) return nullptr;
  Json quantities = Json::array();
  for (std::size_t q = 0; q < c.found.observed.size(); ++q) {
    const ObservedQuantity& o = c.found.observed[q];
    Json one{{"name", o.name},
             {"unit", o.unit},
             {"observed", number(o.value)},
             {"emulated", number(c.found.best->simulated[q].value)},
             {"emulated_sd", number(std::sqrt(c.found.best->simulated[q].variance))}};
    if (c.best_member) {
      const Observation& real = (*c.best_member)[q];
      one["computed"] = real.known == Known::not_at_all ? Json(nullptr) : number(real.value);
      one["computed_is"] = real.known == Known::exactly    ? "known"
                           : real.known == Known::at_least ? "at least"
                                                           : "not known";
    }
    quantities.push_back(std::move(one));
  }
  return quantities;
}

Json sample_json(const Calibrated& c) {
  const Posterior& p = c.found.posterior;
  Json json{{"method", to_string(p.method)},
            {"reason", c.found.reason},
            {"members_drawn", c.n_drawn},
            {"members_chosen", c.n_chosen},
            {"points", p.cube.size()},
            {"effective_size", number(p.effective_size)},
            {"censored_share", number(p.censored_share)}};
  if (p.chains) {
    Json r_hat = Json::array();
    for (const double r : p.chains->r_hat) r_hat.push_back(number(r));
    json["chains"] = {{"r_hat", std::move(r_hat)}, {"acceptance", p.chains->acceptance}};
  }
  return json;
}

Json document(const Calibrated& c) {
  Json observed = Json::array(), discrepancies = Json::array(), check = Json::array();
  for (const ObservedQuantity& o : c.found.observed)
    observed.push_back(
        {{"name", o.name}, {"value", number(o.value)}, {"sd", number(o.sd)}, {"unit", o.unit}});
  for (const DiscrepancyFound& d : c.found.discrepancies)
    discrepancies.push_back({{"kind", d.kind},
                             {"mean", number(d.mean)},
                             {"p5", number(d.lower)},
                             {"p95", number(d.upper)}});
  for (const PredictedQuantity& p : c.found.check) check.push_back(predicted_json(p));
  const Build build = this_build();
  Json all{{"sturz", build.version},
           {"found_at",
            {{"formulation", c.at.formulation},
             {"spacing_m", c.at.spacing_m},
             {"release_volume_m3", c.at.release_volume_m3}}},
           {"members_hash", c.members_hash},
           {"observation_hash", c.observation_hash},
           {"seed", c.seed},
           {"sample", sample_json(c)},
           {"keys", keys_json(c)},
           {"observed", std::move(observed)},
           {"discrepancy", {{"prior_scale", c.discrepancy}, {"found", std::move(discrepancies)}}},
           {"predictive_check", std::move(check)},
           {"held_out", held_out_json(c.found.held_out)},
           {"identifiability", identifiability_json(c)},
           {"best_fit", best_json(c)},
           {"emulators", emulators_json(c.found)},
           {"warnings", c.found.warnings}};
  if (!c.events.empty()) all["events"] = events_json(c.events);
  if (!c.found.held_out.events.empty())
    all["held_out_events"] = held_out_events_json(c.found.held_out.events);
  return all;
}

fs::path json_file(const fs::path& folder) { return folder / "posterior.json"; }
fs::path csv_file(const fs::path& folder) { return folder / "posterior.csv"; }

}  // namespace

std::string posterior_json(const Calibrated& c) { return document(c).dump(2) + "\n"; }

namespace {

/// Maps by other weights than those of today would pass for today's.
void forget_weighted_maps(const OutputFolder& folder) {
  const OutputFolder weighted{folder.root / "weighted"};
  fs::remove(weighted.report());
  fs::remove(weighted.hazard_nc());
  remove_map_files(weighted.tif_folder());
  remove_gis_files(weighted);
}

/// weights.csv; none where no member explains anything.
void write_weights(const OutputFolder& folder, const Calibrated& c) {
  const fs::path file = folder.root / "weights.csv";
  const std::string text = c.members.empty() ? "" : weights_text(c);
  if (fs::exists(file) && read_text(file) == text) return;
  forget_weighted_maps(folder);
  if (text.empty())
    fs::remove(file);  // of an earlier calibration
  else
    write_text_atomic(file, text);
}

}  // namespace

// The numbers go first and come last: what is stopped in between leaves rows without numbers, which
// is no posterior, and never the rows of one calibration beside the numbers of another.
void write_posterior(const OutputFolder& folder, const Calibrated& c) {
  std::error_code ignored;
  fs::remove(json_file(folder.root), ignored);
  write_text_atomic(csv_file(folder.root), table_text(c));
  write_weights(folder, c);
  write_text_atomic(json_file(folder.root), posterior_json(c));
}

std::string yaml_quoted(const fs::path& path) {
  std::string quoted = "'";
  for (const char c : path.string()) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> posterior_overrides(const fs::path& folder) {
  require(
      fs::exists(csv_file(folder)) && fs::exists(json_file(folder)),
      fmt::format("{} holds no posterior (posterior.csv or posterior.json is missing). Name the "
                  "folder that `sturz calibrate` wrote.",
                  folder.string()));
  return {"ensemble.design=table", "ensemble.table=" + yaml_quoted(fs::absolute(csv_file(folder))),
          "ensemble.correlation={}"};
}

}  // namespace sturz::workflow
