// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/submit.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/cluster/folder_state.hpp"
#include "ensemble/workflow/cluster/shard_layout.hpp"
#include "ensemble/workflow/folder/lock/heartbeat.hpp"
#include "ensemble/workflow/folder/lock_file.hpp"
#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/folder/scene_identity.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <random>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// One call of submit at a time in a folder.
class SubmitLock {
 public:
  explicit SubmitLock(const ClusterFolder& folder) : file_(folder.lock()), heart_(beat) {
    make_folder(folder.root);
    std::random_device device;
    LockHolder mine{this_process(), utc_now(), "submit", true,
                    fmt::format("{:08x}{:08x}", device(), device())};
    mine.beat_s = std::chrono::duration<double>(beat).count();
    if (const auto other = take_lock(file_, mine))
      throw SetupError(fmt::format("{}: another `sturz submit` is at work, {}. Wait for it.",
                                   folder.root.string(), holder_text(*other)));
    token_ = mine.token;
    heart_.keep(file_, token_);
  }
  ~SubmitLock() {
    heart_.leave(file_);
    drop_lock(file_, token_);
  }
  SubmitLock(const SubmitLock&) = delete;
  SubmitLock& operator=(const SubmitLock&) = delete;

 private:
  static constexpr std::chrono::seconds beat{5};
  fs::path file_;
  std::string token_;
  Heartbeat heart_;
};

/// Of a new folder: what people recognise, and what no other folder has.
std::string new_name(const fs::path& folder) {
  std::string name = fs::weakly_canonical(folder).filename().string().substr(0, 40);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return fmt::format("sturz-{}-{:08x}", name, std::random_device{}());
}

/// The jobs of a call that was killed before its record was complete: held, so nothing of them
/// runs.
void cancel_half_submitted(const Slurm& slurm, Submission record, const fs::path& file,
                           Observer& observer) {
  if (record.complete) return;
  // What the killed call had just sent may still be on its way.
  constexpr std::chrono::seconds on_its_way{3};
  std::error_code ignored;
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, ignored);
  if (!ignored && age < on_its_way) std::this_thread::sleep_for(on_its_way - age);
  std::set<std::string> half;
  const std::vector<std::string> names{record.name, record.merge_name()};
  for (const QueuedTask& task : slurm.queued(names))
    if (task.job != record.merge_job &&
        std::find(record.jobs.begin(), record.jobs.end(), task.job) == record.jobs.end())
      half.insert(task.job);
  const std::vector<std::string> jobs(half.begin(), half.end());
  slurm.cancel(jobs);
  record.complete = true;  // nothing is left that it does not say
  write_submission(file, record);
  observer.warning(fmt::format(
      "an earlier `sturz submit` was stopped half-way; {}. This call submits anew.",
      jobs.empty()
          ? std::string("it had not made any job")
          : fmt::format("its jobs ({}) were held back and are cancelled", fmt::join(jobs, ", "))));
}

/// Begins the folder, or holds the scene against the one that it was begun with.
/// \return its members, once the shards have grown it where more are asked for
std::int64_t begin_or_check(const SubmitRequest& request, const Scene& scene, int shards,
                            bool begun, Observer& observer) {
  const OutputFolder folder{request.ensemble.folder};
  if (!begun) {
    EnsembleRequest begin = request.ensemble;
    begin.planned_shards = shards;
    return prepare_ensemble(begin, observer).design.n_members();
  }
  require_same_scene(folder, scene.scenario, scene.inputs.identities);
  return continued_design(folder, Manifest::read(folder.manifest()), scene.scenario,
                          new_design(scene.scenario))
      .n_members();
}

void fill(double& value, double otherwise) {
  if (!(value > 0)) value = otherwise;
}

void fill(Resources& asked, const Resources& otherwise) {
  fill(asked.shard_s, otherwise.shard_s);
  fill(asked.shard_bytes, otherwise.shard_bytes);
  fill(asked.maps_s, otherwise.maps_s);
  fill(asked.maps_bytes, otherwise.maps_bytes);
}

bool all_asked(const Resources& a) {
  return a.shard_s > 0 && a.shard_bytes > 0 && a.maps_s > 0 && a.maps_bytes > 0;
}

/// What is asked for, and in how many shards: the user's word first, then what it was before, then
/// a plan, which takes seconds.
void decide(const SubmitRequest& request, const Scene& scene, const std::optional<Submission>& last,
            int shards_before, Submitted& out, const std::optional<Slurm>& slurm) {
  const int most = slurm ? slurm->largest_task() : request.plan.most_shards;
  Submission& record = out.record;
  record.asked = request.asked;
  if (last && !request.cores_given) record.asked.cores = last->asked.cores;
  record.shards = request.plan.shards > 0 ? request.plan.shards : shards_before;
  if (last) fill(record.asked, last->asked);
  if (record.shards == 0 || !all_asked(record.asked)) {
    PlanRequest plan = request.plan;
    plan.cores = record.asked.cores;
    plan.shards = record.shards;
    plan.most_shards = std::min(plan.most_shards, most);
    out.plan = plan_shards(scene, plan);
    if (record.shards == 0) record.shards = out.plan->shards;
    fill(record.asked, {record.asked.cores, out.plan->ask_s, out.plan->ask_bytes,
                        out.plan->maps_ask_s, out.plan->maps_ask_bytes});
  }
  require(record.shards <= most,
          fmt::format("{} shards (this cluster takes arrays up to task {}, MaxArraySize). Use "
                      "fewer with --shards.",
                      record.shards, most));
}

/// Missing shards that wait or run already, and the arrays that they belong to.
void look_at_queue(const Slurm& slurm, const std::optional<Submission>& last, Submitted& out) {
  if (!last) return;
  const std::vector<std::string> name{last->name};
  std::set<std::string> jobs;
  std::set<int> queued;
  for (const QueuedTask& task : slurm.queued(name)) {
    jobs.insert(task.job);
    queued.insert(task.task);
  }
  require(jobs.empty() || last->shards == out.record.shards,
          fmt::format("{} shards (jobs {} still compute the folder in {}). Wait for them, or "
                      "scancel them first.",
                      out.record.shards, fmt::join(jobs, ", "), last->shards));
  out.record.jobs.assign(jobs.begin(), jobs.end());
  std::vector<int> rest;
  for (const int k : out.shards) (queued.contains(k) ? out.queued : rest).push_back(k);
  out.shards = rest;
}

std::vector<std::string> shard_command(const SubmitRequest& r, const Submission& record,
                                       const fs::path& folder) {
  std::vector<std::string> words{r.program, "ensemble"};
  words.insert(words.end(), r.words.begin(), r.words.end());
  for (std::string word : {std::string("-o"), folder.string(), std::string("--workers"),
                           std::to_string(record.asked.cores), std::string("--shard"),
                           fmt::format("auto/{}", record.shards)})
    words.push_back(std::move(word));
  return words;
}

void write_scripts(const SubmitRequest& request, const Submitted& out) {
  const fs::path folder = fs::absolute(out.folder.root).lexically_normal();
  const ClusterFolder cluster(OutputFolder{folder});
  make_folder(cluster.logs());
  if (!out.shards.empty())
    write_text_atomic(cluster.shard_script(),
                      job_script({cluster, out.record, request.options, request.work_folder,
                                  shard_command(request, out.record, folder), out.shards}));
  std::vector<std::string> merge{request.program, "merge", folder.string()};
  merge.insert(merge.end(), request.merge_words.begin(), request.merge_words.end());
  write_text_atomic(
      cluster.merge_script(),
      job_script({cluster, out.record, request.options, request.work_folder, merge, {}}));
}

/// Makes the jobs; whatever is refused in between leaves none.
void send(const Slurm& slurm, const ClusterFolder& cluster, const std::string& old_merge,
          Submitted& out) {
  Submission& record = out.record;
  const std::vector<std::string> jobs_before = record.jobs;
  record.complete = false;
  record.merge_job = old_merge;
  write_submission(cluster.record(), record);
  std::vector<std::string> made;
  try {
    if (!out.shards.empty())
      made.push_back(slurm.submit({"--hold", cluster.shard_script().string()}));
    std::vector<std::string> after = jobs_before;
    after.insert(after.end(), made.begin(), made.end());
    std::vector<std::string> words;
    if (!after.empty())
      words.push_back(fmt::format("--dependency=afterany:{}", fmt::join(after, ":")));
    words.push_back(cluster.merge_script().string());
    made.push_back(slurm.submit(words));
    record.jobs = after;
    record.merge_job = made.back();
    if (!out.shards.empty()) slurm.release(made.front());
  } catch (...) {
    slurm.cancel(made);
    record.complete = true;  // nothing is left that the record does not say
    record.jobs = jobs_before;
    record.merge_job = old_merge;
    write_submission(cluster.record(), record);
    throw;
  }
  record.complete = true;
  write_submission(cluster.record(), record);
  if (!old_merge.empty()) slurm.cancel(std::vector{old_merge});  // it would find gaps
}

}  // namespace

Submitted submit(const SubmitRequest& request, const RunCommand& run, Observer& observer,
                 CancelFlag cancel) {
  std::optional<Slurm> slurm;
  if (!request.dry_run) {
    slurm.emplace(run);
    slurm->require_there();
  }
  Submitted out;
  out.folder.root = request.ensemble.folder;
  const Scene scene = load_scene(scene_of(request.ensemble));
  const bool begun = holds_results(out.folder, "ensemble");
  const ClusterFolder cluster(out.folder);
  std::optional<Submission> last = read_submission(cluster.record());
  const int shards_before = begun ? Manifest::read(out.folder.manifest()).shards : 0;
  decide(request, scene, last, shards_before, out, slurm);
  out.members = begin_or_check(request, scene, out.record.shards, begun, observer);
  const SubmitLock alone(cluster);
  remove_part_files(cluster.record().parent_path());  // of a call that was killed
  last = read_submission(cluster.record());
  if (last && slurm) cancel_half_submitted(*slurm, *last, cluster.record(), observer);

  const FolderState state = folder_state(out.folder, out.record.shards, cancel);
  out.finished = state.finished();
  const auto states = shard_states(state.members(), out.members, out.record.shards);
  for (const ShardState& s : states)
    if (s.missing() > 0 || (request.ensemble.retry_failed && s.failed > 0))
      out.shards.push_back(s.k);
  const bool missing = !out.shards.empty();
  out.record.name = last ? last->name : new_name(out.folder.root);
  out.record.since = utc_now();
  if (slurm) look_at_queue(*slurm, last, out);
  out.nothing_to_do = out.shards.empty() && (missing || state.maps == MapsState::complete);
  if (out.nothing_to_do) {
    if (last) out.record = *last;
    return out;
  }
  cancel.check();
  write_scripts(request, out);
  if (slurm) send(*slurm, cluster, last ? last->merge_job : "", out);
  return out;
}

}  // namespace sturz::workflow
