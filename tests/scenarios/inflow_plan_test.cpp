// SPDX-License-Identifier: Apache-2.0
// Columns of an inflow: volumes, times, places, and what the keys refuse.
#include "scenarios/assembly/inflow/inflow_plan.hpp"

#include "engine/core/constants.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace sturz::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

Hydrograph flood() { return {{0, 10, 40, 60}, {0, 30, 5, 0}, {}}; }

struct Made {
  Scenario scene = channel(2);
  SceneInputs inputs;
  InflowPlan plan;

  Made(Hydrograph h, std::vector<std::vector<Vec2>> lines,
       std::vector<std::vector<Vec2>> rings = {}, std::int64_t member = 0,
       double direction_deg = std::nan("")) {
    SyntheticScene ground = make_synthetic(*scene.terrain.synthetic);
    inputs.whole = ground.bed.grid;
    inputs.elevation = std::make_shared<const Raster<double>>(std::move(ground.bed));
    inputs.inflow = {{"inflow[0]", std::move(h), std::move(lines), std::move(rings)}};
    InflowSpec source;
    if (!std::isnan(direction_deg)) source.direction_deg = Uncertain(direction_deg);
    scene.inflow = {source};
    const Terrain bed(std::make_shared<const Raster<double>>(*inputs.elevation),
                      NodataRule::outflow);
    plan = plan_inflow(
        scene, inputs, bed, [](double) { return 1500.0; }, member);
  }
};

const std::vector<std::vector<Vec2>> gate{{Vec2(-80, -10), Vec2(-80, 10)}};

TEST(Hydrograph, IntegratesAndComesBack) {
  const Hydrograph h = flood();
  const HydrographVolume v(h);
  EXPECT_NEAR(v.total_m3(), 150 + 525 + 50, 1e-12);
  EXPECT_NEAR(v.until(10), 150, 1e-12);
  EXPECT_NEAR(v.until(5), 37.5, 1e-12);
  EXPECT_EQ(v.until(-3), 0);
  EXPECT_NEAR(v.until(99), 725, 1e-12);
  for (const double t : {0.5, 5.0, 10.0, 17.0, 39.9, 52.0, 59.0})
    EXPECT_NEAR(v.time_of(v.until(t)), t, 1e-9) << t;
  EXPECT_EQ(h.discharge(60.1), 0);
  EXPECT_NEAR(h.discharge(25), 17.5, 1e-12);
  // A pause of the flow: its end, not its beginning, is when more comes.
  const Hydrograph paused{{0, 10, 20, 30, 40}, {2, 0, 0, 2, 0}, {}};
  EXPECT_GT(HydrographVolume(paused).time_of(10 + 1e-9), 20);
}

TEST(InflowPlan, ColumnsAddUpToTheHydrograph) {
  const Made made(flood(), gate);
  const InflowPlan& p = made.plan;
  EXPECT_NEAR(p.volume_m3, 725, 1e-9);
  double sum = 0, largest = 0;
  const HydrographVolume integral(made.inputs.inflow[0].hydrograph);
  for (const TimedArrival& c : p.columns) {
    const double own = c.arrival.volume;
    EXPECT_NEAR(integral.until(c.time_s), sum + 0.5 * own, 1e-6) << "enters when half has passed";
    sum += own;
    largest = std::max(largest, own);
    EXPECT_NEAR(c.arrival.mass, 1500 * own, 1e-9);
    EXPECT_NEAR(c.arrival.position.x(), -80, 0.11) << "the release's jitter";
    EXPECT_LT(std::abs(c.arrival.position.y()), 10.11);
    EXPECT_GT(c.arrival.velocity.x(), 0) << "down the slope";
  }
  EXPECT_NEAR(sum, 725, 1e-9);
  // q = 1.5 m2/s at the peak: h = (q^2/g)^(1/3) along the normal, on 2 m x 2 m of the map.
  const double h = std::cbrt(1.5 * 1.5 / standard_gravity);
  EXPECT_NEAR(p.most_thickness_m, h, 1e-4);
  EXPECT_NEAR(p.most_speed_m_s, std::cbrt(standard_gravity * 1.5), 1e-4);
  EXPECT_NEAR(largest, 4 * h / std::cos(20 * 0.017453292519943295), 0.02);
}

TEST(InflowPlan, NeighboursInTimeAreNoneInSpace) {
  const Made made({{0, 100}, {40, 40}, {}}, gate);
  std::vector<double> y;
  for (const auto& c : made.plan.columns) y.push_back(c.arrival.position.y());
  ASSERT_GT(y.size(), 200u);
  for (std::size_t i = 0; i + 1 < y.size(); ++i) EXPECT_GT(std::abs(y[i + 1] - y[i]), 5) << i;
  // Every tenth of the width gets its tenth of any hundred.
  for (int tenth = 0; tenth < 10; ++tenth)
    EXPECT_NEAR(std::count_if(y.begin(), y.begin() + 100,
                              [&](double v) { return std::floor((v + 10) / 2) == tenth; }),
                10, 2)
        << tenth;
}

TEST(InflowPlan, DependsOnMemberAndNumberOnly) {
  const Made a(flood(), gate), b(flood(), gate), other(flood(), gate, {}, 1);
  ASSERT_EQ(a.plan.columns.size(), b.plan.columns.size());
  for (std::size_t i = 0; i < a.plan.columns.size(); ++i)
    EXPECT_EQ(a.plan.columns[i].arrival.position, b.plan.columns[i].arrival.position);
  EXPECT_NE(a.plan.columns[0].arrival.position, other.plan.columns[0].arrival.position);
}

TEST(InflowPlan, KnowsHowNarrowItIs) {
  EXPECT_NEAR(Made(flood(), gate).plan.narrowest_m, 20, 1e-9);
  // Across the way only: 20 m at 60 degrees to it.
  EXPECT_NEAR(Made(flood(), gate, {}, 0, 120).plan.narrowest_m, 20 * std::cos(0.5235987755982988),
              1e-9);
}

TEST(InflowPlan, APolygonIsFilledAndFlowsDownTheSlope) {
  const std::vector<Vec2> triangle{Vec2(-80, -10), Vec2(-60, -10), Vec2(-60, 10), Vec2(-80, -10)};
  const Made made({{0, 100}, {40, 40}, {}}, {}, {triangle});
  for (const auto& c : made.plan.columns) {
    const Vec3& p = c.arrival.position;
    EXPECT_LT(p.y(), p.x() + 70 + 0.3) << "inside, up to the jitter";
    EXPECT_GT(c.arrival.velocity.x(), 1);
    EXPECT_NEAR(c.arrival.velocity.y(), 0, 1e-9);
  }
  EXPECT_NEAR(made.plan.x_m, -80 + 40.0 / 3, 0.5) << "its centroid";
  const Made north({{0, 100}, {40, 40}, {}}, {}, {triangle}, 0, 0);
  EXPECT_GT(north.plan.columns[0].arrival.velocity.y(), 1) << "0 degrees is north";
}

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> out;
  for (const auto& p : validate(s)) out.push_back(p.message);
  return out;
}

TEST(FlowChecks, SayWhatCannotBe) {
  Scenario s = channel();
  InflowSpec source;
  source.hydrograph = "flood.csv";
  source.line_m = {{0, 0}, {0, 5}};
  s.inflow = {source};
  EXPECT_TRUE(messages(s).empty()) << messages(s).front();
  s.formulation = Formulation::full_stress;
  EXPECT_THAT(messages(s), Contains(HasSubstr("inflow (formulation is full_stress")));
  s = channel();
  EXPECT_THAT(messages(s), Contains(HasSubstr("release (no source given)")));
  s.inflow = {source};
  s.inflow[0].polygon = "lake.gpkg";
  EXPECT_THAT(messages(s), Contains(HasSubstr("inflow[0] (more than one place")));
  s.inflow[0] = source;
  s.inflow[0].discharge_factor = Uncertain(-1);
  EXPECT_THAT(messages(s), Contains(HasSubstr("inflow[0].discharge_factor = -1 (must be > 0")));
  s.inflow[0] = source;
  s.release.thickness_m = Uncertain(1);
  EXPECT_THAT(messages(s), Contains(HasSubstr("release.thickness_m (there is no source")));
  s.release.thickness_m.reset();
  s.domain.periodic = {"y"};
  EXPECT_THAT(messages(s), Contains(HasSubstr("inflow (domain.periodic")));
  s.domain.periodic.clear();
  s.gauges.emplace();
  EXPECT_THAT(messages(s), Contains(HasSubstr("gauges (names no point and no line)")));
  s.gauges->points = {{"a", {{{0, 0}}}}, {"a", {{{1, 0}}}}};
  EXPECT_THAT(messages(s), Contains(HasSubstr("the name a stands there twice")));
  s.gauges->points.clear();
  s.gauges->lines = {{"b", {{{0, 0}}}}};
  EXPECT_THAT(messages(s), Contains(HasSubstr("gauges.lines[0].points_m (a line has two corners")));
}

TEST(FlowChecks, NumbersOfAnInflowAreSampled) {
  Scenario s = channel();
  InflowSpec source;
  source.discharge_factor.emplace().distribution.emplace().min = 0.5;
  source.discharge_factor->distribution->max = 2;
  s.inflow = {InflowSpec{}, source};
  const auto keys = uncertain_keys(s);
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].path, "inflow[1].discharge_factor");
  EXPECT_EQ(with_value(s, keys[0].path, 1.25).inflow[1].discharge_factor->value, 1.25);
  ASSERT_TRUE(key_of_number("inflow[1].start_time_s"));
  EXPECT_EQ(key_of_number("inflow[1].start_time_s")->units, "s");
}

}  // namespace
}  // namespace sturz::test
