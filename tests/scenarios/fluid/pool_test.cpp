// SPDX-License-Identifier: Apache-2.0
/// fluid.pool: how much water there is, where it starts and whether it stays there.
#include "scenarios/assembly/liquid/pool.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/schema.hpp"
#include "tests/support/formula_ground.hpp"
#include "tests/support/liquid/pool_tank.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz {
namespace {

using test::deep;
using test::inputs_of;
using test::level;
using test::tank;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

constexpr double tank_m3 = 2 * 0.4 * deep, grains_m3 = 0.6 * 0.4 * 0.5;

TEST(Pool, HoldsTheMassOfItsClosedFormAtSharpInterfaces) {
  const Scenario s = tank();
  Simulation run = assemble(s, level(s), 0, 1);
  const MovingSet &grains = run.parts().state.sets[0], &liquid = run.parts().state.sets[1];
  EXPECT_NEAR(total(grains.mass), 2500 * 0.6 * grains_m3, 1e-9);
  EXPECT_NEAR(total(liquid.mass), 1000 * (tank_m3 - 0.6 * grains_m3), 1e-9);
  EXPECT_NEAR(liquid.ledger.released_mass, 1000 * (tank_m3 - 0.6 * grains_m3), 1e-9);
  ASSERT_EQ(liquid.size(), 20u * 4u * 10u) << "one particle a cell";
  // Masses before they are shared out by pressure: all of a cell, or the pores of it.
  const LiquidLattice at = plan_scene(s, level(s), 0).liquid_start;
  std::size_t in_pores = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const bool among = at.x[i] > 0.7 && at.x[i] < 1.3 && at.z[i] < 0.5;
    in_pores += among;
    EXPECT_NEAR(at.mass[i], among ? 0.4 : 1.0, 1e-9) << at.x[i] << ' ' << at.z[i];
    EXPECT_NEAR(at.depth[i], deep - at.z[i], 1e-9);
  }
  EXPECT_EQ(in_pores, 6u * 4u * 5u);
  EXPECT_EQ(at.n_in_release, in_pores);
}

TEST(Pool, FollowsTheGroundAndEndsAtTheShore) {
  Scenario s = tank();
  s.domain.walls.clear();
  s.fluid->pool->surface_m = Uncertain(0.8);
  const auto bowl = [](double x, double) { return 0.7 * (x - 1) * (x - 1); };
  const SceneInputs in = inputs_of(s, bowl);
  const LiquidLattice at = plan_scene(s, in, 0).liquid_start;
  double depth = 0;
  for (int c = 0; c < in.elevation->grid.n_cols; ++c)
    depth += std::max(0.0, 0.8 - in.elevation->at(0, c));
  const double water = 0.4 * 0.1 * depth;
  EXPECT_NEAR(at.pool_m3, water, 1e-12);
  // The release of 0.5 m stands in it with all of its pores.
  EXPECT_NEAR(total(at.mass), 1000 * (water - 0.6 * grains_m3), 1e-9);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_GT(at.z[i], bowl(at.x[i], 0) + 0.04);
    EXPECT_LT(at.z[i], 0.8 + 0.05);
  }
}

TEST(Pool, KnowsTheMarginOfGroundThatRepeatsItself) {
  // Falls along the period, which the release does not cover wholly.
  Scenario s = tank();
  s.release.box = ReleaseBox{{0.7, 1.3}, {-0.1, 0.1}};
  const auto tilted = [](double, double y) { return y > 0 ? 0.2 : 0.0; };
  const LiquidLattice at = plan_scene(s, inputs_of(s, tilted), 0).liquid_start;
  EXPECT_NEAR(at.pool_m3, 2 * (0.2 * 1.0 + 0.2 * 0.8), 1e-9);
  EXPECT_NEAR(total(at.mass), 1000 * (at.pool_m3 - 0.6 * 0.6 * 0.2 * 0.5), 1e-9);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_GT(at.z[i], at.y[i] > 0.1 ? 0.2 : 0.0);
}

TEST(Pool, IsCutExactlyWhereAWallCutsTheLattice) {
  Scenario s = tank();
  s.domain.walls[0].point_m = {0.03, 0, 0};
  s.domain.walls[1].point_m = {1.96, 0, 0};
  const LiquidLattice at = plan_scene(s, level(s), 0).liquid_start;
  EXPECT_NEAR(total(at.mass), 1000 * (1.93 * 0.4 * deep - 0.6 * grains_m3), 1e-9);
  EXPECT_NEAR(*std::min_element(at.x.begin(), at.x.end()), 0.08, 1e-12) << "half a spacing off it";
  EXPECT_NEAR(*std::max_element(at.x.begin(), at.x.end()), 1.91, 1e-12);
}

TEST(Pool, AnOutlineKeepsItThereAndOpenWaterIsWarnedOf) {
  Scenario s = tank();
  SceneInputs in = level(s);
  Raster<double> outline(Grid{10, 4, 0.4, 0.2, 0.1, ""}, 1.0);
  in.pool = std::make_shared<const Raster<double>>(outline);
  const ScenePlan plan = plan_scene(s, in, 0);
  EXPECT_NEAR(total(plan.liquid_start.mass), 1000 * (1.0 * 0.4 * deep - 0.6 * grains_m3), 1e-9);
  EXPECT_NEAR(plan.liquid_start.open_edge_m, 2 * 0.4, 1e-9);
  EXPECT_THAT(plan_warnings(s, plan), Contains(HasSubstr("open water: along 0.8 m")));
  EXPECT_THAT(plan_warnings(s, plan_scene(s, level(s), 0)), Each(Not(HasSubstr("open water"))));
}

TEST(Pool, EveryResultSaysThatItsWaterCountsAsReached) {
  Scenario s = tank();
  const auto warned = [&s] { return plan_warnings(s, plan_scene(s, level(s), 0)); };
  EXPECT_THAT(warned(), Contains(AllOf(HasSubstr("standing water counts"), HasSubstr("solid_"))));
  s.grains.reset();
  EXPECT_THAT(warned(),
              Contains(AllOf(HasSubstr("standing water counts"), Not(HasSubstr("solid_")))));
  s.fluid->pool.reset();
  EXPECT_THAT(warned(), Each(Not(HasSubstr("standing water counts"))));
}

TEST(Pool, WetsADryReleaseUpToItsSurfaceOnly) {
  Scenario s = tank(0.8);
  s.fluid->pool->surface_m = Uncertain(0.45);
  s.fluid->saturation = Uncertain(0);
  EXPECT_THAT(validate(s), IsEmpty());
  const ScenePlan plan = plan_scene(s, level(s), 0);
  const LiquidLattice& at = plan.liquid_start;
  const double stands = 0.6 * 0.4 * 0.45;
  EXPECT_NEAR(total(at.mass), 1000 * (2 * 0.4 * 0.45 - 0.6 * stands), 1e-9);
  EXPECT_LT(*std::max_element(at.z.begin(), at.z.end()), 0.45);
  // Grains above the water bear their weight, those below it what buoyancy leaves.
  ASSERT_EQ(at.grain_depth.size(), plan.release.x.size());
  for (std::size_t i = 0; i < at.grain_depth.size(); ++i) {
    const double below = std::max(0.0, 0.45 - plan.release.z[i]);
    EXPECT_NEAR(at.grain_depth[i], 0.8 - plan.release.z[i] - 0.4 * below, 1e-12);
  }
}

TEST(Pool, OfALiquidAloneIsOneSetWithTheRelease) {
  Scenario s = tank();
  s.grains.reset();
  Simulation run = assemble(s, level(s), 0, 1);
  ASSERT_EQ(run.parts().state.sets.size(), 1u);
  EXPECT_NEAR(total(run.parts().state.sets[0].mass), 1000 * tank_m3, 1e-9);
  EXPECT_EQ(run.parts().state.sets[0].size(), 800u);
}

TEST(Pool, DescribeNamesItAndCountsItsParticles) {
  const Scenario s = tank();
  Scenario without = s;
  without.fluid->pool.reset();
  const SceneDescription wet = describe(s, level(s)), dry = describe(without, level(s));
  EXPECT_EQ(wet.n_particles, 800u + 120u);
  EXPECT_EQ(dry.n_particles, 240u);
  EXPECT_GT(wet.memory_bytes, dry.memory_bytes + 600UL * 500);
  const auto note = std::find_if(wet.effects.begin(), wet.effects.end(),
                                 [](const EffectNote& e) { return e.name == "liquid"; });
  ASSERT_NE(note, wet.effects.end());
  EXPECT_THAT(note->reason,
              HasSubstr("`fluid.pool`: standing water up to 1 m, 0.8 m3 on 0.8 m2 "
                        "with what lies in it, 1 m or 10 layers deep, 680 particles"));
}

TEST(Pool, TheSoundSpeedKnowsItsDepth) {
  Scenario s = tank();
  s.fluid->pool->surface_m = Uncertain(4);
  EXPECT_NEAR(plan_scene(s, level(s), 0).liquid->least_sound_speed, 10 * std::sqrt(9.81 * 3.95),
              0.1);
}

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}
std::string refusal(const Scenario& s, const SceneInputs& in) {
  try {
    require_pool(s, in);
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return "";
}

TEST(PoolChecks, WhatIsMissingOrTwofoldIsSaid) {
  EXPECT_THAT(messages(tank()), IsEmpty());
  Scenario s = tank();
  s.fluid->pool->surface_m.reset();
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("fluid.pool.surface_m (missing")));
  s = tank();
  s.fluid->pool->polygon = "lake.gpkg";
  s.fluid->pool->box = MapBox{{1, 0}, {0, 1}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("fluid.pool.box (fluid.pool.polygon is there"),
                                       HasSubstr("fluid.pool.box.x_m (the second edge")));
  s = tank();
  s.fluid->pool->layer = "lakes";
  s.fluid->pool->crs = "EPSG:32633";
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("fluid.pool.layer (fluid.pool.polygon is missing"),
                                       HasSubstr("fluid.pool.crs (fluid.pool.polygon is missing")));
  s = tank();
  s.domain.walls[1].normal = {-1, 0, 0.5};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("domain.walls[1].normal (leans")));
  s = tank();
  s.formulation = Formulation::depth_averaged;
  EXPECT_THAT(messages(s), Contains(HasSubstr("fluid (formulation is depth_averaged; only")));
  s = tank();
  s.fluid->pool.reset();
  s.fluid->saturation = Uncertain(0);
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("fluid.saturation = 0 (must be 0.05 at least")));
}

TEST(PoolChecks, GroundThatCannotHoldItIsSaid) {
  Scenario s = tank();
  EXPECT_EQ(refusal(s, level(s)), "");
  s.fluid->pool->surface_m = Uncertain(-0.1);
  EXPECT_THAT(refusal(s, level(s)),
              HasSubstr("fluid.pool.surface_m = -0.1 (the ground there lies at 0 m and higher"));
  s.fluid->pool->surface_m = Uncertain(0.15);
  EXPECT_THAT(refusal(s, level(s)), HasSubstr("= 0.15 (1.5 layers of particles where the water"));
  s.numerics.accept_unresolved = true;
  EXPECT_EQ(refusal(s, level(s)), "");
  s = tank();
  s.domain.walls.pop_back();
  EXPECT_THAT(refusal(s, level(s)),
              HasSubstr("= 1 (the pool reaches the end of the known ground, first at x = 2.5"));
  s.terrain.nodata = TerrainEdge::wall;
  EXPECT_EQ(refusal(s, level(s)), "");
}

TEST(PoolChecks, BothEndsOfAnUncertainLevelAreLookedAt) {
  EXPECT_EQ(find_key("fluid.pool.surface_m")->kind, ValueKind::uncertain);
  Scenario s = tank();
  s.domain.walls.clear();
  const SceneInputs in = inputs_of(s, [](double x, double) { return 0.7 * (x - 1) * (x - 1); });
  Uncertain level_m(0.8);
  Distribution& d = level_m.distribution.emplace();
  d.kind = Distribution::Kind::uniform;
  d.min = 0.6, d.max = 1.2;
  s.fluid->pool->surface_m = level_m;
  EXPECT_EQ(refusal(s, in), "");
  s.fluid->pool->surface_m->distribution->min = -0.5;
  EXPECT_THAT(refusal(s, in), HasSubstr("= -0.5 (the ground there"));
  s.fluid->pool->surface_m->distribution->min = 0.6;
  s.fluid->pool->surface_m->distribution->max = 2;
  EXPECT_THAT(refusal(s, in), HasSubstr("= 2 (the pool reaches the end of the known ground"));
}

}  // namespace
}  // namespace sturz
