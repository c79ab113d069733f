// SPDX-License-Identifier: Apache-2.0
// sturz ensemble: draw or read the design, run what is not finished, make the maps.
#include "engine/core/error.hpp"
#include "ensemble/app/cluster/task_shard.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/forecast_json.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/multilevel/multilevel.hpp"
#include "ensemble/app/region/region.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/app/verdict.hpp"
#include "ensemble/workflow/calibration/posterior_files.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"
#include "ensemble/workflow/forecast/ensemble_forecast.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/members/until_converged.hpp"
#include "ensemble/workflow/members/utilisation.hpp"
#include "ensemble/workflow/multilevel/multilevel_run.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace sturz::app {
namespace {

struct Options {
  std::string scenario;
  std::vector<std::string> set;  ///< "key=value"
  MembersOptions of;
  std::string shard;           ///< "k/n" or "auto/n"; empty: everything
  int first_task = 1;          ///< number of the task that computes shard 1
  bool retry_failed = false;   ///< compute failed members again
  bool packs = false;          ///< members in packs however few there are
  double until_converged = 0;  ///< half width of P(reached); 0: no stop rule
  std::string asset;           ///< name of the one that the rule looks at; empty: the map
  int at_most = 0;             ///< members under that rule; 0: as the scenario says
  std::string posterior;       ///< folder of a calibration; empty: the scene's own design
};

using workflow::EnsembleJob;

/// The command as manifest and log keep it.
std::string command_text(const Options& o) {
  using workflow::shell_word;
  std::string text = "ensemble " + shell_word(o.scenario);
  for (const std::string& set : o.set) text += " --set " + shell_word(set);
  if (o.of.members > 0) text += fmt::format(" -n {}", o.of.members);
  if (o.until_converged > 0) text += fmt::format(" --until-converged {}", o.until_converged);
  if (!o.asset.empty()) text += " --asset " + shell_word(o.asset);
  if (o.at_most > 0) text += fmt::format(" --at-most {}", o.at_most);
  if (!o.posterior.empty()) text += " --posterior " + shell_word(o.posterior);
  if (o.packs) text += " --packs";
  return text;
}

workflow::EnsembleRequest request_of(const Options& o) {
  workflow::EnsembleRequest request;
  request.scene = {o.scenario, o.set, speed_cache()};
  if (!o.posterior.empty())
    for (std::string& set : workflow::posterior_overrides(o.posterior))
      request.scene.overrides.push_back(std::move(set));
  request.posterior = o.posterior;
  request.folder = o.of.out.empty() ? workflow::default_folder(o.scenario) : o.of.out;
  request.members = o.at_most > 0 ? o.at_most : o.of.members;
  if (o.until_converged > 0) request.until_half_width = o.until_converged;
  request.until_asset = o.asset;
  request.workers = o.of.workers;
  request.shard = shard_of(o.shard);
  request.retry_failed = o.retry_failed;
  request.packs = o.packs;
  request.command = command_text(o);
  return request;
}

std::string rule_text(const workflow::Growth& rule) {
  const std::int64_t at_most = rule.whole.n_members();
  const std::int64_t certain = certain_count(rule.wanted_half_width);
  std::string text = fmt::format("Until the {} is {} or less, at most {} members",
                                 rule.asset ? "half width of P(hit) of " + rule.asset->name
                                            : std::string("largest half width of P(reached)"),
                                 rule.wanted_half_width, at_most);
  if (certain > at_most)
    text += fmt::format("; it is certain to be so from {} valid members on only{} (--at-most)",
                        certain, rule.asset ? ", none of them cut off before it hits" : "");
  return text;
}

/// What is to be done, and what it will take where that was looked at.
void announce(const EnsembleJob& job, const Options& options,
              const std::optional<workflow::Forecast>& forecast, Console& console) {
  nlohmann::ordered_json start{{"event", "start"},
                               {"folder", job.folder.root.string()},
                               {"members", job.design.n_members()},
                               {"finished_before", job.finished_before},
                               {"to_do", job.to_do.size()},
                               {"workers", job.workers},
                               {"threads_per_member", job.threads},
                               {"forecast", nullptr}};
  if (forecast) start["forecast"] = forecast_json(*forecast);
  if (job.growth) {
    start["at_most"] = job.growth->whole.n_members();
    start["wanted_half_width"] = job.growth->wanted_half_width;
  }
  console.event(json_text(start));
  for (const std::string& warning : job.scene.description.warnings) console.warn(warning);
  for (const std::string& note : job.scene.inputs.notes) console.note(note);
  console.note(command_text(options));
  if (job.growth) console.say(rule_text(*job.growth));
  std::string text =
      fmt::format("{} members{}", job.design.n_members(), job.growth ? " up to the next look" : "");
  if (!options.shard.empty()) text += fmt::format(", shard {}", options.shard);
  if (job.finished_before > 0) text += fmt::format(", {} finished before", job.finished_before);
  if (!job.to_do.empty())
    text += fmt::format(", {} to do, {} at a time{}", job.to_do.size(), job.workers,
                        job.threads > 1 ? fmt::format(" with {} threads each", job.threads) : "");
  console.say(text);
  if (!forecast) return;
  for (const std::string& line : workflow::forecast_lines(*forecast)) console.say(line);
}

/// An exit code other than ok when the members did not all come to an end.
int how_it_ended(const workflow::MembersRun& run, Console& console) {
  if (!run.stop_error.empty()) {
    console.error(fmt::format("{} The {} finished members are kept; the same command will resume.",
                              run.stop_error, run.finished));
    return usage_or_scenario_error;
  }
  if (run.interrupted) {
    console.event(json_text(nlohmann::json{{"event", "interrupted"}, {"finished", run.finished}}));
    console.warn(
        fmt::format("interrupted with {} of {} members finished. Resume with the same "
                    "command.",
                    run.finished, run.total));
    interruption_told();
    return interrupted;
  }
  return ok;
}

/// How much of the cores the members had, and why not more.
void tell_utilisation(const workflow::Utilisation& u, Console& console) {
  const std::string text = workflow::utilisation_text(u), why = workflow::low_utilisation(u);
  if (text.empty()) return;
  console.event(json_text(nlohmann::ordered_json{{"event", "utilisation"},
                                                 {"fraction", u.fraction()},
                                                 {"core_s", u.core_s},
                                                 {"wall_s", u.wall_s},
                                                 {"cores", u.cores},
                                                 {"low_because", why}}));
  console.say("Utilisation: " + text);
  if (!why.empty())
    console.warn("cores were idle more than half of the time; likely because " + why + ".");
}

int ensemble(const Options& given, Console& console) {
  Options options = given;
  if (!given.shard.empty()) {
    const workflow::Shard shard = shard_of(given.shard, given.first_task);
    options.shard = fmt::format("{}/{}", shard.k, shard.n);
  }
  const workflow::EnsembleRequest request = request_of(options);
  if (workflow::is_region(workflow::scene_of(request)))
    return region_ensemble(request, options.shard, console);
  if (workflow::is_multilevel(workflow::scene_of(request)))
    return multilevel_ensemble(request, console);
  ConsoleObserver observer(console);
  EnsembleJob job = workflow::prepare_ensemble(request, observer);
  // A shard may be begun many times and told to stop within a minute: `plan` has looked before.
  std::optional<workflow::Forecast> forecast;
  if (options.shard.empty())
    forecast =
        workflow::forecast_of(job, speed_cache(), process_seconds(), observer, interrupt_flag());
  announce(job, options, forecast, console);
  const workflow::MembersRun run =
      job.growth ? workflow::run_until_converged(job, observer, interrupt_flag())
                 : workflow::run_ensemble(job, observer, interrupt_flag());
  console.clear_progress();
  if (const int code = how_it_ended(run, console); code != ok) return code;
  tell_utilisation(workflow::utilisation_of(job, run), console);
  if (!options.shard.empty()) return shard_verdict(job, run, options.shard, console);
  return verdict(workflow::make_maps(job, observer, interrupt_flag()), console);
}

}  // namespace

void add_ensemble(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "ensemble",
                  "Compute many members and the hazard maps; the same command resumes", ensemble);
  add_scenario(parser, options.scenario, options.set);
  CLI::Option* const members = add_members(parser, options.of);
  CLI::Option* const until =
      parser
          .add_option("--until-converged", options.until_converged,
                      "Stop when the 95 % interval of P(reached) is at most so far to either side "
                      "in every cell with 0.05 < P < 0.95; such as 0.05")
          ->type_name("HALF_WIDTH")
          ->check(CLI::Range(0.0005, 0.4));
  parser
      .add_option("--asset", options.asset,
                  "With --until-converged: look at this asset's probability of a hit alone")
      ->type_name("NAME")
      ->needs(until);
  parser
      .add_option("--at-most", options.at_most,
                  "Members that --until-converged may compute, instead of the scenario's number")
      ->needs(until)
      ->excludes(members)
      ->check(CLI::Range(1, 100000000));
  parser
      .add_option("--shard", options.shard,
                  "Compute only part K of N of the members and no maps; `merge` makes them. auto/N "
                  "takes K from SLURM_ARRAY_TASK_ID or HQ_TASK_ID")
      ->type_name("K/N");
  parser
      .add_option("--first-task", options.first_task,
                  "With --shard auto/N: number of the task that computes shard 1 (default 1)")
      ->type_name("NUMBER")
      ->check(CLI::Range(0, 1000000));
  parser.add_flag("--retry-failed", options.retry_failed,
                  "Compute members again that failed, for instance at a wall-time limit");
  parser.add_flag("--packs", options.packs,
                  "Keep members in packs of thousands and not in a file each, as ensembles of more "
                  "than 4096 members are kept anyway; a begun folder goes on as it began");
  parser
      .add_option("--posterior", options.posterior,
                  "Draw the members from what `sturz calibrate` found in this folder")
      ->type_name("DIR");
  add_json(grammar, parser);
}

}  // namespace sturz::app
