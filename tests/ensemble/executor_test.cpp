// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/executor.hpp"

#include "engine/core/error.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <latch>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sturz {
namespace {

class EveryExecutor : public testing::TestWithParam<ThreadLibrary> {
 protected:
  std::atomic<bool> stop_{false};
};

TEST_P(EveryExecutor, CallsEachPieceOnce) {
  for (const int workers : {1, 2, 5}) {
    std::vector<std::atomic<int>> calls(1000);
    make_executor(workers, GetParam())->for_each(calls.size(), stop_, [&](std::size_t i) {
      ++calls[i];
    });
    for (const auto& n : calls) EXPECT_EQ(n, 1);
  }
}

TEST_P(EveryExecutor, StartsPiecesInOrderOnOneWorker) {
  std::vector<std::size_t> order;
  make_executor(1, GetParam())->for_each(50, stop_, [&](std::size_t i) { order.push_back(i); });
  std::vector<std::size_t> ascending(50);
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  EXPECT_EQ(order, ascending);
}

TEST_P(EveryExecutor, RunsAsManyPiecesAtOnceAsItHasWorkers) {
  // Three pieces that wait for one another: with fewer threads this would never end.
  std::latch all_there(3);
  std::set<std::thread::id> threads;
  std::mutex lock;
  make_executor(3, GetParam())->for_each(3, stop_, [&](std::size_t) {
    all_there.arrive_and_wait();
    const std::lock_guard guard(lock);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), 3U);
}

TEST_P(EveryExecutor, GivesTheNextPieceToTheFirstFreeWorker) {
  std::atomic<int> others{0};
  std::atomic<bool> all_done_meanwhile{false};
  make_executor(2, GetParam())->for_each(40, stop_, [&](std::size_t i) {
    if (i > 0) {
      ++others;
      return;
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (others < 39 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    all_done_meanwhile = others == 39;
  });
  EXPECT_TRUE(all_done_meanwhile) << "the long first piece held up the others";
}

TEST_P(EveryExecutor, BeginsNoPieceAfterStop) {
  std::atomic<std::size_t> begun{0};
  make_executor(2, GetParam())->for_each(1000, stop_, [&](std::size_t i) {
    ++begun;
    if (i == 10) stop_ = true;
  });
  EXPECT_GE(begun, 11U);
  EXPECT_LT(begun, 1000U);
}

TEST_P(EveryExecutor, ThrowsTheExceptionOfAPieceAfterTheOthersEnded) {
  std::atomic<int> running{0};
  const auto executor = make_executor(2, GetParam());
  EXPECT_THROW(executor->for_each(100, stop_,
                                  [&](std::size_t i) {
                                    ++running;
                                    if (i == 3) {
                                      --running;
                                      throw std::runtime_error("piece 3");
                                    }
                                    --running;
                                  }),
               std::runtime_error);
  EXPECT_EQ(running, 0);
}

TEST_P(EveryExecutor, DoesNothingForNoPieces) {
  make_executor(4, GetParam())->for_each(0, stop_, [](std::size_t) { FAIL(); });
}

TEST_P(EveryExecutor, NeedsAWorker) { EXPECT_THROW(make_executor(0, GetParam()), SetupError); }

INSTANTIATE_TEST_SUITE_P(Libraries, EveryExecutor,
                         testing::Values(ThreadLibrary::tbb, ThreadLibrary::plain),
                         [](const auto& which) {
                           return which.param == ThreadLibrary::tbb ? "Tbb" : "Plain";
                         });

}  // namespace
}  // namespace sturz
