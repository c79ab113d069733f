// SPDX-License-Identifier: Apache-2.0
/// What a plane wall does to the columns beside it: the missing half, its pressure, its impulses.
#include "engine/effects/columns/walls.hpp"
#include "engine/neighbors/column_smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sturz {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The wall x = 0 with its free side in the east.
Wall west_wall(double friction = 0, double remove_at_s = never) {
  return {{0, 0, 0}, {1, 0, 0}, friction, remove_at_s};
}
Wall south_wall() { return {{0, 0, 0}, {0, 1, 0}, 0, never}; }

Domain bounded_by(std::vector<Wall> walls) {
  Domain d;
  d.walls = std::move(walls);
  return d;
}

/// R times the integral of W along a line at distance d R of the centre, by midpoints.
double line_integral(double d) {
  const ColumnSmoothing unit{1};
  const int n = 2000;
  const double step = 1.0 / n;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += 2 * step * unit.value(std::hypot(d, (i + 0.5) * step));
  return sum;
}

TEST(HalfSupport, HalfOfTheSupportLiesBeyondALineThroughItsCentre) {
  const HalfSupport half;
  EXPECT_NEAR(half.beyond(0), 0.5, 1e-5);
}

TEST(HalfSupport, LineIsTheIntegralAlongIt) {
  const HalfSupport half;
  // Straight between 257 values: the error is at most 1/8 (1/256)^2 times a curvature of 40.
  for (double d = 0; d < 1; d += 0.0137) EXPECT_NEAR(half.line(d), line_integral(d), 8e-5) << d;
}

TEST(HalfSupport, BeyondIsTheIntegralOfLine) {
  const HalfSupport half;
  const double step = 1e-3;
  for (double d = 0; d < 1; d += 0.09) {
    double rest = 0;
    for (double at = d + 0.5 * step; at < 1; at += step) rest += step * line_integral(at);
    EXPECT_NEAR(half.beyond(d), rest, 2e-5) << d;
  }
}

TEST(HalfSupport, IsNothingFromTheSupportRadiusOnAndNoMoreBehindTheLine) {
  const HalfSupport half;
  for (const double d : {1.0, 1.5, 1e9}) {
    EXPECT_EQ(half.line(d), 0);
    EXPECT_EQ(half.beyond(d), 0);
  }
  EXPECT_NEAR(half.beyond(0.999), 0, 1e-9);
  EXPECT_EQ(half.line(-0.2), half.line(0));
  EXPECT_EQ(half.beyond(-3), half.beyond(0));
  for (double d = 0; d < 1; d += 0.01) EXPECT_GE(half.beyond(d), half.beyond(d + 0.01));
}

TEST(ColumnWalls, DoubleTheThicknessAtAWallAndFourfoldInACorner) {
  const ColumnWalls walls;
  const Domain wall = bounded_by({west_wall()}), corner = bounded_by({west_wall(), south_wall()});
  EXPECT_NEAR(walls.thickness_factor(wall, 0, {0, 7, 0}, 4), 2, 1e-4);
  EXPECT_NEAR(walls.thickness_factor(corner, 0, {0, 0, 0}, 4), 4, 4e-4);
  EXPECT_NEAR(walls.thickness_factor(corner, 0, {0, 3.99, 0}, 4), 2, 1e-4);
  EXPECT_EQ(walls.thickness_factor(corner, 0, {4, 5, 0}, 4), 1);
  EXPECT_EQ(walls.thickness_factor({}, 0, {0, 0, 0}, 4), 1);
}

TEST(ColumnWalls, KeepALevelLayersThicknessBesideThem) {
  // Half a plane of even columns sums to the share in front; the factor makes it whole.
  const ColumnWalls walls;
  const ColumnSmoothing w{4};
  const double dx = 0.1;
  for (const double d : {0.05, 0.55, 1.25, 3.15}) {
    double sum = 0;
    for (double x = 0.5 * dx; x < d + 4; x += dx)
      for (double y = -4 + 0.5 * dx; y < 4; y += dx) sum += dx * dx * w.value(std::hypot(x - d, y));
    EXPECT_NEAR(sum * walls.thickness_factor(bounded_by({west_wall()}), 0, {d, 0, 0}, 4), 1, 2e-3);
  }
}

TEST(ColumnWalls, ARemovedWallIsNoMore) {
  const ColumnWalls walls;
  const Wall gate = west_wall(0, 3);
  const Domain d = bounded_by({gate, south_wall()});
  EXPECT_NEAR(walls.thickness_factor(d, 2.999, {0, 0, 0}, 4), 4, 4e-4);
  EXPECT_NEAR(walls.thickness_factor(d, 3, {0, 0, 0}, 4), 2, 1e-4);
  // The other wall's pressure is no longer shared with it.
  const ColumnAtWall column{{0, 1, 0}, {0, 0, 1}, 4, 2, 9.81};
  const double before = walls.pressure(d, 2.9, d.walls[1], column).norm();
  const double after = walls.pressure(d, 3.1, d.walls[1], column).norm();
  EXPECT_NEAR(after / before, 2, 1e-4);
}

TEST(ColumnWalls, PressureBalancesALevelLayer) {
  // What the columns in front push towards the wall, summed over the half plane.
  const ColumnWalls walls;
  const ColumnSmoothing w{4};
  const Domain domain = bounded_by({west_wall()});
  const double h = 2, lateral = 9.81, dx = 0.05;
  for (const double d : {0.025, 0.525, 2.025}) {
    double push = 0;
    for (double x = 0.5 * dx; x < d + 4; x += dx)
      for (double y = -4 + 0.5 * dx; y < 4; y += dx)
        push += h * dx * dx * lateral * w.gradient(std::hypot(x - d, y)) * (d - x);
    const ColumnAtWall column{{d, 0, 0}, {0, 0, 1}, 4, h, lateral};
    const Vec3 mirrored = walls.pressure(domain, 0, domain.walls[0], column);
    EXPECT_NEAR(mirrored.x(), -push, 2e-3 * lateral * h / 4) << d;
    EXPECT_GT(mirrored.x(), 0);
    EXPECT_EQ(mirrored.y(), 0);
  }
}

TEST(ColumnWalls, DoNothingBeyondTheSupport) {
  const ColumnWalls walls;
  const Domain domain = bounded_by({west_wall(0.5)});
  const ColumnAtWall column{{4, 0, 0}, {0, 0, 1}, 4, 2, 9.81};
  EXPECT_EQ(walls.pressure(domain, 0, domain.walls[0], column), Vec3(0, 0, 0));
  const auto impulse = walls.impulse(domain.walls[0], column, {-3, 5, 0}, 0, 0.1);
  EXPECT_EQ(impulse.normal, Vec3(0, 0, 0));
  EXPECT_EQ(impulse.friction, Vec3(0, 0, 0));
}

/// A column near a tilted wall, on tilted ground, moving any way in the ground's plane.
struct RandomMeeting {
  Wall wall;
  ColumnAtWall column;
  Vec3 velocity;
  double pressed, drift;

  explicit RandomMeeting(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1, 1);
    wall.normal = Vec3(u(random), u(random), 0.3 * u(random)).normalized();
    wall.point = 10 * Vec3(u(random), u(random), u(random));
    wall.friction_coefficient = 0.5 * (1 + u(random));
    column.ground_normal = Vec3(0.6 * u(random), 0.6 * u(random), 1).normalized();
    Vec3 beside = Vec3(u(random), u(random), u(random));
    beside -= beside.dot(wall.normal) * wall.normal;
    const double d = 0.7 + 0.9 * u(random);  // some start behind the wall
    column.position = wall.point + beside + d * wall.normal;
    velocity = 20 * Vec3(u(random), u(random), u(random));
    velocity -= velocity.dot(column.ground_normal) * column.ground_normal;
    pressed = u(random) > 0 ? 0.3 * (1 + u(random)) : 0;
    drift = 0.05 + 0.04 * u(random);
  }
  /// The part of a velocity in the ground's plane that neither nears nor leaves the wall.
  Vec3 along_wall(const Vec3& v) const {
    const Vec3& g = column.ground_normal;
    const Vec3 direction = (wall.normal - wall.normal.dot(g) * g).normalized();
    return v - v.dot(direction) * direction;
  }
};

TEST(ColumnWalls, ImpulseNeverLetsAColumnCross) {
  const ColumnWalls walls;
  std::mt19937 random(5);
  int stopped = 0;
  for (int k = 0; k < 2000; ++k) {
    const RandomMeeting m(random);
    const auto impulse = walls.impulse(m.wall, m.column, m.velocity, m.pressed, m.drift);
    const Vec3 after = m.velocity + impulse.normal + impulse.friction;
    const Vec3 end = m.column.position + m.drift * after;
    const double d = (end - m.wall.point).dot(m.wall.normal);
    EXPECT_GE(d, -1e-12);
    // It stays in the ground's plane, and is only pushed into the free side.
    EXPECT_NEAR(after.dot(m.column.ground_normal), 0, 1e-12 * (1 + after.norm()));
    EXPECT_GE(impulse.normal.dot(m.wall.normal), 0);
    if (impulse.normal.norm() == 0) continue;
    ++stopped;
    EXPECT_NEAR(d, 0, 1e-12) << "no farther than to the wall";
  }
  EXPECT_GT(stopped, 300);
}

TEST(ColumnWalls, FrictionIsAtMostItsShareOfWhatPresses) {
  const ColumnWalls walls;
  std::mt19937 random(6);
  int sliding = 0, held = 0;
  for (int k = 0; k < 2000; ++k) {
    const RandomMeeting m(random);
    const auto impulse = walls.impulse(m.wall, m.column, m.velocity, m.pressed, m.drift);
    const double most = m.wall.friction_coefficient * (impulse.normal.norm() + m.pressed);
    EXPECT_LE(impulse.friction.norm(), most * (1 + 1e-12));
    // It brakes the sliding and never turns it round.
    const Vec3 before = m.velocity + impulse.normal;
    EXPECT_LE(impulse.friction.dot(before), 1e-12);
    EXPECT_GE((before + impulse.friction).dot(before), -1e-9);
    EXPECT_NEAR(impulse.friction.dot(m.wall.normal), 0, 1e-12 * (1 + impulse.friction.norm()));
    EXPECT_TRUE(most > 0 || impulse.friction.norm() == 0);
    // Less than it could be only where it has stopped the sliding.
    const bool stopped = impulse.friction.norm() < most * (1 - 1e-9);
    EXPECT_TRUE(!stopped || m.along_wall(before + impulse.friction).norm() < 1e-9);
    (stopped ? held : sliding) += most > 0;
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(held, 20);
}

TEST(ColumnWalls, PressureAloneBrakesWhatSlidesAlong) {
  const ColumnWalls walls;
  const ColumnAtWall column{{1, 0, 0}, {0, 0, 1}, 4, 2, 9.81};
  const auto slow = walls.impulse(west_wall(0.5), column, {0, 0.1, 0}, 0.6, 0.01);
  EXPECT_EQ(slow.normal, Vec3(0, 0, 0));
  EXPECT_LT((slow.friction - Vec3(0, -0.1, 0)).norm(), 1e-15) << "stopped, not turned";
  const auto fast = walls.impulse(west_wall(0.5), column, {0, 2, 0}, 0.6, 0.01);
  EXPECT_LT((fast.friction - Vec3(0, -0.3, 0)).norm(), 1e-15);
}

TEST(ColumnWalls, AWallAlongTheGroundHasNoSide) {
  // Its normal is the ground's: nothing that it could stop can move that way.
  const ColumnWalls walls;
  const Wall floor{{0, 0, 0}, {0, 0, 1}, 0.5, never};
  const ColumnAtWall column{{0, 0, -1}, {0, 0, 1}, 4, 2, 9.81};
  const auto impulse = walls.impulse(floor, column, {1, 2, 0}, 0.2, 0.1);
  EXPECT_EQ(impulse.normal, Vec3(0, 0, 0));
  EXPECT_EQ(impulse.friction, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace sturz
