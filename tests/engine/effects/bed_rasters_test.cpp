// SPDX-License-Identifier: Apache-2.0
// Numbers of the bed that rasters give: which holds where, and that particles and columns feel
// them.
#include "engine/effects/bed_rasters.hpp"

#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sturz {
namespace {

using test::even_ground;
using test::HandMade;

constexpr double g = standard_gravity;

/// Values by map point on 30 x 30 cells of 1 m around the origin.
BedRasters::Layer layer(BedNumber number, const std::function<double(double, double)>& value,
                        double factor = 1) {
  auto raster = std::make_shared<Raster<double>>(Grid{30, 30, -15, 15, 1, ""});
  for (int r = 0; r < 30; ++r)
    for (int c = 0; c < 30; ++c)
      raster->at(r, c) = value(raster->grid.x_center(c), raster->grid.y_center(r));
  BedRasters::Layer out;
  out.number = number, out.values = raster, out.factor = factor;
  return out;
}
BedRasters rasters_of(std::vector<BedRasters::Layer> layers) {
  BedRasters out;
  out.layers = std::move(layers);
  out.whole = Grid{30, 30, -15, 15, 1, ""};
  return out;
}

TEST(BedRasters, TheZoneGoesBeforeTheRasterAndThatBeforeTheBed) {
  BedRasters rasters = rasters_of(
      {layer(
           BedNumber::friction, [](double x, double) { return x < 0 ? 0.2 : nan_d; }, 1.5),
       layer(BedNumber::turbulence, [](double, double) { return 800; })});
  rasters.given.push_back({true, false, false, false});
  const BasalResistance all{0.4, 0.1, 30};
  const BasalResistance west = rasters.over(all, 0, -3, 2), east = rasters.over(all, 0, 3, 2);
  EXPECT_DOUBLE_EQ(west.friction_coefficient, 0.3);
  EXPECT_EQ(west.turbulent_coefficient, 800);
  EXPECT_EQ(west.pore_pressure_ratio, 0.1);
  EXPECT_EQ(west.cohesion_pa, 30);
  EXPECT_EQ(east.friction_coefficient, 0.4) << "nodata";
  const BasalResistance zone = rasters.over({0.7}, 1, -3, 2);
  EXPECT_EQ(zone.friction_coefficient, 0.7) << "its own";
  EXPECT_EQ(zone.turbulent_coefficient, 800) << "which it does not give";
  EXPECT_EQ(rasters.over(all, 0, -16, 2).friction_coefficient, 0.4) << "beyond the raster";
}

TEST(BedRasters, APartOfTheGridHasTheSameValues) {
  BedRasters part;
  part.whole = Grid{30, 30, -15, 15, 1, ""};
  part.row0 = 4, part.col0 = 6;
  auto values = std::make_shared<Raster<double>>(grid_of({4, 6, 2, 3}, part.whole), nan_d);
  values->at(1, 2) = 0.9;  // row 5, column 8
  BedRasters::Layer only;
  only.values = values;
  part.layers.push_back(only);
  EXPECT_EQ(part.over({0.4}, 0, -6.5, 9.5).friction_coefficient, 0.9);
  EXPECT_EQ(part.over({0.4}, 0, -6.5, 8.5).friction_coefficient, 0.4);
}

void advance_to(HandMade& made, double time) {
  while (made.state.time < time - 1e-9)
    made.step.apply(made.state, std::min(time - made.state.time, 2e-3));
}

/// Alone each, ten metres apart.
const std::vector<Vec3> one_per_strip = {{-3, -10, 0.5}, {-3, 0, 0.5}, {-3, 10, 0.5}};

double by_strip(double y) { return y < -5 ? 0.1 : y < 5 ? 0.2 : 0.3; }

TEST(BedRasters, AColumnFeelsTheFrictionOfItsCellTimesTheFactor) {
  DepthAveragedSettings s;
  s.rasters = rasters_of({layer(
      BedNumber::friction, [](double, double y) { return by_strip(y); }, 2)});
  HandMade made = test::columns_on(even_ground(40), one_per_strip, 0.5, {6, 0, 0}, {}, s);
  advance_to(made, 0.8);
  const double t = 0.8 - 0.5 * made.state.previous_dt;
  for (const auto& [i, mu] : {std::pair(0, 0.2), {1, 0.4}, {2, 0.6}})
    EXPECT_NEAR(made.state.grains().vx[i], 6 - mu * g * t, 1e-9) << i;
}

TEST(BedRasters, AParticleFeelsThemToo) {
  // particles_on_zones lays zones; one zone whose number the raster gives
  HandMade plain =
      test::particles_on_zones(even_ground(40), one_per_strip, {6, 0, 0}, {}, {{0.4}}, {});
  HandMade made = test::particles_on_rasters(
      even_ground(40), one_per_strip, {6, 0, 0}, {{0.4}},
      rasters_of(
          {layer(BedNumber::friction, [](double, double y) { return by_strip(y); }),
           layer(BedNumber::pore_pressure, [](double, double y) { return y > 5 ? 0.5 : 0; })}));
  advance_to(plain, 0.8);
  advance_to(made, 0.8);
  for (const auto& [i, mu] : {std::pair(0, 0.1), {1, 0.2}, {2, 0.15}})
    EXPECT_NEAR(made.state.grains().vx[i], 6 - mu * g * 0.8, 0.01) << i;
  EXPECT_NEAR(plain.state.grains().vx[1], 6 - 0.4 * g * 0.8, 0.01);
}

TEST(BedRasters, OneNumberEverywhereIsThatNumberToTheBit) {
  DepthAveragedSettings plain, rastered;
  plain.bed[0].friction_coefficient = 0.31;
  plain.internal_friction = rastered.internal_friction = 0.6;
  plain.spent_share = rastered.spent_share = 0.8;
  plain.spent_inside = {0.8 * std::max(0.0, 1 - plain.earth_pressure_over(plain.bed[0]).active)};
  rastered.rasters = rasters_of({layer(BedNumber::friction, [](double, double) { return 0.31; })});
  HandMade a =
      test::columns_on(even_ground(40, 0.3), test::block({8, 8, 1}), 1, {1, 0, 0}, {}, plain);
  HandMade b =
      test::columns_on(even_ground(40, 0.3), test::block({8, 8, 1}), 1, {1, 0, 0}, {}, rastered);
  for (int n = 0; n < 40; ++n) a.advance(), b.advance();
  EXPECT_EQ(a.state.grains().x, b.state.grains().x);
  EXPECT_EQ(a.state.grains().vx, b.state.grains().vx);
}

TEST(BedRasters, EarthPressureFollowsTheFrictionOfTheCell) {
  DepthAveragedSettings s;
  s.internal_friction = 0.38, s.active_passive = true;
  s.rasters = rasters_of({layer(BedNumber::friction, [](double, double) { return 0.5; })});
  HandMade made = test::columns_on(even_ground(40), test::block({8, 8, 1}), 1, {3, 0, 0}, {}, s);
  for (int n = 0; n < 10; ++n) made.advance();
  const Field* k = made.state.grains().find(fields::earth_pressure);
  ASSERT_NE(k, nullptr);
  // Over a bed rougher than the mass K is constant.
  for (double value : k->component[0]) EXPECT_NEAR(value, 1 + 2 * 0.38 * 0.38, 1e-12);
}

}  // namespace
}  // namespace sturz
