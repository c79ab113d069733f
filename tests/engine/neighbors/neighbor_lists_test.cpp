// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/neighbor_lists.hpp"

#include "engine/core/vec.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

namespace sturz {
namespace {

constexpr double support = 2.6, skin = 0.195, search_radius = support + skin;

NeighborLists make_lists() { return {support, skin, sweeps(best_instruction_set()).tight_list}; }

ParticleSet set_of(const std::vector<Vec3>& points) {
  ParticleSet set;
  set.grow(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    set.x[i] = points[i].x(), set.y[i] = points[i].y(), set.z[i] = points[i].z();
  return set;
}

Vec3 place(const ParticleSet& set, std::size_t i) { return {set.x[i], set.y[i], set.z[i]}; }

/// Every copy of every particle, the particles themselves first.
struct Copy {
  std::size_t source;
  Vec3 shift;
};
std::vector<Copy> copies(const ParticleSet& set, const Domain& d) {
  std::vector<Copy> out;
  for (std::size_t i = 0; i < set.size(); ++i) out.push_back({i, {0, 0, 0}});
  const int mx = d.x.active ? 1 : 0, my = d.y.active ? 1 : 0;
  for (std::size_t i = 0; i < set.size(); ++i)
    for (int a = -mx; a <= mx; ++a)
      for (int b = -my; b <= my; ++b)
        if (a != 0 || b != 0)
          out.push_back({i,
                         {a * (mx ? d.x.length() : 0), b * (my ? d.y.length() : 0),
                          a * d.x.rise + b * d.y.rise}});
  return out;
}

/// A list's entry where it is now: from the fixed-point offset to a particle that is known.
Vec3 entry_place(const NeighborLists& lists, const ParticleSet& set, std::size_t anchor,
                 std::uint32_t entry) {
  const NeighborView view = lists.view();
  const NeighborRecord &a = view.records[anchor], &b = view.records[entry];
  const Vec3 units(double(b.x) - a.x, double(b.y) - a.y, double(b.z) - a.z);
  return place(set, anchor) + units * view.unit_m;
}

/// All pairs closer than `range` must be listed, each once; nothing else than neighbours may be.
void expect_complete(const NeighborLists& lists, const ParticleSet& set, const Domain& domain,
                     double range, double allowed) {
  const NeighborView view = lists.view();
  const auto all = copies(set, domain);
  std::size_t missing = 0, strangers = 0;
  for (std::size_t g = 0; g < lists.n_groups(); ++g) {
    const std::size_t first = g * group_size, last = std::min(set.size(), first + group_size);
    const std::vector<std::uint32_t> list(view.list(g), view.list(g) + view.list_size(g));
    ASSERT_EQ(std::set<std::uint32_t>(list.begin(), list.end()).size(), list.size())
        << "an entry is listed twice";
    const auto gap = [&](const Vec3& p) {
      double least = 1e300;
      for (std::size_t i = first; i < last; ++i)
        least = std::min(least, (place(set, i) - p).norm());
      return least;
    };
    std::vector<Vec3> images;
    for (std::uint32_t entry : list) {
      const Vec3 at = entry_place(lists, set, first, entry);
      strangers += gap(at) > allowed + 1e-5;
      if (entry >= lists.padded_size()) images.push_back(at);
    }
    for (const Copy& c : all) {
      const Vec3 at = place(set, c.source) + c.shift;
      if (gap(at) >= range - 1e-5) continue;
      if (c.shift.isZero(0)) {
        missing += std::count(list.begin(), list.end(), c.source) != 1;
        continue;
      }
      const auto here = [&](const Vec3& p) { return (p - at).norm() < 1e-4; };
      const auto listed = std::count_if(images.begin(), images.end(), here);
      const auto expected = std::count_if(all.begin() + set.size(), all.end(), [&](const Copy& o) {
        return here(place(set, o.source) + o.shift);
      });
      missing += listed != expected;
    }
  }
  EXPECT_EQ(missing, 0u);
  EXPECT_EQ(strangers, 0u);
}

void build_and_check(const std::vector<Vec3>& points, const Domain& domain = {}) {
  ParticleSet set = set_of(points);
  NeighborLists lists = make_lists();
  lists.rebuild(set, domain, 1);
  ASSERT_EQ(lists.n_groups(), (points.size() + group_size - 1) / group_size);
  expect_complete(lists, set, domain, search_radius, search_radius);
}

std::vector<Vec3> box(std::size_t n, const Vec3& from, const Vec3& to, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 s(u(random), u(random), u(random));
    points.emplace_back(from + s.cwiseProduct(to - from));
  }
  return points;
}

TEST(NeighborLists, HoldEveryPairOfRandomClouds) {
  build_and_check(box(300, {0, 0, 0}, {12, 9, 7}));
  build_and_check(box(333, {-5, -5, -5}, {5, 5, 5}));
  build_and_check(box(200, {0, 0, 0}, {2, 2, 60}));  // a tower in one column
  build_and_check(box(200, {0, 0, 0}, {90, 2, 2}));
}

TEST(NeighborLists, HoldEveryPairOfThinSheets) {
  build_and_check(box(400, {0, 0, 0}, {30, 30, 0}));
  auto slope = box(400, {0, 0, 0}, {40, 20, 0});
  for (Vec3& p : slope) p.z() = -1.7 * p.x();
  build_and_check(slope);
}

TEST(NeighborLists, HoldEveryPairOfFewParticles) {
  for (std::size_t n : {1, 2, 15, 16, 17, 33}) build_and_check(box(n, {0, 0, 0}, {4, 4, 4}));
  build_and_check({{0, 0, 0}, {0, 0, 0}, {2.7, 0, 0}, {0, 2.8, 0}});
}

TEST(NeighborLists, HoldParticlesInOnePlace) {
  auto points = box(40, {0, 0, 0}, {5, 5, 5});
  points.insert(points.end(), 37, Vec3(2, 2, 2));
  build_and_check(points);
}

TEST(NeighborLists, StandOutliersFarAway) {
  auto points = box(300, {412000, 5123000, 900}, {412012, 5123009, 907});
  points.emplace_back(412000 + 3e4, 5123000, 900);
  points.emplace_back(412000 + 3e4, 5123001, 900);
  points.emplace_back(412000, 5123000 - 2e4, 4000);
  build_and_check(points);
}

TEST(NeighborLists, HoldPeriodicImages) {
  Domain x;
  x.x = {true, 3, 15, 0};
  build_and_check(box(300, {3, 0, 0}, {14.999, 9, 7}), x);
  Domain xy = x;
  xy.y = {true, -2, 7, 1.25};
  xy.x.rise = -4;
  build_and_check(box(300, {3, -2, 0}, {14.999, 6.999, 7}), xy);
  // So narrow that a particle meets both its images at once.
  Domain slice;
  slice.y = {true, 0, 4, 0};
  build_and_check(box(200, {0, 0, 0}, {9, 3.999, 9}), slice);
}

TEST(NeighborLists, BringParticlesBackIntoThePeriod) {
  Domain domain;
  domain.x = {true, 0, 10, -3};
  ParticleSet set = set_of({{10.5, 1, 5}, {-0.25, 1, 5}, {31, 1, 5}});
  NeighborLists lists = make_lists();
  lists.rebuild(set, domain, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(set.x[i], 0);
    EXPECT_LT(set.x[i], 10);
    const double turns[] = {1, -1, 3};
    EXPECT_NEAR(set.z[i], 5 + 3 * turns[set.id[i]], 1e-12);
  }
}

TEST(NeighborLists, LongPeriodsDoNotAlias) {
  // A period of 2^32 position units: an image must not land on its own particle.
  Domain domain;
  domain.x = {true, 0, 2048 * support, 0};
  ParticleSet set = set_of({{0.5, 0, 0}, {1.5, 0, 0}, {2.5, 1, 0}});
  NeighborLists lists = make_lists();
  lists.rebuild(set, domain, 1);
  expect_complete(lists, set, domain, search_radius, search_radius);
  EXPECT_EQ(lists.n_entries(), 3u);
}

TEST(NeighborLists, OrderDoesNotDependOnStorageOrThreads) {
  auto points = box(700, {0, 0, 0}, {15, 12, 8});
  points[50] = points[51] = points[400];
  Domain domain;
  domain.x = {true, 0, 15, 0.5};
  ParticleSet one = set_of(points), two = set_of(points);
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::shuffle(order.begin(), order.end(), std::mt19937(9));
  two.permute(order);
  NeighborLists a = make_lists(), b = make_lists();
  a.rebuild(one, domain, 1);
  b.rebuild(two, domain, 2);
  EXPECT_EQ(one.id, two.id);
  ASSERT_EQ(a.n_entries(), b.n_entries());
  const NeighborView va = a.view(), vb = b.view();
  for (std::size_t g = 0; g < a.n_groups(); ++g) {
    ASSERT_EQ(va.list_size(g), vb.list_size(g));
    EXPECT_TRUE(std::equal(va.list(g), va.list(g) + va.list_size(g), vb.list(g)));
  }
}

TEST(NeighborLists, MissNoNeighbourAfterMovesWithinTheSkin) {
  Domain domain;
  domain.y = {true, 0, 9, -0.8};
  ParticleSet set = set_of(box(300, {0, 0, 0}, {12, 8.999, 7}));
  NeighborLists lists = make_lists();
  lists.rebuild(set, domain, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int move = 0; move < 3; ++move) {
    ParticleSet moved = set;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Vec3 step = 0.499 * skin * Vec3(u(random), u(random), u(random)).normalized();
      // A common motion of any size on top: only relative motion wears the skin.
      moved.x[i] += step.x() + 5.0 * move;
      moved.y[i] += step.y() + 1.0 * move;
      moved.z[i] += step.z();
    }
    lists.gather_positions(moved, 0, moved.size());
    lists.copy_images();
    expect_complete(lists, moved, domain, support, search_radius + skin);
  }
}

TEST(NeighborLists, AskForARebuildOnceTheSkinIsWorn) {
  ParticleSet set = set_of(box(20, {0, 0, 0}, {4, 4, 4}));
  NeighborLists lists = make_lists();
  EXPECT_TRUE(lists.needs_rebuild());
  lists.rebuild(set, {}, 1);
  EXPECT_FALSE(lists.needs_rebuild());
  lists.add_relative_motion(0.6 * skin);
  EXPECT_FALSE(lists.needs_rebuild());
  lists.add_relative_motion(0.5 * skin);
  EXPECT_TRUE(lists.needs_rebuild());
  lists.rebuild(set, {}, 1);
  EXPECT_FALSE(lists.needs_rebuild());
  lists.invalidate();
  EXPECT_TRUE(lists.needs_rebuild());
  EXPECT_EQ(lists.n_rebuilds(), 2u);
}

TEST(NeighborLists, FollowAChangingNumberOfParticles) {
  NeighborLists lists = make_lists();
  for (std::size_t n : {100, 300, 7, 40}) {
    ParticleSet set = set_of(box(n, {0, 0, 0}, {6, 6, 6}, static_cast<unsigned>(n)));
    lists.rebuild(set, {}, 1);
    expect_complete(lists, set, {}, search_radius, search_radius);
  }
}

/// Along a wall every particle of a periodic sheet has the same neighbours, those beyond the seam
/// with the others: so their images weigh the same.
TEST(NeighborLists, ImagesInWallsWeighTheSameBesideASeam) {
  std::vector<Vec3> sheet;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 2; ++j) sheet.emplace_back(i + 0.5, j + 0.5, 0);
  ParticleSet set = set_of(sheet);
  Domain d;
  d.x = {true, 0, 8, 0};
  d.walls = {Wall{{0, 0, 0}, {0, 1, 0}}};
  NeighborLists lists = make_lists();
  lists.mirror_in(d.walls, 0);
  lists.rebuild(set, d, 1);
  const double h = 0.5 * support, pi = 3.14159265358979;
  lists.weigh_images(105 / (16 * pi * h * h * h * h * h));
  for (std::size_t i = 0; i < set.size(); ++i) lists.records()[i].volume = 1;
  lists.copy_images();
  std::set<float> shares;
  lists.for_each_image([&](std::size_t record, std::size_t) {
    const float share = lists.records()[record].volume;
    if (share < 1) shares.insert(std::round(1e5f * share));  // of walls alone
  });
  EXPECT_EQ(shares.size(), 1u);
}

}  // namespace
}  // namespace sturz
