// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_run.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/runner.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/region/region_record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

namespace sturz::workflow {
namespace {

/// Keeps what preparing a source says: it happens on the workers, where no observer may be called.
class Kept final : public Observer {
 public:
  void warning(std::string_view text) override { warnings.emplace_back(text); }
  std::vector<std::string> warnings;
};

/// One source while its members are computed.
struct OpenSource {
  EnsembleJob job;
  std::set<std::int64_t> to_do;
};

/// A source of this call's share, from its first member to its last.
class Source {
 public:
  Source(const RegionJob& region, std::string name)
      : region_(region), name_(std::move(name)), left_(region.members_per_source()) {}

  const std::string& name() const { return name_; }

  /// Null when it cannot be computed. From any thread; the first one opens it, others wait.
  /// \throws StopsRun
  std::shared_ptr<const OpenSource> open() {
    const std::lock_guard guard(lock_);
    if (!tried_) {
      tried_ = true;
      prepare();
    }
    return open_;
  }
  /// One of its members is behind us. \return whether all are, and are there
  bool member_is_over() {
    const std::lock_guard guard(lock_);
    if (--left_ > 0) return false;
    const bool could_be_computed = open_ != nullptr;
    open_.reset();
    return could_be_computed;
  }
  /// Empty: it could be opened, or was not tried.
  std::string failure() const {
    const std::lock_guard guard(lock_);
    return failure_;
  }
  std::vector<std::string> take_warnings() {
    const std::lock_guard guard(lock_);
    return std::exchange(warnings_, {});
  }

 private:
  void prepare() {
    EnsembleRequest request = region_.request;
    request.scene = source_scene(request.scene, name_);
    request.folder = source_folder(region_.folder, name_).root;
    request.shard = {};
    std::optional<Scene> scene;
    try {
      scene = load_scene(scene_of(request));
    } catch (const SetupError& problem) {
      failure_ = problem.what();
    }
    Kept kept;
    try {
      keep_failure(region_.folder, name_, failure_);
      if (!scene) return;
      auto open = std::make_shared<OpenSource>();
      open->job = prepare_ensemble(request, std::move(*scene), kept);
      open->job.threads = region_.threads;
      open->to_do.insert(open->job.to_do.begin(), open->job.to_do.end());
      open_ = std::move(open);
    } catch (const SetupError& problem) {
      throw StopsRun(fmt::format("source {}: {}", name_, problem.what()));
    }
    for (const std::string& warning : kept.warnings) warnings_.push_back(name_ + ": " + warning);
  }

  const RegionJob& region_;
  std::string name_;
  mutable std::mutex lock_;
  std::int64_t left_;
  bool tried_ = false;
  std::string failure_;
  std::vector<std::string> warnings_;
  std::shared_ptr<const OpenSource> open_;
};

/// Members of all sources, numbered through: source * members per source + member.
class RegionMembersRun {
 public:
  RegionMembersRun(RegionJob& job, Observer& observer)
      : job_(job),
        observer_(observer),
        record_(job.folder, job.manifest.design_hash, job.request.shard) {
    const Shard& shard = job.request.shard;
    for (std::size_t i = static_cast<std::size_t>(shard.k) - 1; i < job.sources.size();
         i += static_cast<std::size_t>(shard.n)) {
      // Of members that failed and are tried again, the source must say which they are.
      if (!job.request.retry_failed &&
          record_.is_finished(job.sources[i], job.members_per_source()))
        finished_before_ += job.members_per_source();
      else
        sources_.push_back(std::make_unique<Source>(job, job.sources[i]));
    }
    run_.finished = run_.total = finished_before_;
  }

  RegionRun run(const std::atomic<bool>& cancel) {
    RunPlan plan;
    plan.members = start_order();
    plan.workers = std::max(1, job_.workers);
    RunCallbacks callbacks;
    callbacks.run_member = [this](std::int64_t k, const std::atomic<bool>& stop) {
      return run_member(k, stop);
    };
    callbacks.store = [this](const MemberResult& result) { store(result); };
    callbacks.on_progress = [this](const RunnerProgress& p) { tell(p); };
    if (plan.members.empty()) return std::move(run_);
    const RunReport report = run_members(plan, callbacks, cancel);
    record_.write();
    run_.finished += report.progress.n_done;
    run_.total += report.progress.n_total;
    run_.interrupted = report.interrupted;
    run_.stop_error = report.stop_error;
    for (const auto& source : sources_)
      if (std::string why = source->failure(); !why.empty())
        run_.failed_sources.emplace_back(source->name(), std::move(why));
    return std::move(run_);
  }

 private:
  /// As many sources side by side as there are workers: each worker opens one of its own instead of
  /// waiting for another's.
  std::vector<std::int64_t> start_order() const {
    const auto n = job_.members_per_source();
    const auto all = static_cast<std::int64_t>(sources_.size());
    const std::int64_t side_by_side = std::max(1, job_.workers);
    std::vector<std::int64_t> order;
    order.reserve(static_cast<std::size_t>(all * n));
    for (std::int64_t first = 0; first < all; first += side_by_side)
      for (std::int64_t k = 0; k < n; ++k)
        for (std::int64_t s = first; s < std::min(all, first + side_by_side); ++s)
          order.push_back(s * n + k);
    return order;
  }

  Source& source_of(std::int64_t number) const {
    return *sources_[static_cast<std::size_t>(number / job_.members_per_source())];
  }

  MemberResult run_member(std::int64_t number, const std::atomic<bool>& stop) {
    const auto open = source_of(number).open();
    const std::int64_t member = number % job_.members_per_source();
    if (open && open->to_do.contains(member)) return workflow::run_member(open->job, member, stop);
    const std::lock_guard guard(lock_);
    nothing_to_do_.insert(number);
    MemberResult nothing;
    nothing.outcome = Outcome::settled;  // not to be counted as failed
    return nothing;
  }

  /// One at a time, as RunCallbacks says.
  void store(const MemberResult& result) {
    Source& source = source_of(result.member);
    for (const std::string& warning : source.take_warnings()) observer_.warning(warning);
    const auto open = source.open();
    if (take_nothing_to_do(result.member)) {
      if (open) ++finished_before_;
      ++skipped_;
    } else {
      expect(open != nullptr, "a member that was computed has its source");
      MemberResult own = result;
      own.member %= job_.members_per_source();
      store_member(open->job, own);
      ++run_.computed;
      run_.failed += !is_valid(own.outcome);
      observer_.source_member_stored(source.name(), own);
    }
    if (source.member_is_over()) remember(source.name());
  }

  /// Now and then on the way: it may be killed.
  void remember(const std::string& source) {
    constexpr std::chrono::seconds every{10};
    record_.add_finished(source);
    const auto now = std::chrono::steady_clock::now();
    if (now - written_ < every) return;
    record_.write();
    written_ = now;
  }

  bool take_nothing_to_do(std::int64_t number) {
    const std::lock_guard guard(lock_);
    return nothing_to_do_.erase(number) > 0;
  }

  /// The pace is that of members that were computed.
  void tell(const RunnerProgress& all) {
    RunnerProgress p = all;
    p.n_done -= skipped_;
    p.n_total -= skipped_;
    const auto done = static_cast<double>(p.n_done);
    const bool known = p.n_done > 0 && p.elapsed_s > 0;
    p.members_per_hour = known ? 3600 * done / p.elapsed_s : 0;
    p.eta_s = known ? p.elapsed_s * static_cast<double>(p.n_total - p.n_done) / done : nan_d;
    observer_.ensemble_progress(p, finished_before_);
  }

  RegionJob& job_;
  Observer& observer_;
  RegionRecord record_;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<Source>> sources_;
  std::mutex lock_;
  std::set<std::int64_t> nothing_to_do_;  // numbers on their way to store()
  // Touched under the runner's lock alone.
  std::int64_t finished_before_ = 0, skipped_ = 0;
  RegionRun run_;
};

}  // namespace

RegionRun run_region(RegionJob& job, Observer& observer, const std::atomic<bool>& cancel) {
  RegionRun run = RegionMembersRun(job, observer).run(cancel);
  job.manifest.compute_s +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - job.begin).count();
  return run;
}

}  // namespace sturz::workflow
