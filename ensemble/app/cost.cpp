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

#include <cmath>
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
  request.command = command_text(o);
  return request;
}

std::string percent(double share, const char* format = "{:.1f} %") {
  return std::isfinite(share) ? fmt::format(fmt::runtime(format), 100 * share) : "unknown";
}

/// One line per spacing: estimated errors of means over many members.
void say_table(const LadderAccuracy& ladder, Console& console) {
  std::string head = "  spacing  CPU s a member";
  for (const ResultAccuracy& r : ladder.results) head += fmt::format("  {:>15}", r.name);
  for (const MapAccuracy& m : ladder.maps) head += fmt::format("  map > {:g} m", m.threshold_m);
  console.say(head);
  for (std::size_t l = 0; l < ladder.spacings_m.size(); ++l) {
    std::string line =
        fmt::format("  {:>5.4g} m  {:>14.3g}", ladder.spacings_m[l], ladder.member_cpu_s[l]);
    for (const ResultAccuracy& r : ladder.results)
      line += fmt::format("  {:>15}", percent(r.relative_error(ladder.spacings_m[l])));
    for (const MapAccuracy& m : ladder.maps)
      line += fmt::format("  {:>{}}", percent(m.relative_errors[l]),
                          fmt::format("map > {:g} m", m.threshold_m).size());
    console.say(line);
  }
}

void say_orders(const LadderAccuracy& ladder, Console& console) {
  for (const ResultAccuracy& r : ladder.results) {
    const Refinement& f = r.refinement;
    std::string text = f.converges
                           ? fmt::format("order {:.2f}, limit {:.4g} {}", f.order, f.limit, r.units)
                           : std::string(
                                 "no order: its means do not go one way, so errors are "
                                 "guessed from their range");
    if (f.converges && std::isfinite(f.order_90.low))
      text += fmt::format(" (90 %: order {:.2f} to {:.2f}, limit {:.4g} to {:.4g})", f.order_90.low,
                          f.order_90.high, f.limit_90.low, f.limit_90.high);
    if (std::isfinite(r.noise))
      text += fmt::format("; noise of a member {}", percent(r.noise / r.scale(), "{:.2g} %"));
    console.say(fmt::format("  {:<16} {}", r.name, text));
  }
}

void say_choice(const LadderAccuracy& ladder, const CostQuestions& questions, Console& console) {
  const Choice choice = cheapest_for(ladder, questions.wanted_error);
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
  const LadderAccuracy& ladder = study.ladders[i];
  console.say(fmt::format("  {} planned members at {:g} m:", study.planned_members,
                          ladder.spacings_m.back()));
  for (const workflow::Certainty& c :
       workflow::certainty_at(study, i, ladder.spacings_m.back(), study.planned_members))
    console.say(fmt::format(
        "  {:<16} sampling +- {}, resolution +- {}, model {}", c.result, percent(c.sampling),
        percent(c.resolution),
        std::isfinite(c.model) ? "+- " + percent(c.model) : "not looked at (--formulations)"));
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
        "{}: estimated errors of means, relative to the limit; {} of {} members, drawn alike at "
        "every spacing",
        ladder.formulation, ladder.members.size(), study.members));
    say_table(ladder, console);
    say_orders(ladder, console);
    console.say(
        fmt::format("  seconds grow as spacing to the power {:.1f}", ladder.seconds.exponent));
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
  const CostQuestions questions{options.wanted_error, 3600 * options.core_hours};
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
  parser.add_option("--within", options.wanted_error, "Wanted relative error of every result")
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
