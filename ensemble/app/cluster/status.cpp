// SPDX-License-Identifier: Apache-2.0
// sturz status: how far a results folder is, while others compute in it.
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/cluster/folder_state.hpp"
#include "ensemble/workflow/cluster/submission.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace sturz::app {
namespace {

struct Options {
  std::string folder;
};

using workflow::FolderState;
using workflow::ShardState;
using workflow::Submission;
using workflow::Worker;

nlohmann::ordered_json worker_json(const Worker& w) {
  const workflow::LockHolder& h = w.holder;
  return {{"shard", w.shard.n > 1 ? nlohmann::ordered_json(w.shard.k) : nullptr},
          {"of", w.shard.n},
          {"host", h.process.host},
          {"pid", h.process.pid},
          {"job", h.process.job},
          {"restarts", h.process.restarts},
          {"purpose", h.purpose},
          {"since", h.since},
          {"workers", h.workers},
          {"silent_s", w.silent_s},
          {"gone", w.gone}};
}

std::string as_json(const FolderState& s, const std::optional<Submission>& jobs) {
  const double left = s.remaining_s();
  nlohmann::ordered_json all{{"folder", s.folder.root.string()},
                             {"command", s.manifest.command},
                             {"members", s.planned},
                             {"finished", s.finished()},
                             {"missing", s.missing()},
                             {"shards", nlohmann::ordered_json::array()},
                             {"missing_shards", workflow::missing_shards(s.shards)},
                             {"workers", nlohmann::ordered_json::array()},
                             {"member_s", s.member_s()},
                             {"recent_members", s.recent_members},
                             {"at_a_time", s.at_a_time()},
                             {"remaining_s", nullptr},
                             {"maps", to_string(s.maps)},
                             {"hazard_hash", s.manifest.hazard_hash},
                             {"problems", s.store->problems()},
                             {"submission", nullptr}};
  if (std::isfinite(left)) all["remaining_s"] = left;
  for (const ShardState& k : s.shards)
    all["shards"].push_back({{"shard", k.k},
                             {"members", k.members},
                             {"valid", k.valid},
                             {"failed", k.failed},
                             {"missing", k.missing()}});
  for (const Worker& w : s.workers) all["workers"].push_back(worker_json(w));
  if (jobs)
    all["submission"] = {{"complete", jobs->complete},
                         {"name", jobs->name},
                         {"since", jobs->since},
                         {"array_jobs", jobs->jobs},
                         {"merge_job", jobs->merge_job}};
  return json_text(all);
}

void tell_shards(const FolderState& s, Console& console) {
  const std::size_t n = s.shards.size();
  if (n < 2) return;
  const std::vector<int> missing = workflow::missing_shards(s.shards);
  console.say(fmt::format("shards: {} of {} finished{}", n - missing.size(), n,
                          missing.empty() ? "" : "; missing " + workflow::ranges_text(missing)));
  constexpr std::size_t shown = 40;
  if (n > shown) return;
  for (const ShardState& k : s.shards)
    console.say(fmt::format("  {:>4}  {} of {} members{}", k.k, k.valid + k.failed, k.members,
                            k.failed > 0 ? fmt::format(", {} failed", k.failed) : ""));
}

void tell_workers(const FolderState& s, Console& console) {
  if (s.workers.empty()) return console.say("no process computes here");
  for (const Worker& w : s.workers) {
    const workflow::LockHolder& h = w.holder;
    const std::string job = h.process.job.empty() ? "" : fmt::format(", {}", h.process.job);
    console.say(fmt::format(
        "{}: process {} on {} since {}{}{}",
        w.shard.n > 1 ? fmt::format("shard {} of {}", w.shard.k, w.shard.n) : h.purpose,
        h.process.pid, h.process.host, h.since, job,
        w.gone ? fmt::format("; gone, last heard of {} ago", workflow::duration_text(w.silent_s))
               : ""));
  }
}

void tell_maps(const FolderState& s, Console& console) {
  switch (s.maps) {
    case workflow::MapsState::none:
      return console.say("maps: none yet");
    case workflow::MapsState::older:
      return console.say(
          "maps: of other members than are there now; `sturz merge` makes them anew");
    case workflow::MapsState::partial:
      return console.say("maps: of the members that are there, some are missing");
    case workflow::MapsState::complete:
      return console.say("maps: complete, " + s.folder.hazard_nc().string());
  }
}

void tell(const FolderState& s, const std::optional<Submission>& jobs, Console& console) {
  std::int64_t failed = 0;
  for (const ShardState& k : s.shards) failed += k.failed;
  console.say(fmt::format("{}: {} of {} members finished, {} failed, {} missing",
                          s.folder.root.string(), s.finished(), s.planned, failed, s.missing()));
  tell_shards(s, console);
  tell_workers(s, console);
  const double left = s.remaining_s();
  if (s.missing() > 0 && std::isfinite(left))
    console.say(fmt::format("pace: {} at a time, {} each (the last {}); about {} to go",
                            s.at_a_time(), workflow::duration_text(s.member_s()), s.recent_members,
                            workflow::duration_text(left)));
  tell_maps(s, console);
  if (jobs && !jobs->complete)
    console.warn(
        fmt::format("a `sturz submit` works now, or was stopped half-way: jobs {} and {} "
                    "may be held back. Submit again: it cleans up.",
                    jobs->name, jobs->merge_name()));
  else if (jobs)
    console.say(fmt::format("submitted {} as {} (jobs {}, maps {})", jobs->since, jobs->name,
                            fmt::join(jobs->jobs, ", "), jobs->merge_job));
  if (!s.store->problems().empty())
    console.warn(
        fmt::format("{} members are damaged or of another scene and count as missing; the "
                    "first: {}",
                    s.store->problems().size(), s.store->problems().front()));
}

int status(const Options& options, Console& console) {
  const workflow::OutputFolder folder{options.folder};
  const FolderState state = workflow::folder_state(folder, 0, interrupt_flag());
  const auto jobs = workflow::read_submission(workflow::ClusterFolder(folder).record());
  tell(state, jobs, console);
  console.event(as_json(state, jobs));
  return ok;
}

}  // namespace

void add_status(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "status",
                  "Say how far an ensemble is and what computes it; disturbs nothing", status);
  parser.add_option("folder", options.folder, "Folder of an ensemble")
      ->type_name("DIR")
      ->required();
  add_json(grammar, parser, "One JSON object instead of words");
}

}  // namespace sturz::app
