// SPDX-License-Identifier: Apache-2.0
// A slide that meets a dam and a house: held, led aside, parted; what conserves on bare ground does
// so here.
#include "engine/effects/fields.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace sturz::test {
namespace {

/// Down 30 degrees from x = -173 and out on level ground from x = 0 on, with 12 m of head at x
/// = 70.
Scenario slide(double spacing_m = 2.5) {
  Scenario s = ramp_slide(90, spacing_m);
  s.formulation = Formulation::depth_averaged;
  s.numerics.end_time_s = 40;
  return s;
}

DamSpec across(double x, double height) {
  DamSpec dam;
  dam.points_m = {{x, -75}, {x, 75}};
  dam.height_m = Uncertain(height);
  return dam;
}

double share_beyond(const Finished& f, double x) {
  const ParticleSet& p = f.simulation.parts().state.grains();
  double mass = 0, beyond = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    mass += p.mass[i];
    if (p.x[i] > x) beyond += p.mass[i];
  }
  return beyond / mass;
}

TEST(DamInTheWay, HoldsWhatItsHeightHolds) {
  Scenario s = slide();
  const Finished open = run(s);
  s.terrain.dams = {across(60, 4)};
  const Finished low = run(s);
  s.terrain.dams = {across(60, 30)};
  const Finished high = run(s);
  for (const Finished* f : {&open, &low, &high}) expect_conserved(*f);
  fmt::print("share beyond the line: {:.3f} open, {:.3f} behind 4 m, {:.3f} behind 30 m\n",
             share_beyond(open, 70), share_beyond(low, 70), share_beyond(high, 70));
  EXPECT_GT(share_beyond(open, 70), 0.3);
  EXPECT_LT(share_beyond(low, 70), 0.8 * share_beyond(open, 70));
  EXPECT_EQ(share_beyond(high, 60), 0) << "30 m are more than its energy";
}

TEST(DamInTheWay, ADeflectingWallLeadsItAside) {
  Scenario s = slide();
  DamSpec wall;
  wall.points_m = {{20, -30}, {110, 40}};
  wall.height_m = Uncertain(20);
  wall.side_slope = 0.5;
  s.terrain.dams = {wall};
  const Finished f = run(s);
  expect_conserved(f);
  const MeanMotion end = mean_motion(f.simulation.parts().state.grains());
  EXPECT_GT(end.y, 8) << "to the north, along the wall";
}

TEST(DamInTheWay, GivesTheSameBitsOnTwoThreads) {
  Scenario s = slide();
  s.numerics.end_time_s = 8;
  s.terrain.dams = {across(40, 6)};
  const auto hash = [&](int threads) { return run(build(s, threads)).result.state_hash; };
  EXPECT_EQ(hash(1), hash(2));
}

/// A folder with one house, x to x + edge and y to y + edge.
class House {
 public:
  House(double x, double y, double edge) : x_(x), y_(y), edge_(edge) {
    folder_ = std::filesystem::temp_directory_path() / fmt::format("sturz_house_{}", getpid());
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "house.geojson")
        << fmt::format(R"({{"type": "FeatureCollection", "features": [{{"type": "Feature",
  "properties": {{}}, "geometry": {{"type": "Polygon", "coordinates":
  [[[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}], [{0}, {1}]]]}}}}]}})",
                       x, y, x + edge, y + edge);
  }
  ~House() { std::filesystem::remove_all(folder_); }
  House(const House&) = delete;
  House& operator=(const House&) = delete;

  Scenario in_the_way_of(Scenario s, double height) const {
    s.directory = folder_.string();
    s.terrain.buildings.emplace().polygon = "house.geojson";
    s.terrain.buildings->height_m = height;
    return s;
  }
  int columns_inside(const ParticleSet& p) const {
    int n = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      n += p.x[i] > x_ && p.x[i] < x_ + edge_ && p.y[i] > y_ && p.y[i] < y_ + edge_;
    return n;
  }

 private:
  double x_, y_, edge_;
  std::filesystem::path folder_;
};

TEST(HouseInTheWay, IsFlownAround) {
  for (const double spacing : {2.5, 4.0}) {
    const House house(60, -7.5, 15);
    const Scenario bare = slide(spacing);
    const Finished open = run(bare);
    EXPECT_GT(house.columns_inside(open.simulation.parts().state.grains()), 5);
    const Finished f = run(house.in_the_way_of(bare, 20));
    expect_conserved(f);
    const ParticleSet& p = f.simulation.parts().state.grains();
    EXPECT_EQ(house.columns_inside(p), 0) << spacing;
    int north = 0, south = 0, behind = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      north += p.x[i] > 60 && p.x[i] < 75 && p.y[i] > 7.5;
      south += p.x[i] > 60 && p.x[i] < 75 && p.y[i] < -7.5;
      behind += p.x[i] > 75;
    }
    fmt::print("spacing {}: {} columns north, {} south, {} behind the house\n", spacing, north,
               south, behind);
    EXPECT_GT(north, 0);
    EXPECT_GT(south, 0);
    EXPECT_GT(behind, 0) << "the flow goes on";
    // No energy is made: nothing stands higher than the release's own energy head.
    EXPECT_LT(share_beyond(f, 75), share_beyond(open, 75)) << "some of it is held";
  }
}

}  // namespace
}  // namespace sturz::test
