// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/region/region.hpp"

#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/verdict.hpp"
#include "ensemble/workflow/readable.hpp"
#include "ensemble/workflow/region/region_run.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace sturz::app {
namespace {

using Json = nlohmann::ordered_json;
using workflow::RegionJob;
using workflow::RegionMade;
using workflow::RegionRun;

void announce(const RegionJob& job, const std::string& shard, Console& console) {
  const auto n = static_cast<std::int64_t>(job.sources.size());
  console.event(json_text(Json{{"event", "start"},
                               {"folder", job.folder.root.string()},
                               {"sources", n},
                               {"members_per_source", job.members_per_source()},
                               {"workers", job.workers},
                               {"threads_per_member", job.threads}}));
  console.note(job.request.command);
  console.say(fmt::format("{} sources of {} members each{}, {} members at a time", n,
                          job.members_per_source(), shard.empty() ? "" : ", shard " + shard,
                          job.workers));
}

/// Of those that could not be computed the first few.
void tell_failures(const RegionRun& run, Console& console) {
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(most, run.failed_sources.size()); ++i)
    console.warn(fmt::format("source {} could not be computed: {}", run.failed_sources[i].first,
                             run.failed_sources[i].second));
  if (run.failed_sources.size() > most)
    console.warn(fmt::format("... and {} more sources; sources.csv gives their reasons.",
                             run.failed_sources.size() - most));
  for (const auto& [source, reason] : run.failed_sources)
    console.event(
        json_text(Json{{"event", "source_failed"}, {"source", source}, {"reason", reason}}));
}

/// An exit code other than ok when the members did not all come to an end.
int how_it_ended(const RegionRun& run, Console& console) {
  if (!run.stop_error.empty()) {
    console.error(fmt::format("{} The {} finished members are kept; the same command will resume.",
                              run.stop_error, run.finished));
    return usage_or_scenario_error;
  }
  if (!run.interrupted) return ok;
  console.event(json_text(Json{{"event", "interrupted"}, {"finished", run.finished}}));
  console.warn(
      fmt::format("interrupted with {} of {} members finished. Resume with the same command.",
                  run.finished, run.total));
  interruption_told();
  return interrupted;
}

int verdict(const RegionMade& made, Console& console) {
  const std::string folder = made.folder.root.string();
  console.clear_progress();
  console.note(fmt::format("maps of {} valid members in {}, hash {}", made.valid,
                           workflow::duration_text(made.seconds), made.hazard_hash));
  console.say(fmt::format("{} of {} sources, {} of {} members are valid. Results are in {}:",
                          made.n_sources - made.n_failed_sources, made.n_sources, made.valid,
                          made.planned, folder));
  console.say("  report.html   look here first: click a cell to see which sources reach it");
  list_maps(made.folder, console);
  console.say("  sources.csv   one row per source");
  console.say(
      fmt::format("  features/     an ensemble folder for each source; sturz merge {}/features/"
                  "NAME makes its maps",
                  folder));
  if (made.cut_off > 0)
    console.warn(
        fmt::format("the end of {} of {} valid members was not seen: probabilities and "
                    "peaks are lower bounds.",
                    made.cut_off, made.valid));
  const bool too_many = made.too_many_failed();
  if (made.failed > 0) {
    const std::string text = fmt::format(
        "{} of {} members failed{}{}", made.failed, made.planned,
        made.n_failed_sources > 0
            ? fmt::format(", all of {} sources among them", made.n_failed_sources)
            : "",
        too_many
            ? fmt::format(": more than the accepted share (ensemble.max_failed_fraction = {}).",
                          made.max_failed_fraction)
            : ".");
    if (too_many)
      console.error(text + " The maps are made from the others.");
    else
      console.warn(text + " The maps are made from the others.");
  }
  console.event(json_text(Json{{"event", "done"},
                               {"sources", made.n_sources},
                               {"failed_sources", made.n_failed_sources},
                               {"planned", made.planned},
                               {"finished", made.finished},
                               {"valid", made.valid},
                               {"failed", made.failed},
                               {"cut_off", made.cut_off},
                               {"reached_cells", made.reached_cells},
                               {"most_sources_at_a_cell", made.most_sources},
                               {"hazard_hash", made.hazard_hash},
                               {"folder", folder}}));
  return too_many ? too_many_failed : ok;
}

}  // namespace

int region_ensemble(const workflow::EnsembleRequest& request, const std::string& shard,
                    Console& console) {
  ConsoleObserver observer(console);
  RegionJob job = workflow::prepare_region(request, observer);
  announce(job, shard, console);
  RegionRun run;
  for (bool again = false;; again = true) {
    run = workflow::run_region(job, observer, interrupt_flag());
    console.clear_progress();
    tell_failures(run, console);
    if (const int code = how_it_ended(run, console); code != ok) return code;
    if (!shard.empty()) break;
    try {
      return verdict(workflow::make_region_results(job, observer, interrupt_flag()), console);
    } catch (const workflow::MembersMissing& problem) {
      // Members of a source that was known to be finished were damaged since.
      if (again) throw;
      console.warn(fmt::format("{} They are computed now.", problem.what()));
    }
  }
  console.say(
      fmt::format("Shard {} is finished ({} members computed). When all are: sturz merge {}", shard,
                  run.computed, job.folder.root.string()));
  console.event(json_text(Json{{"event", "shard_done"},
                               {"computed", run.computed},
                               {"failed", run.failed},
                               {"failed_sources", run.failed_sources.size()}}));
  return ok;
}

int region_merge(const std::string& folder, bool partial, Console& console) {
  ConsoleObserver observer(console);
  return verdict(workflow::merge_region({folder, partial}, observer, interrupt_flag()), console);
}

int region_describe(const workflow::SceneRequest& request, Console& console) {
  constexpr double trial_s = 2;
  const workflow::RegionDescription d =
      workflow::describe_region(request, trial_s, interrupt_flag());
  const auto members = static_cast<std::int64_t>(d.n_sources) * d.members_per_source;
  if (console.json()) {
    const auto range = [](const workflow::Range& r) {
      return Json{{"likely", r.likely}, {"low", r.low}, {"high", r.high}};
    };
    console.event(json_text(Json{{"title", d.typical.scenario.title},
                                 {"region", true},
                                 {"sources", d.n_sources},
                                 {"members_per_source", d.members_per_source},
                                 {"members", members},
                                 {"looked_at", d.looked_at},
                                 {"failed", d.failed},
                                 {"typical_source", d.typical_of},
                                 {"formulation", d.typical.description.formulation},
                                 {"member_s", range(d.member_s)},
                                 {"members_s", range(d.members_s)},
                                 {"elapsed_s", range(d.elapsed_s)},
                                 {"warnings", d.typical.description.warnings}}));
    return ok;
  }
  if (!d.typical.scenario.title.empty()) console.say(d.typical.scenario.title);
  console.say(fmt::format("region: {} sources, {} members each, {} in all", d.n_sources,
                          d.members_per_source, members));
  console.say("of its sources, " + d.typical_of + ":");
  for (const std::string& line : workflow::description_lines(d.typical)) console.say("  " + line);
  console.say(fmt::format("predicted for a member: {} on average of {} sources that were tried",
                          workflow::seconds_text(d.member_s), d.looked_at.size()));
  console.say(fmt::format("predicted for all members, {} at a time: {}; maps come on top",
                          d.workers, workflow::seconds_text(d.elapsed_s)));
  for (const std::string& failed : d.failed) console.warn("source " + failed);
  for (const std::string& warning : d.typical.description.warnings) console.warn(warning);
  return ok;
}

}  // namespace sturz::app
