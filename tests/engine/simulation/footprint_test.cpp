// SPDX-License-Identifier: Apache-2.0
/// The ground that a mass covers: a mass that never moved covers what its release covered.
#include "engine/effects/fields.hpp"
#include "engine/particles/column_area.hpp"
#include "engine/simulation/peak_maps.hpp"
#include "engine/simulation/simulation.hpp"
#include "io/site/polygon_cover.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace sturz {
namespace {

/// A box of 35 x 35 m, 3 m thick, that friction holds on a gentle slope.
Scenario held(double spacing_m, double cell_m) {
  Scenario s = block_on_plane(4);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->cell_size_m = cell_m;
  s.terrain.synthetic->parameters["slope_deg"] = 15;
  s.terrain.synthetic->parameters["width_m"] = 120;
  s.release.box = ReleaseBox{{-20, 15}, {-17, 18}};
  s.release.thickness_m = Uncertain(3);
  s.numerics.spacing_m = spacing_m;
  s.numerics.end_time_s = 0.05;  // its upright sides sink in a second
  return s;
}

MemberResult run(const Scenario& s) { return assemble(s, load_scene_inputs(s), 0, 1).run(); }

/// Area [m2] that flow covered at once, from the map.
double area_at_start(const MemberResult& r) {
  const auto& arrival = r.layer(PeakLayer::arrival);
  return std::count(arrival.begin(), arrival.end(), 0.0F) * r.grid.cell_m * r.grid.cell_m;
}

/// What unmoved columns cover at once, ever and at the end, over what their source covers, less
/// one.
std::array<double, 3> errors(const MemberResult& r, double source_m2) {
  EXPECT_LT(r.scalars.front_travel_m, 0.01);
  return {area_at_start(r) / source_m2 - 1, r.scalars.reached_area_m2 / source_m2 - 1,
          r.scalars.deposit_area_m2 / source_m2 - 1};
}

TEST(Footprint, OfColumnsThatNeverMovedIsThatOfTheirRelease) {
  for (const double spacing : {4.0, 2.0, 1.0})
    for (const double cell : {1.0, 2.5})
      for (const double error : errors(run(held(spacing, cell)), 1225)) {
        EXPECT_LE(error, 0.05) << spacing << " " << cell;
        EXPECT_GE(error, -0.02) << spacing << " " << cell;
      }
}

/// A sheet of one metre that friction holds for good, on cells that need not be its own.
Scenario sheet(double spacing_m, double cell_m) {
  Scenario s = held(spacing_m, cell_m);
  s.terrain.synthetic->parameters["slope_deg"] = 5;
  s.terrain.synthetic->parameters["width_m"] = 240;
  s.terrain.synthetic->parameters["length_m"] = 240;
  s.release.thickness_m = Uncertain(1);
  s.numerics.end_time_s = 3;
  s.numerics.stop_at_rest = false;
  return s;
}

TEST(Footprint, OfThirtySixCellsIsThirtySixCells) {
  for (const double spacing : {2.0, 3.0, 4.0, 5.0, 6.5, 8.0, 10.0}) {
    Scenario s = sheet(spacing, 10);
    s.release.box = ReleaseBox{{-30, 30}, {-30, 30}};
    for (const double error : errors(run(s), 3600)) EXPECT_NEAR(error, 0, 1e-9) << spacing;
  }
}

/// Mean and largest error over places of a source between cells.
struct Spread {
  double sum = 0, largest = 0;
  int n = 0;
  void add(const std::array<double, 3>& errors) {
    for (const double e : errors) sum += e, largest = std::max(largest, std::abs(e)), ++n;
  }
};
const Vec2 places[] = {{0.3, -0.7}, {1.1, 0.4}, {-1.9, 2.2}, {3.6, 1.3}, {-4.3, -2.9}};

/// Of 3,600 m2 on cells of 2 m: twelve columns across resolve it, eight less so.
double allowed(double spacing_m) { return spacing_m > 5 ? 0.08 : 0.05; }

TEST(Footprint, OfASquareAnywhereBetweenCellsIsItsArea) {
  for (const double spacing : {2.0, 5.0, 8.0}) {
    Spread found;
    for (const Vec2& c : places) {
      Scenario s = sheet(spacing, 2);
      s.release.box = ReleaseBox{{c.x() - 30, c.x() + 30}, {c.y() - 30, c.y() + 30}};
      found.add(errors(run(s), 3600));
    }
    EXPECT_NEAR(found.sum / found.n, 0, 0.02) << spacing;
    EXPECT_LT(found.largest, allowed(spacing)) << spacing;
  }
}

TEST(Footprint, OfADiscIsItsArea) {
  for (const double spacing : {2.0, 5.0, 8.0}) {
    Spread found;
    for (const Vec2& c : places) {
      Scenario s = sheet(spacing, 2);
      s.release.box.reset();
      s.release.cylinder = ReleaseCylinder{{c.x(), c.y()}, 33};
      found.add(errors(run(s), std::numbers::pi * 33 * 33));
    }
    EXPECT_NEAR(found.sum / found.n, 0, 0.02) << spacing;
    EXPECT_LT(found.largest, allowed(spacing)) << spacing;
  }
}

TEST(Footprint, OfARoundReleaseOfManyColumnsTakesLittleOff) {
  Scenario s = held(1.25, 2);
  s.release.box.reset();
  s.release.cylinder = ReleaseCylinder{{0, 0}, 25};
  for (const double error : errors(run(s), std::numbers::pi * 25 * 25)) {
    EXPECT_GE(error, -0.02);
    EXPECT_LE(error, 0.05);
  }
}

TEST(Footprint, OfATurnedRectangleIsItsArea) {
  for (const double spacing : {2.0, 5.0, 8.0}) {
    Spread found;
    for (const double angle : {0.2, 0.5, 0.79, 1.2, 1.4}) {
      const Scenario s = sheet(spacing, 2);
      SceneInputs in = load_scene_inputs(s);
      const Vec2 along = 45 * Vec2(std::cos(angle), std::sin(angle));
      const Vec2 across = 20 * Vec2(-std::sin(angle), std::cos(angle));
      const Vec2 ring[] = {along + across, across - along, -along - across, along - across};
      PolygonCover cover(in.terrain_grid());
      cover.add_ring(ring, 1);
      in.release = in.release_cover = std::make_shared<const Raster<double>>(cover.finish());
      found.add(errors(assemble(s, in, 0, 1).run(), 3600));
    }
    EXPECT_NEAR(found.sum / found.n, 0, 0.02) << spacing;
    EXPECT_LT(found.largest, allowed(spacing)) << spacing;
  }
}

TEST(Footprint, OfAStretchedSheetOfScatteredColumnsIsItsArea) {
  // Columns that lie three times as far apart as they were released, and not in a lattice.
  for (const double cell : {1.0, 2.0, 5.0}) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-0.3, 0.3);
    constexpr double distance = 3;
    MovingSet p;
    p.spacing = 1, p.bulk_density = 1;
    p.grow(std::size_t{40} * 25);
    auto& radius = p.add(fields::support_radius).component[0];
    p.add(fields::area_share);
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.x[i] = 100.7 + distance * (double(i % 40) + 0.5 + unit(random));
      p.y[i] = 100.4 + distance * (double(i / 40) + 0.5 + unit(random));
      p.mass[i] = 2, radius[i] = radius_per_distance * distance;
    }
    PeakMaps maps({Grid{int(400 / cell), int(400 / cell), 0, 400, cell, ""}});
    maps.record({&p, 1}, 0);
    MemberResult r;
    maps.finish({&p, 1}, r);
    EXPECT_NEAR(r.scalars.deposit_area_m2 / (120 * 75), 1, 0.03) << cell;
    EXPECT_EQ(r.scalars.reached_area_m2, r.scalars.deposit_area_m2);
  }
}

TEST(Footprint, OfParticlesThatHardlyMovedToo) {
  Scenario s = held(0.75, 1);
  s.formulation = Formulation::full_stress;
  s.numerics.end_time_s = 1;
  const MemberResult r = run(s);
  // Its upright sides of 3 m slump, at the most to the friction inside (mu_s 0.38): then the same
  // mass reaches 3/(2 * 0.38) m farther on each side.
  EXPECT_GE(r.scalars.deposit_area_m2, 0.98 * 1225);
  EXPECT_LE(r.scalars.deposit_area_m2, std::pow(35 + 3 / 0.38, 2));
}

TEST(Footprint, KeepsItsVolumeInTheDepositLayer) {
  const MemberResult r = run(held(4, 2.5));
  double volume = 0;
  for (float h : r.layer(PeakLayer::deposit)) volume += h * 2.5 * 2.5;
  EXPECT_NEAR(volume, 3 * 1225, 1e-3 * volume);
}

TEST(Footprint, HasNoHolesInASheetThatSpreads) {
  // A disc that flows down an even slope and out: what it reaches is one piece without holes.
  Scenario s = block_on_plane(0.3);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->parameters["width_m"] = 200;
  s.terrain.synthetic->parameters["length_m"] = 400;
  s.release.box.reset();
  s.release.cylinder = ReleaseCylinder{{-150, 0}, 20};
  s.numerics.spacing_m = 2;
  s.numerics.end_time_s = 8;
  const MemberResult r = run(s);
  const auto& arrival = r.layer(PeakLayer::arrival);
  std::size_t reached = 0, holes = 0;
  for (int row = 0; row < r.window.n_rows; ++row) {
    int first = -1, last = -1, n = 0;
    for (int col = 0; col < r.window.n_cols; ++col)
      if (!std::isnan(arrival[std::size_t(row) * r.window.n_cols + col])) {
        if (first < 0) first = col;
        last = col, ++n;
      }
    if (first < 0) continue;
    reached += n, holes += last - first + 1 - n;
  }
  ASSERT_GT(reached, 3000u);
  EXPECT_LT(static_cast<double>(holes), 0.01 * static_cast<double>(reached));
}

}  // namespace
}  // namespace sturz
