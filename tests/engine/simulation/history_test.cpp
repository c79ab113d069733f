// SPDX-License-Identifier: Apache-2.0
/// The rows of a member's history: which are kept, what front and tail are.
#include "engine/simulation/history.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/simulation/parts.hpp"
#include "engine/simulation/travel.hpp"
#include "tests/support/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace sturz {
namespace {

using ::testing::ElementsAre;

HistoryRow at(double time_s) {
  HistoryRow row;
  row.time_s = static_cast<float>(time_s);
  return row;
}

std::vector<float> times(const HistoryRecorder& recorder) {
  std::vector<float> all;
  for (const HistoryRow& row : recorder.rows()) all.push_back(row.time_s);
  return all;
}

/// Looks at uneven intervals around 0.1 s, the same every time.
std::vector<double> looks(int n) {
  std::vector<double> all;
  for (int k = 0; k < n; ++k) all.push_back(0.1 * k + 0.03 * std::sin(5.0 * k));
  all.front() = 0;
  return all;
}

TEST(History, KeepsTheFirstRowOfEachInterval) {
  HistoryRecorder recorder(1);
  for (const double t : {0.0, 0.4, 1.1, 1.9, 2.0, 4.5, 4.9}) recorder.add(at(t));
  EXPECT_THAT(times(recorder), ElementsAre(0, 1.1F, 2, 4.5F));
  EXPECT_FALSE(recorder.wants(4.99));
  EXPECT_TRUE(recorder.wants(5));
}

TEST(History, NeverGrowsBeyondItsRoom) {
  HistoryRecorder recorder(0.1);
  const HistoryRow* room = nullptr;
  for (const double t : looks(100000)) {
    recorder.add(at(t));
    ASSERT_LE(recorder.rows().size(), HistoryRecorder::most_rows);
    if (!room) room = recorder.rows().data();
    ASSERT_EQ(recorder.rows().data(), room) << "asked for memory at t = " << t;
  }
  EXPECT_GT(recorder.rows().size(), HistoryRecorder::most_rows / 3);
}

TEST(History, WhatIsLeftIsWhatTheWiderIntervalWouldHaveKept) {
  HistoryRecorder narrow(0.1);
  for (const double t : looks(5000)) narrow.add(at(t));
  EXPECT_EQ(narrow.interval_s(), 0.1 * 16);
  HistoryRecorder wide(narrow.interval_s());
  for (const double t : looks(5000)) wide.add(at(t));
  EXPECT_EQ(times(narrow), times(wide));
}

TEST(History, ThinsOutEvenWhereLooksAreRarerThanTheInterval) {
  HistoryRecorder recorder(1e-3);
  for (int k = 0; k <= 1000; ++k) recorder.add(at(0.5 * k));
  EXPECT_LE(recorder.rows().size(), HistoryRecorder::most_rows);
  for (std::size_t i = 1; i < recorder.rows().size(); ++i)
    EXPECT_NEAR(recorder.rows()[i].time_s - recorder.rows()[i - 1].time_s, 2, 0.6);
}

TEST(History, EndsWithTheEnd) {
  HistoryRecorder recorder(1);
  for (const double t : {0.0, 1.5}) recorder.add(at(t));
  HistoryRow last = at(1.7);
  recorder.add_last(last);
  EXPECT_THAT(times(recorder), ElementsAre(0, 1.5F, 1.7F));
  last.com_travel_m = 3;
  recorder.add_last(last);
  EXPECT_THAT(times(recorder), ElementsAre(0, 1.5F, 1.7F));
  EXPECT_EQ(recorder.rows().back().com_travel_m, 3);
}

TEST(History, TheTableNamesEveryFieldOnceInOrder) {
  const HistoryRow row;
  std::set<std::string> names;
  std::ptrdiff_t expected = 0;
  for (const HistoryColumn& column : history_table()) {
    EXPECT_EQ(&(row.*column.field) - &row.time_s, expected++) << column.name;
    EXPECT_TRUE(names.insert(column.name).second);
  }
  EXPECT_EQ(names.size() * sizeof(float), sizeof(HistoryRow));
  EXPECT_STREQ(history_table()[0].name, "time");
  MemberHistory dry;
  EXPECT_TRUE(dry.has(HistoryPart::motion));
  EXPECT_FALSE(dry.has(HistoryPart::states) || dry.has(HistoryPart::temperature));
}

/// Particles in a row that have moved: particle i by i metres eastward, at i m/s.
SimulationParts moved_row(int n) {
  std::vector<Vec3> positions;
  for (int i = 0; i < n; ++i) positions.emplace_back(0, i, 0.5 * i);
  test::HandMade made = test::particles_on(test::even_ground(2 * n + 4), positions, {0, 0, 0});
  SimulationParts parts{std::move(made.state), std::move(made.step),
                        PeakMaps({.grid = Grid{1, 1, 0, 1, 1, ""}}), StopRule({})};
  MovingSet& p = parts.state.grains();
  mark_start(parts.state.domain, p, 0);
  for (int i = 0; i < n; ++i) p.x[i] += i, p.vx[i] = i;
  return parts;
}

TEST(Travel, IsThatOfTheMass) {
  const SimulationParts parts = moved_row(201);
  std::vector<ParticleTravel> each;
  const Displacement d = measure(parts.state, each);
  EXPECT_EQ(d.front, 200);
  EXPECT_NEAR(d.com, 100, 1e-12);
  EXPECT_NEAR(d.mean_speed, 100, 1e-12);
  EXPECT_EQ(d.high_speed, 200);
  EXPECT_EQ(d.lowest, 0);
  EXPECT_EQ(each.size(), 201U);
}

TEST(Travel, FrontAndTailAreSharesOfTheMass) {
  const SimulationParts parts = moved_row(201);
  std::vector<ParticleTravel> each;
  measure(parts.state, each);
  const FrontAndTail ends = front_and_tail(each);
  EXPECT_EQ(ends.front_speed, 199.5);  // particles 199 and 200 of 201
  EXPECT_EQ(ends.tail_speed, 1);       // 0, 1, 2: two of 201 are less than 1 %
  EXPECT_EQ(ends.tail_travel, 10);     // 0 .. 10: ten of 201 are less than 5 %
}

TEST(Travel, AHeavyParticleCountsByItsMass) {
  SimulationParts parts = moved_row(201);
  parts.state.grains().mass[150] *= 1e6;
  std::vector<ParticleTravel> each;
  measure(parts.state, each);
  const FrontAndTail ends = front_and_tail(each);
  EXPECT_EQ(ends.tail_travel, 150);
  EXPECT_NEAR(ends.front_speed, 175.5, 1e-9);  // all ahead of it are less than 1 % of the mass
  EXPECT_GT(ends.tail_speed, 149);
}

TEST(Travel, OneParticleIsFrontAndTail) {
  SimulationParts parts = moved_row(1);
  parts.state.grains().vz[0] = -3;
  parts.state.grains().x[0] += 4;
  std::vector<ParticleTravel> each;
  measure(parts.state, each);
  const FrontAndTail ends = front_and_tail(each);
  EXPECT_EQ(ends.front_speed, 3);
  EXPECT_EQ(ends.tail_speed, 3);
  EXPECT_EQ(ends.tail_travel, 4);
}

TEST(Travel, CountsWholePeriodsAndIdsRatherThanPlaces) {
  SimulationParts parts = moved_row(3);
  std::vector<std::uint32_t> turned{2, 0, 1};
  parts.state.grains().permute(turned);
  parts.state.grains().wrapped_x = {10, 20, 30};  // by id
  parts.state.grains().wrapped_y = {0, 0, 0};
  std::vector<ParticleTravel> each;
  const Displacement d = measure(parts.state, each);
  EXPECT_EQ(d.front, 32);
  EXPECT_NEAR(d.com, 21, 1e-12);
}

}  // namespace
}  // namespace sturz
