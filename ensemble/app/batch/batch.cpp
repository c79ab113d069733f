// SPDX-License-Identifier: Apache-2.0
// sturz batch: many scenarios out of one list, as far as they changed.
#include "ensemble/workflow/batch/batch.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/forecast_json.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <cmath>
#include <utility>

namespace sturz::app {
namespace {

using workflow::BatchDone;
using workflow::BatchRow;
using workflow::PlannedJob;
using workflow::RowState;
using Json = nlohmann::ordered_json;

struct Options {
  std::string list, out, between;
  std::vector<std::string> only;
  int workers = 0, keep = 0, nice = -1;
  bool prune = false, dry_run = false, check_all = false, retry_failed = false, wait = false;
};

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// The jobs' own words, each with the job's name, and where the batch is.
class BatchConsole final : public workflow::BatchObserver {
 public:
  /// \param nice of the command line; -1: as the list says
  BatchConsole(Console& console, int nice) : console_(console), members_(console), nice_(nice) {}

  /// A job's warnings stand in its log and on its page; a timer's mail says what failed.
  void warning(std::string_view text) override {
    if (job_.empty())
      console_.warn(text);
    else if (console_.json() || console_.shows_progress())
      console_.warn(fmt::format("{}: {}", job_, text));
    else
      console_.note(text);
  }
  /// Threads begin with what their parent has, so before the first of the work.
  void list_read(const BatchSpec& spec) override {
    const int nice = nice_ >= 0 ? nice_ : spec.nice;
    if (nice > 0) setpriority(PRIO_PROCESS, 0, nice);
  }
  void folder_ready(const workflow::OutputFolder& folder) override {
    members_.folder_ready(folder);
  }
  void run_progress(const Progress& p) override { members_.run_progress(p); }
  void ensemble_progress(const RunnerProgress& p, std::int64_t before) override {
    members_.ensemble_progress(p, before);
  }
  void member_stored(const MemberResult& result) override { members_.member_stored(result); }
  void maps_begin() override { members_.maps_begin(); }

  void job_planned(const PlannedJob& plan, std::size_t i, std::size_t n) override {
    console_.progress(fmt::format("looked at {} of {} jobs", i + 1, n));
    console_.event(json_text(Json{{"event", "planned"},
                                  {"job", plan.job.name},
                                  {"to_do", plan.to_do},
                                  {"why", plan.why},
                                  {"failure", plan.failure},
                                  {"folder", plan.folder.string()}}));
  }
  void job_begins(const PlannedJob& plan, std::size_t i, std::size_t n) override {
    job_ = plan.job.name;
    console_.event(json_text(Json{{"event", "job"}, {"job", job_}, {"why", plan.why}}));
    console_.say(fmt::format("[{}/{}] {}: {}", i + 1, n, job_, plan.why));
  }
  void job_ended(const BatchRow& row) override {
    console_.clear_progress();
    job_.clear();
    if (row.state == RowState::failed) console_.error(fmt::format("{}: {}", row.name, row.message));
    if (row.state == RowState::computed)
      console_.say(fmt::format("  {}: {} of {} members valid, {}", row.name, row.figures->valid,
                               row.figures->planned, row.folder.string()));
  }
  void waits(int minutes) override {
    console_.clear_progress();
    console_.say(
        fmt::format("waits {} for its time of day", workflow::duration_text(60.0 * minutes)));
  }

 private:
  Console& console_;
  ConsoleObserver members_;
  int nice_;
  std::string job_;
};

workflow::BatchRequest request_of(const Options& o) {
  workflow::BatchRequest request;
  request.list = o.list;
  request.speed_cache = speed_cache();
  request.command = "batch " + o.list;
  request.only = o.only;
  request.dry_run = o.dry_run;
  request.check_all = o.check_all;
  request.retry_failed = o.retry_failed;
  request.wait = o.wait;
  if (!o.out.empty()) request.results = o.out;
  if (o.workers > 0) request.max_workers = o.workers;
  if (o.prune) request.keep = 1;
  if (o.keep > 0) request.keep = o.keep;
  if (!o.between.empty()) {
    request.between = parse_day_window(o.between);
    require(
        request.between.has_value(),
        fmt::format("--between {} (must be two times of day, such as 20:00-06:00).", o.between));
  }
  return request;
}

double disk_bytes(const workflow::Forecast& f) {
  return f.members_disk_bytes.likely + f.maps_disk_bytes.likely;
}

/// What would be done, why, and what it would take.
void tell_plan(const BatchDone& done, Console& console) {
  double seconds = 0, disk = 0;
  std::size_t to_do = 0;
  for (const BatchRow& row : done.rows) {
    if (row.state == RowState::skipped) continue;
    Json event{
        {"event", "job"},           {"job", row.name},        {"state", to_string(row.state)},
        {"why", row.why},           {"message", row.message}, {"members", row.members},
        {"finished", row.finished}, {"forecast", nullptr}};
    std::string text = row.state == RowState::failed ? "fails: " + row.message
                       : row.why.empty()             ? "unchanged"
                                                     : row.why;
    if (row.forecast) {
      event["forecast"] = forecast_json(*row.forecast);
      seconds += row.forecast->elapsed_s.likely;
      disk += disk_bytes(*row.forecast);
      text +=
          fmt::format("\n    {}, {} on disk", seconds_text(row.forecast->elapsed_s),
                      bytes_text(row.forecast->members_disk_bytes + row.forecast->maps_disk_bytes));
    }
    to_do += row.state == RowState::waiting ? 1 : 0;
    console.event(json_text(event));
    console.say(fmt::format("{}: {}", row.name, text));
  }
  const double free = workflow::free_disk_bytes(done.root);
  console.say(fmt::format("{} of {} jobs to do: about {}, {:.2g} GB on disk{}", to_do,
                          done.rows.size(), workflow::duration_text(seconds), disk / 1e9,
                          std::isfinite(free) ? fmt::format(" ({:.3g} GB free)", free / 1e9) : ""));
  if (disk > free - 1e9 * done.spec.min_free_disk_gb)
    console.warn("the disk may not hold all of it.");
  console.event(json_text(Json{{"event", "dry_run"},
                               {"to_do", to_do},
                               {"elapsed_s", seconds},
                               {"disk_bytes", disk},
                               {"free_bytes", number(free)}}));
}

Json done_event(const BatchDone& done) {
  Json states = Json::object();
  for (const RowState state : {RowState::computed, RowState::unchanged, RowState::failed,
                               RowState::interrupted, RowState::waiting, RowState::skipped})
    states[to_string(state)] = done.count(state);
  Json removed = Json::array();
  for (const auto& folder : done.removed) removed.push_back(folder.string());
  return {{"event", done.stop ? "interrupted" : "done"},
          {"jobs", done.rows.size()},
          {"states", states},
          {"stopped_because", done.stop.text},
          {"core_s", done.core_s},
          {"wall_s", done.wall_s},
          {"cores", done.cores},
          {"utilisation", number(done.utilisation())},
          {"low_utilisation", done.low_utilisation},
          {"removed", removed},
          {"summary", done.csv.string()},
          {"page", done.page.string()}};
}

int tell_end(const BatchDone& done, Console& console) {
  console.clear_progress();
  const std::size_t failed = done.count(RowState::failed);
  const std::size_t open = done.count(RowState::interrupted) + done.count(RowState::waiting);
  console.say(fmt::format("{} job{}: {} computed, {} unchanged, {} failed{}", done.rows.size(),
                          done.rows.size() == 1 ? "" : "s", done.count(RowState::computed),
                          done.count(RowState::unchanged), failed,
                          open > 0 ? fmt::format(", {} to come", open) : ""));
  if (done.count(RowState::computed) > 0)
    console.say(fmt::format(
        "utilisation: {:.0f} % of {} cores ({} of computing in {})", 100 * done.utilisation(),
        done.cores, workflow::duration_text(done.core_s), workflow::duration_text(done.wall_s)));
  if (!done.low_utilisation.empty())
    console.warn("cores were idle more than half of the time; likely because " +
                 done.low_utilisation);
  if (!done.removed.empty())
    console.say(fmt::format("{} older results removed", done.removed.size()));
  console.say("  " + done.page.string() + "   look here first");
  console.say("  " + done.csv.string());
  if (done.stop) {
    console.warn(
        fmt::format("{}: {} jobs are to come. The same command goes on.", done.stop.text, open));
    interruption_told();
  }
  console.event(json_text(done_event(done)));
  if (done.stop) return interrupted;
  return failed > 0 ? too_many_failed : ok;
}

int batch(const Options& options, Console& console) {
  BatchConsole observer(console, options.nice);
  const BatchDone done = workflow::run_batch(request_of(options), observer, interrupt_flag());
  if (!options.dry_run) return tell_end(done, console);
  tell_plan(done, console);
  return done.count(RowState::failed) > 0 ? too_many_failed : ok;
}

}  // namespace

void add_batch(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "batch",
      "Compute a list of scenarios as far as they changed; the same command resumes", batch);
  parser.add_option("list", options.list, "Batch list (YAML)")->type_name("FILE")->required();
  parser.add_option("-o,--out", options.out, "Folder of all results, instead of the list's")
      ->type_name("DIR");
  parser.add_option("--only", options.only, "Only the jobs of this entry; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser.add_flag("--dry-run", options.dry_run,
                  "Say what would be computed, why, and what it would take; nothing is written");
  parser.add_flag("--check-all", options.check_all,
                  "Read every input and every member, whatever their time stamps say");
  parser.add_flag("--retry-failed", options.retry_failed, "Compute members again that failed");
  parser.add_option("--workers", options.workers, "Cores that may be used (default: all)")
      ->check(CLI::Range(1, 4096));
  parser
      .add_option("--between", options.between,
                  "Time of day in which it computes, such as 20:00-06:00; ends with code 3 outside")
      ->type_name("FROM-TO");
  parser.add_flag("--wait", options.wait, "Wait for that time of day instead");
  parser.add_option("--nice", options.nice, "How far other programs go first, 0 to 19")
      ->check(CLI::Range(0, 19));
  CLI::Option* const keep =
      parser.add_option("--keep", options.keep, "So many results of each job stay (default: all)")
          ->check(CLI::Range(1, 1000000));
  parser.add_flag("--prune", options.prune, "Remove all older results, as --keep 1")
      ->excludes(keep);
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
