// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/runner.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <latch>
#include <map>
#include <new>
#include <numeric>
#include <thread>

namespace sturz {
namespace {

using testing::IsEmpty;
using testing::SizeIs;
using namespace std::chrono_literals;

struct Case {
  int workers;
  ThreadLibrary threads;
};

/// A run of twenty pretended members; what was stored is kept by number.
class EveryRunner : public testing::TestWithParam<Case> {
 protected:
  EveryRunner() {
    plan_.members.resize(20);
    std::iota(plan_.members.begin(), plan_.members.end(), 0);
    plan_.workers = GetParam().workers;
    plan_.threads = GetParam().threads;
    callbacks_.run_member = [](std::int64_t member, const std::atomic<bool>&) {
      return finished(member);
    };
    callbacks_.store = [this](const MemberResult& r) {
      EXPECT_EQ(users_++, 0) << "store is called by two at once";
      EXPECT_FALSE(stored_.contains(r.member)) << "member stored twice";
      stored_[r.member] = r;
      std::this_thread::sleep_for(500us);  // time for a second caller to show up
      --users_;
    };
  }

  static MemberResult finished(std::int64_t member) {
    MemberResult r;
    r.member = member;
    r.outcome = Outcome::settled;
    r.scalars.runout_m = 100.0 + static_cast<double>(member);
    return r;
  }

  /// Works until told to stop.
  static MemberResult endless(std::int64_t member, const std::atomic<bool>& cancel) {
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while (!cancel && std::chrono::steady_clock::now() < limit) std::this_thread::sleep_for(1ms);
    EXPECT_TRUE(cancel) << "the member was not told to stop";
    MemberResult r;
    r.member = member;
    r.outcome = Outcome::cancelled;
    return r;
  }

  RunReport run() { return run_members(plan_, callbacks_, cancel_); }

  RunPlan plan_;
  RunCallbacks callbacks_;
  std::atomic<bool> cancel_{false};
  std::atomic<int> users_{0};
  std::map<std::int64_t, MemberResult> stored_;
};

TEST_P(EveryRunner, StoresEveryMemberOnce) {
  const RunReport report = run();
  EXPECT_TRUE(report.complete());
  EXPECT_FALSE(report.interrupted);
  EXPECT_THAT(report.failed, IsEmpty());
  ASSERT_THAT(stored_, SizeIs(20));
  for (const auto& [member, result] : stored_) EXPECT_EQ(result.scalars.runout_m, 100.0 + member);
}

TEST_P(EveryRunner, RecordsAThrowingMemberAndGoesOn) {
  callbacks_.run_member = [](std::int64_t member, const std::atomic<bool>&) {
    if (member == 7) throw SetupError("release.volume_m3 = 0 (nothing moves). Give a volume.");
    return finished(member);
  };
  const RunReport report = run();
  EXPECT_TRUE(report.complete());
  EXPECT_FALSE(report.interrupted);
  EXPECT_THAT(stored_, SizeIs(20));
  ASSERT_THAT(report.failed, SizeIs(1));
  EXPECT_EQ(report.failed[0].member, 7);
  EXPECT_EQ(stored_.at(7).outcome, Outcome::failed);
  EXPECT_EQ(stored_.at(7).reason, "release.volume_m3 = 0 (nothing moves). Give a volume.");
  EXPECT_EQ(report.progress.n_failed, 1);
}

TEST_P(EveryRunner, SurvivesAnythingThatCanBeThrown) {
  callbacks_.run_member = [](std::int64_t member, const std::atomic<bool>&) -> MemberResult {
    if (member == 1) throw std::bad_alloc();
    if (member == 2) throw 42;
    if (member == 3) throw std::logic_error("broken promise");
    MemberResult r = finished(member);
    if (member == 4) r.outcome = Outcome::diverged;
    return r;
  };
  const RunReport report = run();
  EXPECT_TRUE(report.complete());
  ASSERT_THAT(report.failed, SizeIs(4));
  const char* reasons[] = {"out of memory", "unknown exception", "broken promise", ""};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(report.failed[i].member, i + 1);
    EXPECT_EQ(report.failed[i].reason, reasons[i]);
  }
  EXPECT_EQ(report.failed[3].outcome, Outcome::diverged);
}

TEST_P(EveryRunner, StopsSoonWhenCancelledAndKeepsWhatIsDone) {
  callbacks_.run_member = [this](std::int64_t member, const std::atomic<bool>& cancel) {
    if (member < 5) return finished(member);
    cancel_ = true;
    return endless(member, cancel);
  };
  const RunReport report = run();
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(report.complete());
  EXPECT_THAT(stored_, SizeIs(5));
  EXPECT_EQ(report.progress.n_done, 5);
  EXPECT_EQ(report.progress.n_running, 0);
  EXPECT_THAT(report.failed, IsEmpty()) << "a cancelled member is not a failed one";
}

TEST_P(EveryRunner, StartsNothingWhenCancelledBefore) {
  cancel_ = true;
  EXPECT_TRUE(run().interrupted);
  EXPECT_THAT(stored_, IsEmpty());
}

TEST_P(EveryRunner, StopsOnceWhenStoringFails) {
  int attempts = 0;
  const auto keep = callbacks_.store;
  callbacks_.store = [&](const MemberResult& r) {
    if (stored_.size() == 6) {
      ++attempts;
      throw std::runtime_error("members/000006.nc: no space left on device");
    }
    keep(r);
  };
  const RunReport report = run();
  EXPECT_EQ(report.stop_error, "members/000006.nc: no space left on device");
  EXPECT_EQ(attempts, 1);
  EXPECT_THAT(stored_, SizeIs(6));
  EXPECT_EQ(report.progress.n_done, 6);
  EXPECT_FALSE(report.interrupted);
  EXPECT_FALSE(report.complete());
}

TEST_P(EveryRunner, StopsForWhatIsWrongWithAllMembersAlike) {
  callbacks_.run_member = [](std::int64_t member, const std::atomic<bool>& cancel) {
    if (member == 5) throw StopsRun("the terrain is gone");
    return member < 5 ? finished(member) : endless(member, cancel);
  };
  const RunReport report = run();
  EXPECT_EQ(report.stop_error, "the terrain is gone");
  EXPECT_THAT(report.failed, IsEmpty()) << "the member remains to be done";
  EXPECT_LE(stored_.size(), 5U);
  EXPECT_FALSE(report.interrupted);
  EXPECT_FALSE(report.complete());
  EXPECT_EQ(report.progress.n_running, 0);
}

TEST_P(EveryRunner, StoresNothingMoreAfterAFailureEvenWhatWasComputedMeanwhile) {
  plan_.members.resize(static_cast<std::size_t>(plan_.workers));
  std::latch all_computed(plan_.workers);
  callbacks_.run_member = [&](std::int64_t member, const std::atomic<bool>&) {
    all_computed.arrive_and_wait();
    return finished(member);
  };
  int attempts = 0;
  callbacks_.store = [&](const MemberResult&) {
    ++attempts;
    throw std::runtime_error("no space left on device");
  };
  const RunReport report = run();
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(report.progress.n_done, 0);
}

TEST_P(EveryRunner, ReportsProgressThatOnlyGrows) {
  std::vector<RunnerProgress> seen;
  callbacks_.on_progress = [&](const RunnerProgress& p) {
    EXPECT_EQ(users_++, 0) << "on_progress is called beside another callback";
    seen.push_back(p);
    --users_;
  };
  callbacks_.run_member = [](std::int64_t member, const std::atomic<bool>&) {
    if (member == 3) throw std::runtime_error("bad");
    return finished(member);
  };
  run();
  ASSERT_GE(seen.size(), 20U);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_GE(seen[i].n_done, seen[i - 1].n_done);
    EXPECT_LE(seen[i].n_running, plan_.workers);
  }
  const RunnerProgress& last = seen.back();
  EXPECT_EQ(last.n_total, 20);
  EXPECT_EQ(last.n_done, 20);
  EXPECT_EQ(last.n_failed, 1);
  EXPECT_EQ(last.eta_s, 0);
  EXPECT_NEAR(last.members_per_hour, 20 * 3600 / last.elapsed_s, 1e-6 * last.members_per_hour);
}

TEST_P(EveryRunner, TicksWhileALongMemberRuns) {
  plan_.members = {0};
  plan_.progress_every_s = 0.05;
  std::atomic<int> ticks{0};
  callbacks_.on_progress = [&](const RunnerProgress& p) { ticks += p.n_running == 1; };
  callbacks_.run_member = [&](std::int64_t member, const std::atomic<bool>&) {
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while (ticks < 2 && std::chrono::steady_clock::now() < limit) std::this_thread::sleep_for(1ms);
    return finished(member);
  };
  run();
  EXPECT_GE(ticks, 2);
}

TEST_P(EveryRunner, PassesOnAnExceptionOfTheDisplayAfterTheMembers) {
  callbacks_.on_progress = [](const RunnerProgress&) { throw std::runtime_error("no terminal"); };
  EXPECT_THROW(run(), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Workers, EveryRunner,
                         testing::Values(Case{1, ThreadLibrary::tbb}, Case{2, ThreadLibrary::tbb},
                                         Case{1, ThreadLibrary::plain},
                                         Case{2, ThreadLibrary::plain}),
                         [](const auto& which) {
                           return (which.param.threads == ThreadLibrary::tbb ? "Tbb" : "Plain") +
                                  std::to_string(which.param.workers);
                         });

}  // namespace
}  // namespace sturz
