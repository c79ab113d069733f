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
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/readable.hpp"

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
  for (const std::string& name : o.wanted)
    if (name != map_word) request.results.push_back(name);
  request.command = command_text(o);
  return request;
}

std::string percent(double share, const char* format = "{:.1f} %") {
  return std::isfinite(share) ? fmt::format(fmt::runtime(format), 100 * share) : "unknown";
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
    for (const double d : ladder.spacings_m) cells.push_back(percent(r.relative_error(d)));
    line(r.name, cells, order_text(r.refinement));
  }
  for (const MapAccuracy& m : ladder.maps) {
    std::vector<std::string> cells;
    for (const double e : m.relative_errors) cells.push_back(percent(e));
    line(fmt::format("map > {:g} m", m.threshold_m), cells, "");
  }
}

/// What the table cannot say.
void say_notes(const LadderAccuracy& ladder, Console& console) {
  std::string without;
  double noise = 0;
  bool looked = false;
  for (const ResultAccuracy& r : ladder.results) {
    if (!r.refinement.converges) without += (without.empty() ? "" : ", ") + r.name;
    if (!std::isfinite(r.noise)) continue;
    looked = true;
    noise = std::max(noise, r.noise / r.scale());
  }
  if (!ladder.not_told.empty())
    console.say(
        fmt::format("  Not told: {}. Every member was cut off, by an edge or its end time, "
                    "at one spacing or another.",
                    fmt::join(ladder.not_told, ", ")));
  for (const ResultAccuracy& r : ladder.results)
    if (r.n_members < static_cast<std::int64_t>(ladder.members.size()))
      console.say(
          fmt::format("  {} is told by {} members: the others were cut off, by an edge or "
                      "their end time.",
                      r.name, r.n_members));
  if (!without.empty())
    console.say("  No order: at these spacings the means of " + without +
                " approach no limit; their errors are guessed from the range of the means.");
  if (looked)
    console.say(fmt::format("  A displacement of 1e-7 of the values moves a member by up to {}.",
                            percent(noise, "{:.2g} %")));
}

void say_choice(const LadderAccuracy& ladder, const CostQuestions& questions, Console& console) {
  const Choice choice = cheapest_for(ladder, questions.wanted, questions.wanted_error);
  const std::string wanted = percent(questions.wanted_error, "{:g} %");
  if (std::isfinite(choice.spacing_m))
    console.say(fmt::format(
        "  Within {}: {:.3g} m{}, about {} of one core a member (largest: {}, {})", wanted,
        choice.spacing_m, choice.coarsest ? " or coarser (the coarsest that was computed)" : "",
        workflow::duration_text(choice.member_cpu_s), choice.predicted.of,
        percent(choice.predicted.error)));
  else if (std::isfinite(choice.finer_spacing_m))
    console.say(
        fmt::format("  Within {}: finer than was computed; by the orders about {:.2g} m, {} "
                    "of one core a member (extrapolated)",
                    wanted, choice.finer_spacing_m,
                    workflow::duration_text(ladder.seconds.at(choice.finer_spacing_m))));
  else
    console.say(
        fmt::format("  Within {}: not at these spacings ({} is {} off at the finest), and "
                    "no order says where. Add finer ones.",
                    wanted, choice.predicted.of, percent(choice.predicted.error)));
}

void say_split(const CostStudy& study, const LadderAccuracy& ladder, const CostQuestions& questions,
               Console& console) {
  const double core_s = workflow::core_seconds(study, ladder, questions);
  const Split best = best_split(ladder, core_s);
  if (!std::isfinite(best.error)) return;
  const auto words = [](const Split& s) {
    return fmt::format("{:.0f} members at {:.3g} m are {} off (resolution {}, sampling {})",
                       s.members, s.spacing_m, percent(s.error), percent(s.resolution),
                       percent(s.sampling));
  };
  console.say(fmt::format(
      "  Best for {} of one core{}: {}", workflow::duration_text(core_s),
      questions.core_s > 0 ? "" : " (the planned members at the finest spacing)", words(best)));
  const Split finest = split_at(ladder, core_s, ladder.spacings_m.back());
  if (std::isfinite(finest.error) && finest.error > 1.1 * best.error)
    console.say("  against: " + words(finest));
}

void say_certainty(const CostStudy& study, std::size_t i, Console& console) {
  const double finest = study.ladders[i].spacings_m.back();
  console.say(fmt::format("  {} planned members at {:g} m are off by about", study.planned_members,
                          finest));
  console.say(fmt::format("  {:<17}{:>10}{:>12}{:>9}", "", "sampling", "resolution", "model"));
  for (const workflow::Certainty& c :
       workflow::certainty_at(study, i, finest, study.planned_members))
    console.say(fmt::format("  {:<17}{:>10}{:>12}{:>9}", c.result, percent(c.sampling),
                            percent(c.resolution),
                            std::isfinite(c.model) ? percent(c.model) : "?"));
  if (study.models.empty()) console.say("  ?: no other formulation was computed (--formulations)");
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
        "{}: about how far means are off, of {} of {} members drawn alike at every spacing",
        ladder.formulation, ladder.members.size(), study.members));
    say_table(ladder, console);
    say_notes(ladder, console);
    say_choice(ladder, questions, console);
    say_split(study, ladder, questions, console);
    say_certainty(study, i, console);
  }
  for (const workflow::ModelDifference& m : study.models) {
    console.say(fmt::format("{} less {}, each at its finest, with the same values:", m.to, m.from));
    say_changes(m.changes, console);
  }
  for (const workflow::VariantCost& v : study.variants) {
    console.say(fmt::format("{} in {} at {:g} m: {:.2f} times the seconds", v.variant,
                            v.formulation, v.spacing_m, v.seconds_ratio));
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
  console.say("In " + study.folder.string() + ": cost.json, cost.csv, and a folder per ensemble");
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
  add_json(grammar, parser);
}

}  // namespace sturz::app
