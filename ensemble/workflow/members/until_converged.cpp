// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/until_converged.hpp"

#include "engine/core/error.hpp"
#include "ensemble/stopping/asset_count.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <set>

namespace sturz::workflow {
namespace {

using Clock = std::chrono::steady_clock;

/// Hears what the members of each round tell, counts them, and passes it on as of the whole.
class Rounds final : public Observer {
 public:
  Rounds(EnsembleJob& job, Observer& to, const std::atomic<bool>& cancel)
      : job_(job),
        to_(to),
        cancel_(cancel),
        finished_before_(job.finished_before),
        waiting_(job.to_do),
        record_(stop_before(job)) {
    if (job.growth->asset) asset_.emplace(*job.growth->asset);
  }

  MembersRun run() {
    const std::int64_t begun = job_.design.n_members();
    std::int64_t from = 0;
    for (const std::int64_t count : job_.growth->looks) {
      begin_round(from, count);
      run_round();
      all_.total = std::max(count, begun);
      if (all_.interrupted || !all_.stop_error.empty()) return std::move(all_);
      look(count);
      if (count >= begun && record_.reached()) break;
      from = count;
    }
    all_.stop = job_.manifest.stop = record_;
    return std::move(all_);
  }

  void warning(std::string_view text) override { to_.warning(text); }

  void member_stored(const MemberResult& result) override {
    if (asset_)
      asset_->add(result);
    else
      counts_.add(result);
    to_.member_stored(result);
  }

  void ensemble_progress(const RunnerProgress& round, std::int64_t) override {
    RunnerProgress p = round;
    p.n_done += static_cast<std::int64_t>(all_.computed.size());
    p.n_failed += static_cast<std::int64_t>(all_.failed.size());
    p.n_total = std::max(expected_count(record_, job_.growth->looks), job_.design.n_members()) -
                finished_before_;
    p.elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const auto done = static_cast<double>(p.n_done);
    const bool known = p.n_done > 0 && p.elapsed_s > 0;
    p.members_per_hour = known ? 3600 * done / p.elapsed_s : 0;
    p.eta_s = known ? p.elapsed_s * static_cast<double>(p.n_total - p.n_done) / done : nan_d;
    p.half_width = found().half_width;
    p.wanted_half_width = record_.wanted_half_width;
    to_.ensemble_progress(p, finished_before_);
  }

 private:
  /// Members [from, count) are those of the round: what is to do, and the counts of the others.
  void begin_round(std::int64_t from, std::int64_t count) {
    if (count > job_.design.n_members()) {
      grow_design(job_, count, to_);
    } else {
      job_.to_do.clear();
      std::copy_if(waiting_.begin(), waiting_.end(), std::back_inserter(job_.to_do),
                   [&](std::int64_t k) { return k >= from && k < count; });
    }
    const std::set<std::int64_t> to_do(job_.to_do.begin(), job_.to_do.end());
    if (static_cast<std::int64_t>(to_do.size()) == count - from) return;
    const MemberStore stored = members_of(
        job_.folder, job_.manifest, job_.design,
        [&](std::int64_t k) { return k >= from && k < count && !to_do.contains(k); },
        CancelFlag(cancel_));
    std::vector<float> arrival;
    for (std::size_t i = 0; i < stored.members().size(); ++i) {
      const MemberSummary& member = stored.members()[i];
      if (!is_valid(member.outcome)) continue;
      arrival.resize(member.window.n_cells());
      if (!arrival.empty()) stored.read_part(i, PeakLayer::arrival, member.window, arrival);
      if (asset_)
        asset_->add(stored.grid(), member.window, arrival, member.censoring);
      else
        counts_.add(member.window, arrival);
    }
  }

  void run_round() {
    if (job_.to_do.empty()) {
      all_.finished = job_.finished_before;
      all_.interrupted = cancel_.load();
      return;
    }
    Observer silent;  // what it says of the machine was said when the job was prepared
    share_machine(job_, silent);
    MembersRun round = run_ensemble(job_, *this, cancel_);
    const auto append = [](auto& to, auto& from) {
      to.insert(to.end(), std::make_move_iterator(from.begin()),
                std::make_move_iterator(from.end()));
    };
    append(all_.computed, round.computed);
    append(all_.failed, round.failed);
    all_.wall_s += round.wall_s;
    all_.storing_s += round.storing_s;
    all_.finished = job_.finished_before = round.finished;
    all_.interrupted = round.interrupted;
    all_.stop_error = std::move(round.stop_error);
  }

  LargestHalfWidth found() const {
    return asset_ ? asset_->half_width() : counts_.largest_half_width();
  }

  void look(std::int64_t count) {
    ++record_.n_looks;
    record_.last = {count, found()};
    to_.looked(record_);
  }

  EnsembleJob& job_;
  Observer& to_;
  const std::atomic<bool>& cancel_;
  const std::int64_t finished_before_;
  const std::vector<std::int64_t> waiting_;
  const Clock::time_point start_ = Clock::now();
  ArrivalCounts counts_;             // of the map
  std::optional<AssetCount> asset_;  // or of one asset
  StopRecord record_;
  MembersRun all_;
};

}  // namespace

StopRecord stop_before(const EnsembleJob& job) {
  StopRecord record;
  record.wanted_half_width = job.growth->wanted_half_width;
  record.at_most = job.growth->whole.n_members();
  if (job.growth->asset) record.asset = job.growth->asset->name;
  record.last.found.half_width = nan_d;
  return record;
}

MembersRun run_until_converged(EnsembleJob& job, Observer& observer,
                               const std::atomic<bool>& cancel) {
  expect(job.growth.has_value(), "a job with a stop rule");
  return Rounds(job, observer, cancel).run();
}

}  // namespace sturz::workflow
