// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/guard.hpp"

#include "tests/workflow/workflow_fixture.hpp"

#include <chrono>
#include <ctime>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using workflow::Guard;
using workflow::GuardLimits;
using workflow::StopCause;

int minute_now() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  return 60 * local.tm_hour + local.tm_min;
}

class Guards : public Workflow {
 protected:
  std::atomic<bool> interrupt{false};

  /// Whether the guard's own thread raises the flag within three seconds.
  static bool raises(const Guard& guard) {
    for (int i = 0; i < 300 && !guard.flag(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return guard.flag();
  }
};

TEST_F(Guards, WithoutLimitsOnlyASignalCounts) {
  Guard guard({}, interrupt);
  EXPECT_FALSE(guard.look());
  EXPECT_FALSE(guard.flag());
  interrupt = true;
  EXPECT_TRUE(raises(guard));
  EXPECT_EQ(guard.look().cause, StopCause::interrupted);
}

TEST_F(Guards, AStopFileRaisesTheFlag) {
  Guard guard({{}, path("STOP"), {}, 0, 0}, interrupt);
  EXPECT_FALSE(guard.look());
  write("STOP", "");
  EXPECT_TRUE(raises(guard));
  EXPECT_EQ(guard.look().cause, StopCause::stop_file);
  std::filesystem::remove(path("STOP"));
  EXPECT_TRUE(guard.look()) << "the first reason is kept";
  guard.clear();
  EXPECT_FALSE(guard.look());
}

TEST_F(Guards, TheTimeOfDayCounts) {
  constexpr int day = 1440;
  const int now = minute_now();
  Guard open({DayWindow{(now + day - 60) % day, (now + 60) % day}, {}, {}, 0, 0}, interrupt);
  EXPECT_FALSE(open.look());
  EXPECT_EQ(open.minutes_to_wait(), 0);
  Guard closed({DayWindow{(now + 60) % day, (now + 120) % day}, {}, {}, 0, 0}, interrupt);
  EXPECT_EQ(closed.look().cause, StopCause::window);
  EXPECT_NEAR(closed.minutes_to_wait(), 60, 1);
}

TEST_F(Guards, DiskAndMemoryHaveLimits) {
  const double free = workflow::free_disk_bytes(path(""));
  EXPECT_GT(free, 0);
  Guard enough({{}, {}, path(""), 1, 0}, interrupt);
  EXPECT_FALSE(enough.look());
  Guard full({{}, {}, path(""), 1e18, 0}, interrupt);
  const auto reason = full.look();
  EXPECT_EQ(reason.cause, StopCause::disk);
  EXPECT_THAT(reason.text, HasSubstr("less than min_free_disk_gb = 1e+09"));
  Guard small({{}, {}, {}, 0, 1e6}, interrupt);
  EXPECT_EQ(small.look().cause, StopCause::memory);
}

TEST_F(Guards, ASignalGoesBeforeAllElse) {
  write("STOP", "");
  Guard guard({{}, path("STOP"), {}, 0, 0}, interrupt);
  EXPECT_EQ(guard.look().cause, StopCause::stop_file);
  interrupt = true;
  EXPECT_EQ(guard.look().cause, StopCause::interrupted);
}

}  // namespace
}  // namespace sturz::test
