// SPDX-License-Identifier: Apache-2.0
// sturz cost: how fine must one compute, and what does it cost.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/fidelity/cost_files.hpp"
#include "ensemble/workflow/fidelity/cost_study.hpp"
#include "ensemble/workflow/fidelity/cost_words.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace sturz::app {
namespace {

using workflow::CostQuestions;
using workflow::CostStudy;
using workflow::share_text;

struct Options {
  std::string scenario;
  std::vector<std::string> set;
  MembersOptions of;
  std::vector<double> spacings;
  std::vector<std::string> formulations;
  std::vector<std::string> variants;
  std::vector<std::string> wanted;
  double wanted_error = 0.05;
  double core_hours = 0;
  double check = 0;
};

std::string command_text(const Options& o) {
  std::string text = "cost " + o.scenario;
  for (const std::string& set : o.set) text += " --set " + set;
  return text;
}

workflow::CostRequest request_of(const Options& o) {
  workflow::CostRequest request;
  request.scene = {o.scenario, o.set, speed_cache()};
  request.folder = o.of.out.empty() ? workflow::default_folder(o.scenario) + "_cost" : o.of.out;
  request.members = o.of.members;
  request.workers = o.of.workers;
  request.spacings_m = o.spacings;
  request.formulations = o.formulations;
  request.variants = o.variants;
  request.check_m = o.check;
  for (const std::string& name : o.wanted)
    if (name != map_word) request.results.push_back(name);
  request.command = command_text(o);
  return request;
}

std::string order_text(const Refinement& f) {
  if (!f.converges) return "none";
  if (!std::isfinite(f.order_90.low)) return fmt::format("{:.2f}", f.order);
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", f.order, f.order_90.low, f.order_90.high);
}

/// A line per result: how far its mean is about off at each spacing.
void say_table(const LadderAccuracy& ladder, Console& console) {
  const auto line = [&](const std::string& name, const std::vector<std::string>& cells,
                        const std::string& rest) {
    std::string text = fmt::format("  {:<17}", name);
    for (const std::string& cell : cells) text += fmt::format("{:>9}", cell);
    console.say(text + "  " + rest);
  };
  std::vector<std::string> heads, seconds;
  for (const double d : ladder.spacings_m) heads.push_back(fmt::format("{:.4g} m", d));
  for (const double s : ladder.member_cpu_s) seconds.push_back(fmt::format("{:.3g}", s));
  line("spacing", heads, "order (90 %)");
  line("CPU s a member", seconds, fmt::format("{:.1f}", ladder.seconds.exponent));
  for (const ResultAccuracy& r : ladder.results) {
    std::vector<std::string> cells;
    for (const double d : ladder.spacings_m) cells.push_back(share_text(r.member_error(d)));
    line(r.name, cells, order_text(r.refinement));
  }
  for (const MapAccuracy& m : ladder.maps) {
    std::vector<std::string> cells;
    for (const double d : ladder.spacings_m) cells.push_back(share_text(m.errors.at(d)));
    line(fmt::format("map > {:g} m", m.threshold_m), cells, "");
  }
}

void say_certainty(const CostStudy& study, std::size_t i, Console& console) {
  const double finest = study.ladders[i].spacings_m.back();
  console.say(fmt::format("  the mean of {} at {:g} m is off by about",
                          workflow::planned_text(study), finest));
  console.say(
      fmt::format("  {:<17}{:>16}{:>12}{:>9}", "", "sampling (90 %)", "resolution", "model"));
  for (const workflow::Certainty& c :
       workflow::certainty_at(study, i, finest, study.planned_members))
    console.say(fmt::format("  {:<17}{:>16}{:>12}{:>9}", c.result, share_text(c.sampling),
                            share_text(c.resolution),
                            std::isfinite(c.model) ? share_text(c.model) : "?"));
  if (study.models.empty()) console.say("  ?: no other formulation was computed (--formulations)");
}

std::string told_share(const CheckedError& c, double share) {
  return c.is_told() ? share_text(share) : "-";
}

void say_check(const LadderAccuracy& ladder, Console& console) {
  if (ladder.checked.empty()) return;
  console.say(fmt::format("  differences to {:g} m, which no estimate knew", ladder.held_out_m));
  console.say(fmt::format("  {:<17}{:>9}{:>9}{:>9}{:>8}{:>12}{:>9}", "", "spacing", "said", "found",
                          "factor", "mean: said", "found"));
  for (const CheckedError& c : ladder.checked)
    console.say(fmt::format("  {:<17}{:>9}{:>9}{:>9}{:>8}{:>12}{:>9}", workflow::name_of(c),
                            fmt::format("{:.4g} m", c.spacing_m), told_share(c, c.said),
                            told_share(c, c.found),
                            c.is_told() ? fmt::format("{:.2f}", c.factor()) : "-",
                            c.name == map_word ? "" : share_text(c.said_mean),
                            c.name == map_word ? "" : share_text(c.found_mean)));
}

void say_changes(const std::vector<Change>& changes, Console& console) {
  for (const Change& c : changes)
    console.say(fmt::format("  {:<16} {:+.3g} +- {:.2g} {} ({:+.1f} %), {} members", c.name, c.mean,
                            c.standard_error, c.units, 100 * c.mean / std::abs(c.rung_mean),
                            c.n_members));
}

void say_all(const CostStudy& study, const CostQuestions& questions, Console& console) {
  for (std::size_t i = 0; i < study.ladders.size(); ++i) {
    const LadderAccuracy& ladder = study.ladders[i];
    console.say(fmt::format(
        "{}: about how far one member is off (root mean square over {} of {} members, drawn alike "
        "at every spacing)",
        ladder.formulation, ladder.members.size(), study.members));
    say_table(ladder, console);
    for (const std::string& sentence : workflow::ladder_sentences(study, i, questions))
      console.say("  " + sentence);
    say_certainty(study, i, console);
    say_check(ladder, console);
  }
  for (const workflow::MultilevelForecast& f : study.multilevel)
    console.say(workflow::multilevel_sentence(f));
  for (const workflow::ModelDifference& m : study.models) {
    console.say(workflow::title_of(m) + ":");
    say_changes(m.changes, console);
  }
  for (const workflow::VariantCost& v : study.variants) {
    console.say(workflow::title_of(v));
    say_changes(v.changes, console);
  }
}

int cost(const Options& options, Console& console) {
  ConsoleObserver observer(console);
  const workflow::CostJob job = workflow::prepare_cost(request_of(options), observer);
  std::string names;
  for (const workflow::CostPart& part : job.parts) names += (names.empty() ? "" : ", ") + part.name;
  console.say(fmt::format("{} ensembles of {} members: {}", job.parts.size(),
                          job.jobs.front().design.n_members(), names));
  const CostStudy study = workflow::compute_cost(job, observer, interrupt_flag());
  CostQuestions questions;
  questions.wanted_error = options.wanted_error;
  questions.core_s = 3600 * options.core_hours;
  if (!options.wanted.empty()) questions.wanted = options.wanted;
  workflow::write_cost_files(study, questions);
  console.clear_progress();
  say_all(study, questions, console);
  for (const std::string& warning : study.warnings) console.warn(warning);
  console.say("In " + study.folder.string() +
              ": cost.html (look here first), cost.json, cost.csv, and a folder per ensemble");
  nlohmann::ordered_json done{{"event", "done"}, {"folder", study.folder.string()}};
  done["cost"] = nlohmann::ordered_json::parse(workflow::cost_json_text(study, questions));
  console.event(json_text(done));
  return ok;
}

}  // namespace

void add_cost(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "cost",
                  "What accuracy costs: errors and seconds over spacings and formulations", cost);
  add_scenario(parser, options.scenario, options.set);
  add_members(parser, options.of);
  parser
      .add_option("--spacings", options.spacings,
                  "Spacings in metres; 2, 1.5 and 1 times the scene's where none are named")
      ->type_name("M,M,...")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  parser
      .add_option("--formulations", options.formulations,
                  "Formulations; the scene's own where none is named")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->check(CLI::IsMember({"depth_averaged", "full_stress", "discrete"}));
  parser
      .add_option("--variant", options.variants,
                  "The scene with this change beside it, at the middle spacing; may be repeated")
      ->type_name("KEY=VALUE");
  std::set<std::string> names{map_word};
  for (const ScalarInfo& scalar : scalar_table()) names.insert(scalar.name);
  parser
      .add_option(
          "--for", options.wanted,
          "What has to be that exact: columns of members.csv, and map: the map of the least "
          "thickness; run-out, area, centre of mass and map where none is named")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->check(CLI::Validator(
          [names](const std::string& name) {
            return names.contains(name) ? std::string() : name + " is no column of members.csv";
          },
          ""));
  parser.add_option("--within", options.wanted_error, "Wanted relative error")
      ->type_name("SHARE")
      ->check(CLI::Range(1e-4, 1.0))
      ->capture_default_str();
  parser
      .add_option("--core-hours", options.core_hours,
                  "Computing time to split between spacing and members")
      ->type_name("HOURS")
      ->check(CLI::PositiveNumber);
  parser
      .add_option(
          "--check", options.check,
          "A finer spacing, computed too but kept from every estimate: tells what was said of "
          "it beside what was found")
      ->type_name("M")
      ->check(CLI::PositiveNumber);
  add_json(grammar, parser);
}

}  // namespace sturz::app
