// SPDX-License-Identifier: Apache-2.0
/// formulation: discrete: what it asks for, what it refuses, where its grains lie.
#include "engine/core/error.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/assembly/discrete/discrete_plan.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/checks/validate.hpp"
#include "tests/support/formula_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace sturz {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// 40 m x 40 m x 10 m on a slope.
Scenario scene() {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", 2, {}};
  s.release.box = ReleaseBox{{30, 70}, {30, 70}};
  s.release.thickness_m = Uncertain(10);
  s.grains.emplace();
  s.grains->density_kg_m3 = Uncertain(2400);
  s.grains->diameter_m = Uncertain(2);
  s.grains->solid_fraction = Uncertain(0.7);
  s.formulation = Formulation::discrete;
  s.numerics.spacing_m = 4;
  return s;
}

SceneInputs inputs() {
  SceneInputs in;
  const Grid grid{100, 50, 0, 100, 2, ""};
  in.elevation = std::make_shared<const Raster<double>>(
      test::raster_of([](double x, double y) { return 300 - 0.6 * x + 0.1 * y; }, grid));
  Raster<double> pattern(grid, 0.0);
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) {
      const double x = grid.x_center(c), y = grid.y_center(r);
      if (x > 30 && x < 70 && y > 30 && y < 70) pattern.at(r, c) = 1;
    }
  in.release = std::make_shared<const Raster<double>>(pattern);
  in.hazard_grid = grid;
  return in;
}

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

TEST(Discrete, NeedsNoInternalFrictionAndNoBlock) {
  EXPECT_THAT(messages(scene()), IsEmpty());
  Scenario s = scene();
  s.grains->discrete.emplace().rolling_friction = Uncertain(0.2);
  EXPECT_THAT(messages(s), IsEmpty());
}

TEST(Discrete, ItsBlockBelongsToItAlone) {
  Scenario s = scene();
  s.grains->discrete.emplace();
  s.grains->friction_angle_deg = Uncertain(30);
  for (const Formulation other :
       {Formulation::automatic, Formulation::full_stress, Formulation::depth_averaged}) {
    s.formulation = other;
    EXPECT_THAT(messages(s), ElementsAre(HasSubstr("grains.discrete (formulation is " +
                                                   std::string(to_string(other)))));
  }
}

TEST(Discrete, RefusesOnceWhatItsGrainsDoNotKnow) {
  const auto refused = [](auto change, const char* path) {
    Scenario s = scene();
    change(s);
    EXPECT_THAT(messages(s), Contains(HasSubstr(std::string(path) + " (formulation is discrete")))
        << path;
  };
  refused([](Scenario& s) { s.grains->states.emplace(); }, "grains.states");
  refused([](Scenario& s) { s.mixture.emplace(); }, "mixture");
  refused([](Scenario& s) { s.erosion.emplace(); }, "erosion");
  refused([](Scenario& s) { s.inflow.emplace_back(); }, "inflow");
  refused([](Scenario& s) { s.release.start_time_s = Uncertain(1); }, "release.start_time_s");
  refused([](Scenario& s) { s.basal.samosat.emplace(); }, "basal.samosat");
  refused([](Scenario& s) { s.basal.viscosity_pa_s = Uncertain(1); }, "basal.viscosity_pa_s");
  refused([](Scenario& s) { s.basal.turbulent_coefficient_m_s2 = Uncertain(500); },
          "basal.turbulent_coefficient_m_s2");
  refused([](Scenario& s) { s.grains->earth_pressure = LateralPressure::active; },
          "grains.earth_pressure");
}

TEST(Discrete, ValuesOutOfRangeAreRefused) {
  Scenario s = scene();
  s.grains->discrete.emplace().greatest_overlap = 0.5;
  s.grains->discrete->restitution = Uncertain(1.5);
  s.grains->discrete->diameter_m = Uncertain(0);
  EXPECT_THAT(messages(s), Contains(HasSubstr("grains.discrete.greatest_overlap = 0.5")));
  EXPECT_THAT(messages(s), Contains(HasSubstr("grains.discrete.restitution = 1.5")));
  EXPECT_THAT(messages(s), Contains(HasSubstr("grains.discrete.diameter_m = 0")));
}

TEST(Discrete, SaysWhichKeysDoNothing) {
  Scenario s = scene();
  s.grains->friction_angle_deg = Uncertain(24);
  s.grains->cohesion_pa = Uncertain(5000);
  EXPECT_THAT(idle_keys(s, false),
              ElementsAre("grains.friction_angle_deg", "grains.cohesion_pa", "numerics.spacing_m"));
}

TEST(Discrete, AutoNeverTakesIt) {
  Scenario s = scene();
  s.grains->friction_angle_deg = Uncertain(30);
  s.formulation = Formulation::automatic;
  s.numerics.spacing_m = 0.01;
  const Raster<double> slab(Grid{20, 20, 0, 40, 2, ""}, 10.0);
  EXPECT_FALSE(choose_formulation(s, slab).discrete);
  EXPECT_EQ(choose_formulation(scene(), slab).name(), "discrete");
}

TEST(Discrete, ItsSpacingIsThatOfItsGrains) {
  const Scenario s = with_grain_spacing(scene());
  EXPECT_NEAR(std::pow(s.numerics.spacing_m, 3) * 0.7, std::numbers::pi / 6 * 8, 1e-12);
  Scenario columns = scene();
  columns.formulation = Formulation::depth_averaged;
  EXPECT_EQ(with_grain_spacing(columns).numerics.spacing_m, 4);
}

TEST(Discrete, ACoarserTwinHasLargerGrains) {
  Scenario s = scene();
  scale_grains(s, 1.5);
  EXPECT_NEAR(with_grain_spacing(s).numerics.spacing_m,
              1.5 * with_grain_spacing(scene()).numerics.spacing_m, 1e-12);
  s.formulation = Formulation::full_stress;
  scale_grains(s, 2);
  EXPECT_EQ(s.grains->discrete->diameter_m->value, 3);
}

TEST(Discrete, GrainsHoldTheMassLieAboveTheBedAndAreAsManyAsTheVolumeHolds) {
  const SceneInputs in = inputs();
  const Scenario s = with_grain_spacing(scene());
  const ScenePlan plan = plan_scene(s, in, 0);
  const Release& r = plan.release;
  const double volume = 40 * 40 * 10.0, grain = std::numbers::pi / 6 * 8;
  EXPECT_EQ(r.x.size(), static_cast<std::size_t>(std::round(volume * 0.7 / grain)));
  EXPECT_EQ(plan.n_present, r.x.size());
  EXPECT_NEAR(total(r.mass), volume * 0.7 * 2400, 1e-9 * volume * 0.7 * 2400);
  double height = 0, least = 1e9, most = 0;
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    const double above = r.z[i] - plan.bed.height(r.x[i], r.y[i]);
    height += above / static_cast<double>(r.x.size());
    EXPECT_GT(plan.bed.distance({r.x[i], r.y[i], r.z[i]}, 1).distance, 1 - 0.1 * 2 * 1.1);
    least = std::min(least, r.mass[i]), most = std::max(most, r.mass[i]);
  }
  // Set down at 0.6, it stands a sixth higher than ten metres.
  EXPECT_NEAR(height, 0.5 * 10 * 0.7 / 0.6 + 1, 0.6);
  EXPECT_NEAR(std::cbrt(most / least), 1.1 / 0.9, 0.02);
  // Nearest centres: none closer than the lattice less its jitter.
  double nearest = 1e9;
  for (std::size_t i = 0; i < 300; ++i)
    for (std::size_t j = 0; j < r.x.size(); ++j)
      if (i != j)
        nearest = std::min(nearest, Vec3(r.x[i] - r.x[j], r.y[i] - r.y[j], r.z[i] - r.z[j]).norm());
  EXPECT_GT(nearest, 2 * 1.0727 * (1 - 2 * 0.05 * std::sqrt(3.0)) - 1e-3);
}

TEST(Discrete, MembersLieDifferentlyAndTheSameMemberAlike) {
  const SceneInputs in = inputs();
  const Scenario s = with_grain_spacing(scene());
  EXPECT_EQ(plan_scene(s, in, 3).release.x, plan_scene(s, in, 3).release.x);
  EXPECT_NE(plan_scene(s, in, 3).release.x, plan_scene(s, in, 4).release.x);
}

TEST(Discrete, DescribesItsGrainsAndItsStep) {
  const SceneInputs in = inputs();
  const SceneDescription d = describe(scene(), in);
  EXPECT_EQ(d.formulation, "discrete");
  EXPECT_EQ(d.binding_limit, "grain contact");
  EXPECT_EQ(d.n_particles, 2674u);
  EXPECT_GT(d.n_steps, 1000);
  EXPECT_EQ(d.sound_speed_m_s, 0);
  const auto row = std::find_if(d.effects.begin(), d.effects.end(),
                                [](const EffectNote& e) { return e.name == "grain contacts"; });
  ASSERT_NE(row, d.effects.end());
  EXPECT_TRUE(row->active);
  EXPECT_THAT(row->reason, HasSubstr("2674 grains of 2 m"));
  // The softer the grains may be, the longer the step.
  Scenario soft = scene();
  soft.grains->discrete.emplace().greatest_overlap = 0.2;
  EXPECT_GT(describe(soft, in).dt_s, 1.5 * d.dt_s);
}

TEST(Discrete, AreNotInOtherScenes) {
  Scenario s = scene();
  s.formulation = Formulation::full_stress;
  s.grains->friction_angle_deg = Uncertain(30);
  for (const EffectNote& e : describe(s, inputs()).effects)
    if (e.name == "grain contacts") {
      EXPECT_FALSE(e.active);
      EXPECT_THAT(e.fields, IsEmpty());
    }
}

TEST(Discrete, MoreGrainsThanMemoryAreRefusedWithASize) {
  Scenario s = scene();
  s.grains->diameter_m = Uncertain(0.1);
  try {
    describe(s, inputs());
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_THAT(e.what(), HasSubstr("grains.discrete.diameter_m = 0.1 (the release holds"));
  }
}

TEST(Discrete, ASlideRunsAndItsAccountsClose) {
  Scenario s = scene();
  s.numerics.end_time_s = 1.5;
  s.basal.friction_coefficient = 0.3;
  const SceneInputs in = inputs();
  Simulation run = assemble(s, in, 0, 1);
  const MemberResult result = run.run();
  EXPECT_NE(result.outcome, Outcome::diverged) << result.reason;
  EXPECT_LT(std::abs(result.scalars.energy_residual), 0.02);
  EXPECT_NEAR(result.scalars.mass_error, 0, 1e-12);
  // What a wrong force would leave: the residual holds it and cannot see it.
  const Ledger ledger = run.parts().state.ledger();
  EXPECT_GT(ledger.numerical(), -0.02 * ledger.released_energy());
  EXPECT_LT(ledger.numerical(), 0.1 * ledger.released_energy());
}

}  // namespace
}  // namespace sturz
