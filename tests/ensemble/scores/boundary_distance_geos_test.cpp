// SPDX-License-Identifier: Apache-2.0
// The distances of outlines against those of the GEOS library.
#include "ensemble/scores/boundary_distance.hpp"

#include <geos_c.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace sturz {
namespace {

class Geos : public ::testing::Test {
 protected:
  Geos() : context_(GEOS_init_r()) {}
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  Geos(Geos&&) = delete;
  Geos& operator=(Geos&&) = delete;
  ~Geos() override { GEOS_finish_r(context_); }

  struct Closer {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(context, g); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Closer>;

  Geometry ring(const std::vector<Vec2>& points) const {
    GEOSCoordSequence* sequence =
        GEOSCoordSeq_create_r(context_, static_cast<unsigned>(points.size()), 2);
    for (unsigned i = 0; i < points.size(); ++i) {
      GEOSCoordSeq_setX_r(context_, sequence, i, points[i].x());
      GEOSCoordSeq_setY_r(context_, sequence, i, points[i].y());
    }
    // Not a linear ring: GEOS measures the discrete Hausdorff distance to its first point only.
    return {GEOSGeom_createLineString_r(context_, sequence), {context_}};
  }
  Geometry point(const Vec2& p) const {
    return {GEOSGeom_createPointFromXY_r(context_, p.x(), p.y()), {context_}};
  }
  double distance(const Geometry& a, const Geometry& b) const {
    double d = -1;
    EXPECT_EQ(GEOSDistance_r(context_, a.get(), b.get(), &d), 1);
    return d;
  }
  /// Sides are looked at in pieces of this share of their length.
  double hausdorff(const Geometry& a, const Geometry& b, double share) const {
    double d = -1;
    EXPECT_EQ(GEOSHausdorffDistanceDensify_r(context_, a.get(), b.get(), share, &d), 1);
    return d;
  }

 private:
  GEOSContextHandle_t context_;
};

/// A star-shaped ring.
std::vector<Vec2> ragged_ring(std::mt19937& random, const Vec2& centre) {
  std::uniform_real_distribution<double> radius(80, 220);
  std::vector<Vec2> ring;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    ring.emplace_back(centre + radius(random) * Vec2(std::cos(angle), std::sin(angle)));
  }
  ring.push_back(ring.front());
  return ring;
}

TEST_F(Geos, HausdorffDistancesAgree) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto a = ragged_ring(random, {500000, 4600000});
    const auto b = ragged_ring(random, {500000 + 15.0 * trial, 4600000 - 9.0 * trial});
    const BoundaryDistance ours =
        boundary_distance(SegmentIndex(sides_of({a}), 20), SegmentIndex(sides_of({b}), 20), 0.5, 1);
    // Both look at points: ours at most 0.5 m apart and their middles, theirs at most 1.5 m.
    EXPECT_NEAR(ours.hausdorff_m, hausdorff(ring(a), ring(b), 0.005), 1.0) << trial;
    EXPECT_GT(ours.hausdorff_m, 10);
  }
}

TEST_F(Geos, MeanDistancesAgree) {
  std::mt19937 random(5);
  const auto a = ragged_ring(random, {0, 0}), b = ragged_ring(random, {60, 10});
  const SegmentIndex index_a(sides_of({a}), 15), index_b(sides_of({b}), 15);
  const auto one_way = [&](const SegmentIndex& from, const Geometry& to) {
    double sum = 0, length = 0;
    for (const Segment& s : from.segments())
      for (int k = 0; k < 200; ++k) {
        sum += s.length() / 200 * distance(point(s.a + (s.b - s.a) * (k + 0.5) / 200), to);
        length += s.length() / 200;
      }
    return sum / length;
  };
  const double mean = (one_way(index_a, ring(b)) + one_way(index_b, ring(a))) / 2;
  EXPECT_NEAR(boundary_distance(index_a, index_b, 0.5, 1).mean_m, mean, 0.02);
}

TEST_F(Geos, DistancesOfPointsAgree) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(-500, 500);
  const auto a = ragged_ring(random, {0, 0});
  const SegmentIndex index(sides_of({a}), 10);
  for (int i = 0; i < 300; ++i) {
    const Vec2 p(anywhere(random), anywhere(random));
    EXPECT_NEAR(index.distance(p), distance(point(p), ring(a)), 1e-9);
  }
}

}  // namespace
}  // namespace sturz
