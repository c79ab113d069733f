// SPDX-License-Identifier: Apache-2.0
/// What a whole run tells about its course: history, states, frames, where the time went.
#include "engine/effects/effect_names.hpp"
#include "engine/simulation/simulation.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// A few hundred grains that go over a cliff: the front separates in the air.
Scenario over_the_cliff() {
  Scenario s = cliff(2);
  s.numerics.end_time_s = 3;
  s.numerics.stop_at_rest = false;
  return s;
}

Scenario with_states(Scenario s) {
  s.grains->states.emplace();
  s.grains->states->dilute.emplace();
  s.grains->states->ultradilute.emplace();
  return s;
}

MemberResult run(const Scenario& s, const RunControl& control = {}) {
  return assemble(s, load_scene_inputs(s), 0, 1).run(control);
}

TEST(SimulationHistory, FollowsTheMassFromStartToEnd) {
  const MemberResult r = run(over_the_cliff());
  const auto& rows = r.history.rows;
  ASSERT_GT(rows.size(), 20U);
  EXPECT_LE(rows.size(), HistoryRecorder::most_rows);
  EXPECT_EQ(rows.front().time_s, 0);
  EXPECT_EQ(rows.front().front_travel_m, 0);
  EXPECT_FLOAT_EQ(rows.back().time_s, static_cast<float>(r.scalars.end_time_s));
  EXPECT_FLOAT_EQ(rows.back().com_travel_m, static_cast<float>(r.scalars.com_travel_m));
  float front = 0, mean_speed = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HistoryRow& row = rows[i];
    if (i > 0) {
      EXPECT_GT(row.time_s, rows[i - 1].time_s);
    }
    EXPECT_GE(row.front_travel_m, row.com_travel_m);
    EXPECT_LE(row.tail_travel_m, row.front_travel_m);
    EXPECT_LE(row.mean_speed_m_s, row.max_speed_m_s * (1 + 1e-6F));
    EXPECT_LE(std::max(row.front_speed_m_s, row.tail_speed_m_s), row.max_speed_m_s * (1 + 1e-6F));
    EXPECT_EQ(row.dense + row.transition + row.dilute + row.ultradilute, 0);
    front = std::max(front, row.front_travel_m);
    mean_speed = std::max(mean_speed, row.mean_speed_m_s);
  }
  EXPECT_NEAR(front, r.scalars.front_travel_m, 1e-5 * front);
  EXPECT_NEAR(mean_speed, r.scalars.max_mean_speed_m_s, 0.01 * mean_speed);
  EXPECT_FALSE(r.history.has_states || r.history.has_temperature);
}

TEST(SimulationHistory, ADenseSceneTellsHowMuchOfItParted) {
  const MemberScalars s = run(over_the_cliff()).scalars;
  EXPECT_GT(s.parted_fraction, 0.01);
  EXPECT_LT(s.parted_fraction, 0.9);
  EXPECT_EQ(s.dilute_fraction + s.ultradilute_fraction + s.transition_fraction, 0);
  EXPECT_EQ(s.max_granular_temperature_m2_s2, 0);
  EXPECT_EQ(s.granular_ratio, 0);
}

TEST(SimulationHistory, StatesSumToOneAndAgreeWithTheScalars) {
  const MemberResult r = run(with_states(over_the_cliff()));
  ASSERT_TRUE(r.history.has_states && r.history.has_temperature);
  double dilute = 0, largest_temperature = 0;
  const auto& rows = r.history.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HistoryRow& row = rows[i];
    EXPECT_NEAR(row.dense + row.transition + row.dilute + row.ultradilute, 1, 1e-6);
    EXPECT_LE(row.mean_granular_temperature_m2_s2, row.max_granular_temperature_m2_s2);
    if (i > 0) dilute += row.dilute * (row.time_s - rows[i - 1].time_s);
    largest_temperature = std::max<double>(largest_temperature, row.max_granular_temperature_m2_s2);
  }
  const MemberScalars& s = r.scalars;
  EXPECT_GT(s.dilute_fraction, 0);
  EXPECT_NEAR(dilute / s.end_time_s, s.dilute_fraction, 0.02 * s.dilute_fraction + 1e-4);
  EXPECT_GT(s.transition_fraction, 0);
  EXPECT_GE(s.max_granular_temperature_m2_s2, largest_temperature * (1 - 1e-6));
  EXPECT_GT(largest_temperature, 0);
  EXPECT_NEAR(s.granular_ratio * s.max_speed_m_s * s.max_speed_m_s,
              s.max_granular_temperature_m2_s2, 1e-9 * s.max_granular_temperature_m2_s2);
}

TEST(SimulationHistory, ColumnsHaveAHistoryButHaveNoStates) {
  Scenario s = over_the_cliff();
  s.formulation = Formulation::depth_averaged;
  const MemberResult r = run(s);
  EXPECT_TRUE(std::isnan(r.scalars.parted_fraction));
  EXPECT_EQ(r.scalars.dilute_fraction, 0);
  EXPECT_GT(r.history.rows.size(), 5U);
  EXPECT_GT(r.history.rows.back().front_travel_m, 1);
}

TEST(SimulationHistory, EndsWithTheLastOfTheMass) {
  Scenario s = block_on_plane(0.1);
  s.terrain.synthetic->parameters["length_m"] = 60;
  s.release.box = ReleaseBox{{20, 26}, {-3, 3}};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 30;
  const MemberResult r = run(s);
  ASSERT_EQ(r.outcome, Outcome::left_terrain);
  EXPECT_GT(r.history.rows.back().front_travel_m, 5) << "no particle is left to measure";
}

TEST(SimulationHistory, FramesShowStatesWhereThereAreStates) {
  RunControl control;
  control.frame_every_s = 1;
  std::size_t wrong = 0, seen = 0;
  double loosest = 1;
  control.on_frame = [&](const ParticleFrame& f) {
    ++seen;
    wrong += f.solid_fraction.size() != f.x.size() || f.state.size() != f.x.size() ||
             f.granular_temperature.size() != f.x.size();
    for (std::size_t i = 0; i < f.solid_fraction.size(); ++i) {
      loosest = std::min(loosest, f.solid_fraction[i]);
      wrong += std::abs(f.solid_fraction[i] * 2600 - f.density[i]) > 1e-9 * f.density[i];
      wrong += f.state[i] == 2 && !(f.solid_fraction[i] < 0.5 && f.solid_fraction[i] >= 0.02);
    }
  };
  run(with_states(over_the_cliff()), control);
  EXPECT_GE(seen, 4U);
  EXPECT_EQ(wrong, 0U);
  EXPECT_LT(loosest, 0.5);
}

TEST(SimulationHistory, FramesOfADenseSceneHaveNoStates) {
  RunControl control;
  control.frame_every_s = 10;
  control.on_frame = [&](const ParticleFrame& f) {
    EXPECT_EQ(f.solid_fraction.size(), f.x.size());
    EXPECT_TRUE(f.state.empty());
    EXPECT_TRUE(f.granular_temperature.empty());
  };
  Scenario s = over_the_cliff();
  s.numerics.end_time_s = 0.2;
  run(s, control);
}

TEST(SimulationHistory, TheComputingTimeIsSharedOutCompletely) {
  const MemberResult r = run(over_the_cliff());
  double sum = 0;
  for (const auto& [name, seconds] : r.pass_seconds) {
    EXPECT_GE(seconds, 0) << name;
    sum += seconds;
  }
  EXPECT_NEAR(sum, r.scalars.wall_s, 1e-6);
  EXPECT_EQ(r.pass_seconds.back().first, "peak maps, history, limits");
}

const double* seconds_of(const NamedSeconds& times, std::string_view name) {
  for (const auto& [each, seconds] : times)
    if (each == name) return &seconds;
  return nullptr;
}

/// Adds up, and every effect is one that `describe` says is on.
void expect_effects_of(const Scenario& s, const MemberResult& r) {
  double sum = 0;
  const auto effects = describe(s, load_scene_inputs(s)).effects;
  for (const auto& effect : r.effect_seconds) {
    const auto& name = effect.first;
    EXPECT_GE(effect.second, 0) << name;
    sum += effect.second;
    if (name == EffectName::bookkeeping) continue;
    const auto note = std::find_if(effects.begin(), effects.end(),
                                   [&](const EffectNote& e) { return e.name == name; });
    ASSERT_NE(note, effects.end()) << name;
    EXPECT_TRUE(note->active) << name;
  }
  EXPECT_NEAR(sum, r.scalars.wall_s, 1e-6);
}

TEST(SimulationHistory, TheComputingTimeIsSharedOutByEffect) {
  const Scenario dense = over_the_cliff(), loose = with_states(over_the_cliff());
  const MemberResult without = run(dense), with = run(loose);
  expect_effects_of(dense, without);
  expect_effects_of(loose, with);
  for (const auto name : {EffectName::states, EffectName::kinetic_theory, EffectName::isolated}) {
    EXPECT_EQ(seconds_of(without.effect_seconds, name), nullptr) << name;
    ASSERT_NE(seconds_of(with.effect_seconds, name), nullptr) << name;
    EXPECT_GT(*seconds_of(with.effect_seconds, name), 0) << name;
  }
  EXPECT_EQ(seconds_of(without.pass_seconds, "pair sweep, dispersed groups"), nullptr);
  const double* dispersed = seconds_of(with.pass_seconds, "pair sweep, dispersed groups");
  ASSERT_NE(dispersed, nullptr);
  EXPECT_GT(*dispersed, 0);
  EXPECT_LT(*dispersed, *seconds_of(with.effect_seconds, EffectName::kinetic_theory));
}

TEST(SimulationHistory, DispersedGroupsTakeNoTimeInADenseMass) {
  // A sheet without edges, at rest.
  Scenario s = with_states(thin_sheet(8));
  s.terrain.synthetic->parameters["slope_deg"] = 0;
  s.numerics.end_time_s = 0.5;
  const MemberResult r = run(s);
  const MemberScalars& m = r.scalars;
  ASSERT_EQ(m.transition_fraction + m.dilute_fraction + m.ultradilute_fraction, 0);
  ASSERT_NE(seconds_of(r.pass_seconds, "pair sweep, dispersed groups"), nullptr);
  EXPECT_EQ(*seconds_of(r.pass_seconds, "pair sweep, dispersed groups"), 0);
  EXPECT_GT(*seconds_of(r.pass_seconds, "pair sweep"), 0);
}

TEST(SimulationHistory, ColumnsSpendTheirTimeOnEffectsOfColumns) {
  Scenario s = similarity_slide(8);
  s.numerics.end_time_s = 0.5;
  const MemberResult r = run(s);
  expect_effects_of(s, r);
  EXPECT_NE(seconds_of(r.effect_seconds, EffectName::column_pressure), nullptr);
  EXPECT_EQ(seconds_of(r.effect_seconds, EffectName::grain_stress), nullptr);
}

TEST(SimulationHistory, LookingDoesNotChangeWhatHappens) {
  // Frames force no look; a run that is watched closely ends in the same bits.
  RunControl control;
  control.frame_every_s = 0;
  control.on_frame = [](const ParticleFrame&) {};
  EXPECT_EQ(run(over_the_cliff(), control).state_hash, run(over_the_cliff()).state_hash);
}

}  // namespace
}  // namespace sturz
