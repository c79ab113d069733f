// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/evaluation/evaluator.hpp"

#include "engine/core/error.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace sturz::workflow {
namespace {

using test::Workflow;
using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

class AnEvaluator : public Workflow {
 protected:
  /// Members of many seconds.
  static std::string long_scene() {
    return test::replaced(test::tiny_scene(), "end_time_s: 3",
                          "end_time_s: 600, stop_at_rest: false");
  }
  EvaluatorRequest request(int workers = 1, const std::string& text = test::tiny_scene()) const {
    write("scene.yaml", text);
    EvaluatorRequest r;
    r.scene.file = path("scene.yaml");
    r.scene.predicts = false;
    r.workers = workers;
    r.threads = 1;
    return r;
  }
  /// Asks for `n` members at once, each holding on in its first progress until `wanted` run or the
  /// time is up; then all are cancelled. \return the most that ran at one time
  static int most_at_once(Evaluator& evaluator, int n, int wanted,
                          std::chrono::milliseconds patience) {
    std::atomic<bool> over{false};
    std::atomic<int> running{0}, most{0};
    const auto meet = [&](const Progress&) {
      const int now = ++running;
      for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
      }
      const auto until = std::chrono::steady_clock::now() + patience;
      while (most < wanted && std::chrono::steady_clock::now() < until)
        std::this_thread::sleep_for(1ms);
      --running;
      over = true;
    };
    std::vector<std::thread> threads;
    for (int k = 0; k < n; ++k)
      threads.emplace_back([&] { evaluator.evaluate(evaluator.medians(), over, meet); });
    for (std::thread& thread : threads) thread.join();
    return most;
  }
};

TEST_F(AnEvaluator, computes_as_many_members_at_once_as_it_has_workers) {
  Evaluator two(request(2, long_scene()));
  EXPECT_EQ(two.workers(), 2);
  EXPECT_EQ(most_at_once(two, 4, 2, 10s), 2);
  Evaluator one(request(1, long_scene()));
  EXPECT_EQ(most_at_once(one, 3, 2, 300ms), 1);
}

TEST_F(AnEvaluator, gives_the_same_bits_for_the_same_values_and_others_for_others) {
  Evaluator evaluator(request());
  const std::atomic<bool> never{false};
  const std::vector<double> values{0.4, 0.1}, others{0.5, 0.1};
  const MemberResult first = evaluator.evaluate(values, never);
  ASSERT_TRUE(is_valid(first.outcome)) << first.reason;
  EXPECT_EQ(first.state_hash, evaluator.evaluate(values, never).state_hash);
  EXPECT_NE(first.state_hash, evaluator.evaluate(others, never).state_hash);
}

TEST_F(AnEvaluator, refuses_values_outside_their_keys_ranges_all_at_once) {
  Evaluator evaluator(request());
  const std::atomic<bool> never{false};
  const std::vector<double> wrong{-1, 2}, too_few{0.3};
  try {
    evaluator.evaluate(wrong, never);
    FAIL();
  } catch (const SetupError& problem) {
    EXPECT_THAT(problem.what(), AllOf(HasSubstr("basal.friction_coefficient = -1 (must be"),
                                      HasSubstr("basal.pore_pressure_ratio = 2 (must be")));
  }
  EXPECT_THROW(evaluator.evaluate(too_few, never), SetupError);
}

TEST_F(AnEvaluator, comes_back_cancelled_also_while_it_waits_for_its_turn) {
  Evaluator evaluator(request());
  std::atomic<bool> cancel{true};
  EXPECT_EQ(evaluator.evaluate(evaluator.medians(), cancel).outcome, Outcome::cancelled);
}

TEST_F(AnEvaluator, couplings_of_an_ensemble_do_not_bind_one_member) {
  write("coupled.yaml",
        test::replaced(test::tiny_scene(), "members: 6",
                       "members: 6, correlation: "
                       "{basal.friction_coefficient/basal.pore_pressure_ratio: -0.3}"));
  EvaluatorRequest coupled = request();
  coupled.scene.file = path("coupled.yaml");
  Evaluator evaluator(coupled);
  const std::atomic<bool> never{false};
  EXPECT_TRUE(is_valid(evaluator.evaluate(evaluator.medians(), never).outcome));
}

TEST(OutputsOfMembers, are_named_once_and_known) {
  const std::vector<std::string> near{"runout"}, twice{"runout_m", "runout_m"};
  EXPECT_THROW(outputs_named(near), SetupError);
  EXPECT_THROW(outputs_named(twice), SetupError);
  EXPECT_EQ(usual_outputs().front().name, "runout_m");
  EXPECT_EQ(usual_outputs().front().units, "m");
}

}  // namespace
}  // namespace sturz::workflow
