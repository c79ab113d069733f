// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/history.hpp"

#include "engine/core/error.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace sturz::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string run(const std::string& processor, const std::string& day, double value,
                bool more_is_better = true, double others = 0) {
  Report report;
  Summary s;
  s.median = value, s.low = value - 0.01, s.high = value + 0.01;
  report.tell("slide: engine / reference", s, "one sentence", more_is_better);
  return history_line(report, {{"machine",
                                {{"processor", processor},
                                 {"cores", 2},
                                 {"instruction_set", "avx2"},
                                 {"date", day + "T08:00:00Z"},
                                 {"commit", "0123456789ab"}}},
                               {"command", "throughput"},
                               {"quick", false},
                               {"pairs", 21},
                               {"load_before", 0.1},
                               {"others_cores", others}}) +
         "\n";
}

std::string shown(const std::string& text) {
  std::string all;
  for (const Table& table : history_report(text).tables) all += table.text();
  return all;
}

TEST(BenchHistory, TellsHowARatioMoved) {
  const std::string first = run("A", "2026-01-01", 0.60), same = run("A", "2026-01-02", 0.61);
  EXPECT_THAT(shown(first + same), HasSubstr("as before"));
  EXPECT_THAT(shown(first + same), HasSubstr("2026-01-01 0123456"));
  const std::string more = shown(first + same + run("A", "2026-01-03", 0.75));
  EXPECT_THAT(more, HasSubstr("better"));
  EXPECT_THAT(more, HasSubstr("25.0")) << "per cent since the first";
  EXPECT_THAT(shown(first + run("A", "2026-01-03", 0.50)), HasSubstr("worse"));
}

TEST(BenchHistory, LessMayBeBetterAndABusyMachineIsNamed) {
  const std::string cost = run("A", "2026-01-01", 1.2, false);
  EXPECT_THAT(shown(cost + run("A", "2026-01-02", 1.1, false)), HasSubstr("better"));
  EXPECT_THAT(shown(cost + run("A", "2026-01-02", 1.1, false, 1.5)),
              HasSubstr("better (busy machine)"));
}

TEST(BenchHistory, MachinesAreComparedWithThemselvesAlone) {
  const std::string text = shown(run("A", "2026-01-01", 0.60) + run("B", "2026-01-02", 0.75));
  EXPECT_THAT(text, HasSubstr("A, 2 cores"));
  EXPECT_THAT(text, HasSubstr("B, 2 cores"));
  EXPECT_THAT(text, Not(HasSubstr("better")));
}

TEST(BenchHistory, WhatIsNoRecordIsNamedInOneNoteAndTheOthersCount) {
  const std::string first = run("A", "2026-01-01", 0.60), last = run("A", "2026-01-03", 0.75);
  const std::string text = first + "1 2 3\n" + "{\"other\": NaN}\n" + last + last.substr(0, 90);
  EXPECT_THAT(shown(text), HasSubstr("25.0"));
  const std::vector<std::string> notes = history_report(text).notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_THAT(notes.back(), HasSubstr("beside 2 whole records: line 2 (no record of sturz_bench), "
                                      "line 3 (no record of sturz_bench), line 5 (cut off)"));
  EXPECT_EQ(history_report(first + last).notes.size(), 1U);
}

TEST(BenchHistory, AFigureThatIsNoNumberIsLeftOutOfItsRun) {
  const std::string text =
      run("A", "2026-01-01", 0.60) + run("A", "2026-01-02", NAN) + run("A", "2026-01-03", 0.75);
  EXPECT_THAT(shown(text), HasSubstr("25.0"));
  EXPECT_THAT(shown(text), Not(HasSubstr("nan")));
  EXPECT_THAT(history_report(text).notes.back(),
              HasSubstr("slide: engine / reference of line 2 (not a number)"));
}

TEST(BenchHistory, WithoutARecordThereIsOneClearError) {
  EXPECT_THROW(history_report("\n"), SetupError);
  try {
    history_report("{\"half\": ");
    ADD_FAILURE() << "should have thrown";
  } catch (const SetupError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("no records (line 1 (cut off)). Make one"));
  }
}

TEST(BenchHistory, ARecordAfterACutOneBeginsItsOwnLine) {
  const std::string file = ::testing::TempDir() + "bench_history_cut.jsonl";
  const std::string whole = run("A", "2026-01-01", 0.60);
  std::ofstream(file) << whole << whole.substr(0, 50);
  ASSERT_TRUE(append_history(file, whole.substr(0, whole.size() - 1)));
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_THAT(history_report(text.str()).notes.back(),
              HasSubstr("beside 2 whole records: line 2 (no record"));
}

}  // namespace
}  // namespace sturz::bench
