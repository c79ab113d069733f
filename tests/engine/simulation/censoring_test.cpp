// SPDX-License-Identifier: Apache-2.0
/// Whether a member's end was seen, and what is said of one whose end was not.
#include "engine/simulation/end_state.hpp"
#include "engine/simulation/simulation.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace sturz {
namespace {

MemberResult run(const Scenario& s) { return assemble(s, load_scene_inputs(s), 0, 1).run(); }

/// A short slope whose lower end lies `length` metres below its upper one.
Scenario slide_over_the_edge(Formulation formulation) {
  Scenario s = block_on_plane(0.1);
  s.formulation = formulation;
  s.terrain.synthetic->parameters["length_m"] = 60;
  s.release.box = ReleaseBox{{20, 26}, {-3, 3}};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 30;
  return s;
}

double mass_of(const MemberResult& r, PeakLayer layer) {
  const auto& values = r.layer(layer);
  return std::accumulate(values.begin(), values.end(), 0.0) * r.grid.cell_m * r.grid.cell_m;
}

TEST(Censoring, WordsReadBack) {
  for (Censoring c : {Censoring::none, Censoring::left_terrain, Censoring::still_moving,
                      Censoring::left_and_moving}) {
    EXPECT_EQ(censoring_from(to_string(c)), c);
    EXPECT_EQ(censoring_of(has_left(c), is_moving(c)), c);
    EXPECT_EQ(is_censored(c), c != Censoring::none);
  }
  EXPECT_FALSE(censoring_from("gone").has_value());
}

TEST(Censoring, AMemberWhoseMassIsAllGoneHasComeToTheEdge) {
  for (auto formulation : {Formulation::full_stress, Formulation::depth_averaged}) {
    const Scenario s = slide_over_the_edge(formulation);
    const MemberResult r = run(s);
    const MemberScalars& m = r.scalars;
    EXPECT_EQ(r.outcome, Outcome::left_terrain);
    EXPECT_EQ(r.censoring, Censoring::left_terrain);
    EXPECT_NEAR(m.lost_fraction, 1, 1e-12);
    EXPECT_NEAR(mass_of(r, PeakLayer::left), m.released_mass_kg, 1e-6 * m.released_mass_kg);
    // The release's centre lies at x = 23; the last known ground half a cell from the east edge.
    const double edge = r.grid.east_m() - 0.5 * r.grid.cell_m;
    EXPECT_NEAR(m.com_travel_m, edge - 23, 1.5);
    EXPECT_LT(m.drop_m, 1.05 * (edge - 20) * std::tan(std::asin(1.0) / 3) + 8);
    EXPECT_GT(m.drop_m, 0.8 * (edge - 26) * std::tan(std::asin(1.0) / 3));
    EXPECT_NEAR(m.com_drop_m, m.com_travel_m * std::tan(std::asin(1.0) / 3), 3);
    EXPECT_TRUE(std::isnan(m.crown_to_toe_ratio)) << "there is no deposit";
    EXPECT_GT(m.crown_to_toe_length_m, edge - 23) << "it came as far as the edge";
    EXPECT_TRUE(std::isnan(m.deposit_com_x_m));
    // All of it left over the eastern edge.
    for (int row = 0; row < r.window.n_rows; ++row)
      for (int col = 0; col < r.window.n_cols; ++col)
        if (r.layer(PeakLayer::left)[std::size_t(row) * r.window.n_cols + col] > 0) {
          EXPECT_GT(r.grid.x_center(r.window.col0 + col), edge - 3 * r.grid.cell_m);
        }
  }
}

TEST(Censoring, TheEndTimeCensorsWhatStillMoves) {
  Scenario s = slide_over_the_edge(Formulation::depth_averaged);
  s.terrain.synthetic->parameters["length_m"] = 400;
  s.numerics.end_time_s = 2;
  const MemberResult moving = run(s);
  EXPECT_EQ(moving.outcome, Outcome::out_of_time);
  EXPECT_EQ(moving.censoring, Censoring::still_moving);
  EXPECT_TRUE(moving.layer(PeakLayer::left).empty());
  EXPECT_GT(moving.scalars.end_moving_fraction, 0.99);
  EXPECT_GT(moving.scalars.end_energy_fraction, 0.99);
  EXPECT_EQ(moving.scalars.lost_fraction, 0);
}

TEST(Censoring, TheEndTimeDoesNotCensorWhatRests) {
  Scenario s = slide_over_the_edge(Formulation::depth_averaged);
  s.basal.friction_coefficient = 1.2;
  s.numerics.stop_at_rest = false;
  const MemberResult r = run(s);
  EXPECT_EQ(r.scalars.end_time_s, 30);
  EXPECT_EQ(r.outcome, Outcome::settled);
  EXPECT_EQ(r.censoring, Censoring::none);
  EXPECT_TRUE(r.layer(PeakLayer::left).empty());
}

TEST(Censoring, AnyMassThatLeftCensors) {
  Scenario s = slide_over_the_edge(Formulation::depth_averaged);
  s.terrain.synthetic->parameters["length_m"] = 200;
  SceneInputs in = load_scene_inputs(s);
  Simulation simulation = assemble(s, in, 0, 1);
  State& state = simulation.parts().state;
  // One column of many is thrown over the edge.
  state.grains().vx[3] = 150;
  const MemberResult r = simulation.run();
  EXPECT_TRUE(has_left(r.censoring));
  EXPECT_GT(r.scalars.lost_fraction, 0);
}

TEST(Censoring, MassThatSankThroughTheGroundCensorsToo) {
  for (const std::size_t sunk : {1U, 12U}) {
    Scenario s = slide_over_the_edge(Formulation::full_stress);
    s.terrain.synthetic->parameters["length_m"] = 400;
    s.numerics.end_time_s = 0.5;
    SceneInputs in = load_scene_inputs(s);
    Simulation simulation = assemble(s, in, 0, 1);
    MovingSet& grains = simulation.parts().state.grains();
    for (std::size_t i = 0; i < sunk; ++i) grains.z[i] -= 40;
    const MemberResult r = simulation.run();
    EXPECT_GT(r.scalars.lost_mass_kg, 0);
    EXPECT_DOUBLE_EQ(r.scalars.lost_fraction, r.scalars.lost_mass_kg / r.scalars.released_mass_kg);
    EXPECT_TRUE(has_left(r.censoring));
    EXPECT_EQ(r.outcome == Outcome::left_terrain, r.scalars.lost_fraction > 0.01);
    if (r.outcome == Outcome::left_terrain) {
      EXPECT_NE(r.reason.find("some of it through the ground"), std::string::npos);
    }
  }
}

TEST(CrownToToe, IsMeasuredFromTheHighestSourceToTheFarthestDeposit) {
  const Grid grid{20, 10, 0, 100, 10, ""};
  auto z = std::make_shared<Raster<double>>(grid);
  for (int r = 0; r < grid.n_rows; ++r)
    for (int c = 0; c < grid.n_cols; ++c) z->at(r, c) = 100 - 0.5 * grid.x_center(c);
  const Terrain ground(z, NodataRule::outflow);
  ReleaseFacts release;
  release.x_m = 35, release.y_m = 55;
  release.crown_x_m = 15, release.crown_y_m = 55, release.crown_z_m = 97.5;  // 5 m above the bed
  MemberScalars m;
  const std::vector<PeakMaps::Cell> deposit{{4, 8}, {4, 15}, {2, 12}};
  write_crown_to_toe(ground, release, deposit, {}, grid, m);
  EXPECT_DOUBLE_EQ(m.crown_to_toe_length_m, 140);        // 155 - 15
  EXPECT_DOUBLE_EQ(m.crown_to_toe_drop_m, 97.5 - 22.5);  // ground at x = 155
  EXPECT_DOUBLE_EQ(m.crown_to_toe_ratio, 75.0 / 140);
  EXPECT_DOUBLE_EQ(m.deposit_front_m, 120);
  // Mass that left nearer than the toe changes nothing; farther, the toe is not known.
  const std::vector<Vec2> near{{100, 55}}, far{{100, 55}, {195, 55}};
  write_crown_to_toe(ground, release, deposit, near, grid, m);
  EXPECT_DOUBLE_EQ(m.crown_to_toe_length_m, 140);
  EXPECT_DOUBLE_EQ(m.crown_to_toe_ratio, 75.0 / 140);
  write_crown_to_toe(ground, release, deposit, far, grid, m);
  EXPECT_DOUBLE_EQ(m.crown_to_toe_length_m, 180);
  EXPECT_DOUBLE_EQ(m.deposit_front_m, 160);
  EXPECT_TRUE(std::isnan(m.crown_to_toe_drop_m));
  EXPECT_TRUE(std::isnan(m.crown_to_toe_ratio));
  write_crown_to_toe(ground, release, {}, {}, grid, m);
  EXPECT_TRUE(std::isnan(m.crown_to_toe_length_m));
  EXPECT_TRUE(std::isnan(m.deposit_front_m));
}

TEST(Doubts, NameDetachmentAndEnergyBeyondTheirBounds) {
  Ledger ledger;
  ledger.released_mass = 1e6;
  ledger.potential = -1e6 * 9.81 * 100;  // fell by 100 m
  MemberScalars m;
  m.take_off_fraction = 0.009, m.energy_residual = -0.049;
  EXPECT_TRUE(doubts(m, ledger, 5).empty());
  m.take_off_fraction = 0.16, m.energy_residual = -1.1;
  const auto both = doubts(m, ledger, 5);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].rfind("detachment: for 16 % of mass and time", 0), 0U) << both[0];
  EXPECT_EQ(both[1].rfind("energy: -110 % of the released energy", 0), 0U) << both[1];
  ledger.potential = -1e6 * 9.81 * 1e-3;  // a mass that hardly moved: a share of nothing
  EXPECT_EQ(doubts(m, ledger, 5).size(), 1U);
}

TEST(CrownToToe, OfABlockThatHardlyMovesIsThatOfItsSource) {
  Scenario s = block_on_plane(2);  // sticks
  s.formulation = Formulation::depth_averaged;
  s.numerics.spacing_m = 1;
  s.numerics.end_time_s = 30;
  const MemberResult r = run(s);
  ASSERT_EQ(r.censoring, Censoring::none);
  const double slope = std::tan(std::asin(1.0) / 3);
  EXPECT_GT(r.scalars.crown_to_toe_length_m, 0);
  EXPECT_NEAR(r.scalars.crown_to_toe_drop_m,
              slope * r.scalars.crown_to_toe_length_m + s.release.thickness_m->value, 3);
}

}  // namespace
}  // namespace sturz
