// SPDX-License-Identifier: Apache-2.0
// sturz submit: an ensemble as jobs of a cluster.
#include "ensemble/workflow/cluster/submit.hpp"

#include "engine/core/error.hpp"
#include "ensemble/app/cluster/plan_options.hpp"
#include "ensemble/app/cluster/run_command.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/console_observer.hpp"
#include "ensemble/app/console/interrupt.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/speed_cache.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace sturz::app {
namespace {

struct Options {
  PlanOptions plan;
  bool slurm = false;
  std::string out;  ///< folder; empty: out/<name of the scenario>
  // Asked for; 0: as planned.
  double minutes = 0, memory_mb = 0;  ///< of a shard
  double maps_minutes = 0, maps_memory_mb = 0;
  workflow::JobOptions job;
  bool retry_failed = false;
  bool dry_run = false;
  CLI::App* parser = nullptr;
};

/// What a shard is given besides folder and number.
std::vector<std::string> words_of(const Options& o) {
  std::vector<std::string> words{o.plan.scenario};
  for (const std::string& set : o.plan.set) words.insert(words.end(), {"--set", set});
  if (o.plan.members > 0) words.insert(words.end(), {"-n", std::to_string(o.plan.members)});
  return words;
}

workflow::SubmitRequest request_of(const Options& o) {
  workflow::SubmitRequest request;
  request.ensemble.scene = {o.plan.scenario, o.plan.set, speed_cache()};
  request.ensemble.folder = o.out.empty() ? workflow::default_folder(o.plan.scenario) : o.out;
  request.ensemble.members = o.plan.members;
  request.ensemble.retry_failed = o.retry_failed;
  request.ensemble.command = "ensemble";
  request.words = words_of(o);
  for (const std::string& word : request.words)
    request.ensemble.command += " " + workflow::shell_word(word);
  if (o.retry_failed) request.words.emplace_back("--retry-failed");
  if (o.parser->count("--allow-remote-inputs") > 0) {
    request.words.emplace_back("--allow-remote-inputs");
    request.merge_words.emplace_back("--allow-remote-inputs");
  }
  request.plan = plan_request(o.plan);
  request.cores_given = o.plan.cores > 0;
  request.asked.cores = request.plan.cores;
  request.asked.shard_s = 60 * o.minutes;
  request.asked.shard_bytes = 1e6 * o.memory_mb;
  request.asked.maps_s = 60 * o.maps_minutes;
  request.asked.maps_bytes = 1e6 * o.maps_memory_mb;
  request.options = o.job;
  request.work_folder = std::filesystem::current_path().string();
  request.program = std::filesystem::read_symlink("/proc/self/exe").string();
  request.dry_run = o.dry_run;
  return request;
}

nlohmann::ordered_json as_json(const workflow::Submitted& s, bool dry_run) {
  nlohmann::ordered_json all{{"event", "submitted"},
                             {"folder", s.folder.root.string()},
                             {"dry_run", dry_run},
                             {"nothing_to_do", s.nothing_to_do},
                             {"members", s.members},
                             {"finished_before", s.finished},
                             {"shards", s.record.shards},
                             {"submitted_shards", s.shards},
                             {"queued_shards", s.queued},
                             {"name", s.record.name},
                             {"array_jobs", s.record.jobs},
                             {"merge_job", s.record.merge_job},
                             {"plan", nullptr}};
  if (s.plan) all["plan"] = plan_json(*s.plan);
  return all;
}

void tell(const workflow::Submitted& s, bool dry_run, Console& console) {
  const std::string folder = s.folder.root.string();
  if (s.plan)
    for (const std::string& line : workflow::plan_lines(*s.plan)) console.say(line);
  if (s.finished > 0)
    console.say(fmt::format("{} of {} members are finished", s.finished, s.members));
  if (!s.queued.empty())
    console.say(fmt::format("shards {} of {} wait or run already (squeue --name={})",
                            workflow::ranges_text(s.queued), s.record.shards, s.record.name));
  if (s.nothing_to_do)
    return console.say(fmt::format("Nothing to submit. See: sturz status {}", folder));
  const std::string what = s.shards.empty()
                               ? "the maps"
                               : fmt::format("shards {} of {} and the maps",
                                             workflow::ranges_text(s.shards), s.record.shards);
  const workflow::ClusterFolder cluster(s.folder);
  if (dry_run)
    return console.say(fmt::format(
        "Written, not submitted: {}. By hand: sbatch {}; then sbatch --dependency=afterany:JOB {}",
        what, workflow::shell_word(cluster.shard_script().string()),
        workflow::shell_word(cluster.merge_script().string())));
  console.say(fmt::format(
      "Submitted {}: job{} {}, maps {}. See: sturz status {}", what,
      s.record.jobs.size() == 1 ? "" : "s",
      s.record.jobs.empty() ? "none" : fmt::format("{}", fmt::join(s.record.jobs, ", ")),
      s.record.merge_job, folder));
  console.say(fmt::format("  what they say: {}", cluster.logs().string()));
}

int submit(const Options& options, Console& console) {
  require(options.slurm || options.dry_run,
          "sturz submit knows one scheduler (say --slurm). For others see docs/examples/cluster.");
  ConsoleObserver observer(console);
  const workflow::Submitted done =
      workflow::submit(request_of(options), run_command, observer, interrupt_flag());
  tell(done, options.dry_run, console);
  console.event(json_text(as_json(done, options.dry_run)));
  return ok;
}

}  // namespace

void add_submit(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "submit", "Give an ensemble to a cluster; again: what is missing of it", submit);
  options.parser = &parser;
  add_plan_options(parser, options.plan);
  parser.add_flag("--slurm", options.slurm,
                  "As an array of jobs of Slurm, and the merge behind it");
  parser.add_option("-o,--out", options.out, "Folder of the results (default: out/NAME)")
      ->type_name("DIR");
  parser.add_flag("--dry-run", options.dry_run, "Write the scripts into DIR/cluster and no more");
  const auto asked = [&parser = parser](const char* name, double& value, const char* unit,
                                        const char* help) {
    parser.add_option(name, value, help)->type_name(unit)->check(CLI::Range(1.0, 1e8));
  };
  asked("--time", options.minutes, "MINUTES", "Time limit of a shard (default: as planned)");
  asked("--memory", options.memory_mb, "MB", "Memory of a shard (default: as planned)");
  asked("--maps-time", options.maps_minutes, "MINUTES", "Time limit of the maps");
  asked("--maps-memory", options.maps_memory_mb, "MB", "Memory of the maps");
  parser.add_option("--partition", options.job.partition, "Partition of the cluster")
      ->type_name("NAME");
  parser.add_option("--account", options.job.account, "Account that pays")->type_name("NAME");
  parser.add_option("--at-a-time", options.job.at_a_time, "Shards that run at a time, at most")
      ->check(CLI::Range(1, 1000000));
  parser
      .add_option("--sbatch", options.job.sbatch,
                  "Further option of sbatch, such as --sbatch=--qos=long; may be repeated")
      ->type_name("OPTION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  parser.add_flag("--retry-failed", options.retry_failed, "Also shards with failed members");
  add_json(grammar, parser);
}

}  // namespace sturz::app
