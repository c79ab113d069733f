// SPDX-License-Identifier: Apache-2.0
/// Zones of the bed: which one a point lies in, and that particles and columns feel theirs.
#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"
#include "engine/terrain/zone_map.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sturz {
namespace {

using test::even_ground;
using test::HandMade;

constexpr double g = standard_gravity;

/// Zone by map point on 30 x 30 cells of 1 m around the origin.
ZoneMap zones_of(const std::function<int(double, double)>& zone) {
  auto raster = std::make_shared<Raster<std::uint8_t>>(Grid{30, 30, -15, 15, 1, ""});
  for (int r = 0; r < 30; ++r)
    for (int c = 0; c < 30; ++c)
      raster->at(r, c) =
          static_cast<std::uint8_t>(zone(raster->grid.x_center(c), raster->grid.y_center(r)));
  return {raster};
}

/// Three strips of 10 m, from south to north 0, 1, 2.
ZoneMap strips() {
  return zones_of([](double, double y) { return y < -5 ? 0 : y < 5 ? 1 : 2; });
}

TEST(ZoneMap, IsZoneZeroWithoutARaster) {
  const ZoneMap none;
  EXPECT_FALSE(none.any());
  EXPECT_EQ(none.at(3, 4), 0);
}

TEST(ZoneMap, IsThatOfTheCellAndZeroOutside) {
  auto raster = std::make_shared<Raster<std::uint8_t>>(Grid{3, 2, 100, 50, 10, ""});
  for (int k = 0; k < 6; ++k) raster->values[k] = static_cast<std::uint8_t>(250 + k);
  const ZoneMap map{raster};
  EXPECT_TRUE(map.any());
  EXPECT_EQ(map.at(105, 45), 250);
  EXPECT_EQ(map.at(129.9, 49.9), 252);
  EXPECT_EQ(map.at(105, 35), 253);
  EXPECT_EQ(map.at(100, 31), 253) << "a western edge belongs to its cell";
  EXPECT_EQ(map.at(110, 40), 254) << "and so does a northern one";
  for (const auto& [x, y] : {std::pair(99.9, 45.0), {130.0, 45.0}, {105.0, 50.1}, {105.0, 29.9}})
    EXPECT_EQ(map.at(x, y), 0) << x << " " << y;
}

void advance_to(HandMade& made, double time) {
  while (made.state.time < time - 1e-9)
    made.step.apply(made.state, std::min(time - made.state.time, 2e-3));
}

/// A particle per strip, 6 m/s eastward.
const std::vector<Vec3> one_per_strip{{-10, -10, 0.5}, {-10, 0, 0.5}, {-10, 10, 0.5}};

TEST(ZonesOfTheBed, AParticleFeelsTheFrictionOfItsZone) {
  HandMade made = test::particles_on_zones(even_ground(40), one_per_strip, {6, 0, 0}, {},
                                           {{0.2}, {0.6}, {0.6, 0.5}}, strips());
  advance_to(made, 0.8);
  const ParticleSet& p = made.state.grains();
  // What bounces does not weigh: the contact's first millimetres are the one per cent.
  EXPECT_NEAR(p.vx[0], 6 - 0.2 * g * 0.8, 0.01 * 0.2 * g);
  EXPECT_NEAR(p.vx[1], 6 - 0.6 * g * 0.8, 0.01 * 0.6 * g);
  EXPECT_NEAR(p.vx[2], 6 - 0.3 * g * 0.8, 0.01 * 0.3 * g) << "its pore pressure bears half";
}

TEST(ZonesOfTheBed, AParticleFeelsTheCohesionOfItsZone) {
  HandMade made = test::particles_on_zones(even_ground(40), one_per_strip, {6, 0, 0}, {},
                                           {{0}, {0, 0, 1560 * 2.0}, {0}}, strips());
  advance_to(made, 0.8);
  // A particle of 1 m^3 and 1560 kg on 1 m^2: 2 m/s^2.
  EXPECT_EQ(made.state.grains().vx[0], 6);
  EXPECT_NEAR(made.state.grains().vx[1], 6 - 2 * 0.8, 1e-9);
  EXPECT_EQ(made.state.grains().vx[2], 6);
}

TEST(ZonesOfTheBed, AParticleChangesZonesOnItsWay) {
  const auto rough_east = zones_of([](double x, double) { return x >= 0; });
  HandMade made = test::particles_on_zones(even_ground(40), {{-3, 0, 0.5}}, {6, 0, 0}, {},
                                           {{0.2}, {0.6}}, rough_east);
  advance_to(made, 3);
  // v^2/2 = 18: three metres take 0.2 g each, the rest 0.6 g.
  const double stop = (18 - 3 * 0.2 * g) / (0.6 * g);
  EXPECT_NEAR(made.state.grains().x[0], stop, 0.01 * (3 + stop));
  EXPECT_EQ(made.state.grains().vx[0], 0);
}

/// The ground repeats every 20 m; its western half is rough.
Domain repeating() {
  Domain d;
  d.x = {true, -10, 10, 0};
  return d;
}
const auto rough_west = zones_of([](double x, double) { return x < 0; });

TEST(ZonesOfTheBed, AParticleBeyondThePeriodFeelsTheZoneOfItsImage) {
  HandMade made = test::particles_on_zones(even_ground(40), {{9, 0, 0.5}}, {6, 0, 0}, repeating(),
                                           {{0.2}, {0.6}}, rough_west);
  advance_to(made, 3);
  const double travel = 1 + (18 - 0.2 * g) / (0.6 * g);
  EXPECT_NEAR(made.state.grains().x[0], 9 + travel, 0.01 * travel);
}

DepthAveragedSettings column_bases(const std::vector<double>& friction, ZoneMap zones) {
  DepthAveragedSettings s;
  s.bed.clear();
  for (double mu : friction) s.bed.emplace_back().friction_coefficient = mu;
  s.earth_pressure.assign(friction.size(), {});
  s.zones = std::move(zones);
  return s;
}

TEST(ZonesOfTheBed, AColumnFeelsTheFrictionOfItsZone) {
  HandMade made = test::columns_on(even_ground(40), one_per_strip, 0.5, {6, 0, 0}, {},
                                   column_bases({0.2, 0.6, 0.3}, strips()));
  advance_to(made, 0.8);
  // A column's speed stands in the middle of the last step, 1 ms ago.
  const double t = 0.8 - 0.5 * made.state.previous_dt;
  for (const auto& [i, mu] : {std::pair(0, 0.2), {1, 0.6}, {2, 0.3}})
    EXPECT_NEAR(made.state.grains().vx[i], 6 - mu * g * t, 1e-9) << i;
}

TEST(ZonesOfTheBed, AColumnFeelsTheTurbulenceOfItsZone) {
  DepthAveragedSettings bases = column_bases({0.2, 0.2, 0.2}, strips());
  bases.bed[1].turbulent_coefficient = 2000;
  const double mu = 0.2, u0 = 6;
  HandMade made =
      test::columns_on(even_ground(40), one_per_strip, 0.5, {u0, 0, 0}, {}, std::move(bases));
  advance_to(made, 0.8);
  const double t = 0.8 - 0.5 * made.state.previous_dt;
  const double h = made.state.grains().find(fields::thickness)->component[0][1];  // it lies alone
  const double k = g / (2000 * h), stop = std::sqrt(mu * g / k);
  const double voellmy = stop * std::tan(std::atan(u0 / stop) - k * stop * t);
  EXPECT_NEAR(made.state.grains().vx[0], u0 - mu * g * t, 1e-9);
  // Before the first step the thickness is the 0.5 m that the column was set down with.
  EXPECT_NEAR(made.state.grains().vx[1], voellmy, 2e-3 * k * u0 * u0) << "du/dt = -mu g - k u^2";
  EXPECT_GT(made.state.grains().vx[2] - made.state.grains().vx[1], 0.5);
}

TEST(ZonesOfTheBed, AColumnChangesZonesOnItsWayAndBeyondThePeriod) {
  HandMade made = test::columns_on(even_ground(40), {{9, 0, 0}}, 0.5, {6, 0, 0}, repeating(),
                                   column_bases({0.2, 0.6}, rough_west));
  advance_to(made, 3);
  const double travel = 1 + (18 - 0.2 * g) / (0.6 * g);
  const double wrapped = made.state.grains().x[0] + made.state.grains().wrapped_x[0];
  EXPECT_NEAR(wrapped, 9 + travel, 0.005 * travel);
}

TEST(ZonesOfTheBed, AnEarthPressureOtherThanOneIsFollowed) {
  // Over a bed rougher than the mass K is constant, and not one.
  DepthAveragedSettings rough = column_bases({0.4}, {});
  rough.earth_pressure = {EarthPressure(0.38, 0.4)};
  HandMade made =
      test::columns_on(even_ground(40), test::block({8, 8, 1}), 1, {3, 0, 0}, {}, rough);
  for (int n = 0; n < 10; ++n) made.advance();
  const Field* k = made.state.grains().find(fields::earth_pressure);
  ASSERT_NE(k, nullptr);
  for (double value : k->component[0]) EXPECT_NEAR(value, 1 + 2 * 0.38 * 0.38, 1e-12);
  HandMade plain = test::columns_on(even_ground(40), test::block({8, 8, 1}), 1, {3, 0, 0});
  EXPECT_EQ(plain.state.grains().find(fields::earth_pressure), nullptr);
}

}  // namespace
}  // namespace sturz
