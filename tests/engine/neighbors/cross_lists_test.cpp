// SPDX-License-Identifier: Apache-2.0
// Neighbours between two particle sets, against a search over all pairs.
#include "engine/neighbors/cross_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

namespace sturz {
namespace {

ParticleSet cloud(std::size_t n, unsigned seed, double size = 10) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, size);
  ParticleSet p;
  p.grow(n);
  for (std::size_t i = 0; i < n; ++i)
    p.x[i] = unit(random), p.y[i] = unit(random), p.z[i] = unit(random);
  return p;
}

using Found = std::multiset<std::tuple<std::uint32_t, std::uint32_t, long, long, long>>;

std::tuple<std::uint32_t, std::uint32_t, long, long, long> entry(std::uint32_t i, std::uint32_t j,
                                                                 const Vec3& r) {
  return {i, j, std::lround(1e6 * r.x()), std::lround(1e6 * r.y()), std::lround(1e6 * r.z())};
}

Found listed(const CrossLists& lists, const ParticleSet& a, const ParticleSet& b) {
  Found out;
  for (std::size_t i = 0; i < a.size(); ++i)
    lists.for_each(i, a, b,
                   [&](std::size_t j, const Vec3& r) { out.insert(entry(a.id[i], b.id[j], r)); });
  return out;
}

/// All pairs, with all images of the box and its neighbours.
Found slow(const ParticleSet& a, const ParticleSet& b, double support, const Domain& d) {
  Found out;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      for (int m = d.x.active ? -4 : 0; m <= (d.x.active ? 4 : 0); ++m)
        for (int n = d.y.active ? -4 : 0; n <= (d.y.active ? 4 : 0); ++n) {
          const Vec3 r(a.x[i] - b.x[j] - m * d.x.length(), a.y[i] - b.y[j] - n * d.y.length(),
                       a.z[i] - b.z[j] - m * d.x.rise - n * d.y.rise);
          if (r.squaredNorm() < support * support) out.insert(entry(a.id[i], b.id[j], r));
        }
  return out;
}

TEST(CrossLists, HoldEveryPairOfTwoClouds) {
  const ParticleSet coarse = cloud(300, 1), fine = cloud(1500, 2);
  for (double support : {0.3, 1.1, 4.0}) {
    CrossLists lists(support, 0.1 * support);
    lists.rebuild(coarse, fine, {}, 1);
    EXPECT_EQ(listed(lists, coarse, fine), slow(coarse, fine, support, {})) << support;
  }
}

TEST(CrossLists, SeeTheSamePairsFromBothSides) {
  const ParticleSet a = cloud(200, 3), b = cloud(400, 4);
  CrossLists there(1.2, 0.1), back(1.2, 0.1);
  there.rebuild(a, b, {}, 1);
  back.rebuild(b, a, {}, 2);
  Found mirrored;
  for (std::size_t j = 0; j < b.size(); ++j)
    back.for_each(j, b, a, [&](std::size_t i, const Vec3& r) {
      mirrored.insert(entry(a.id[i], b.id[j], -r));
    });
  EXPECT_EQ(listed(there, a, b), mirrored);
}

TEST(CrossLists, CrossPeriodicBordersThatRise) {
  Domain box;
  box.x = {true, 0, 10, -2};
  box.y = {true, 0, 10, 0.5};
  const ParticleSet a = cloud(250, 5), b = cloud(350, 6);
  CrossLists lists(1.5, 0.15);
  lists.rebuild(a, b, box, 1);
  EXPECT_EQ(listed(lists, a, b), slow(a, b, 1.5, box));
}

/// A slice may be thinner than a support: then a particle meets several images of another.
TEST(CrossLists, FindEveryImageInAShortBox) {
  Domain box;
  box.x = {true, 0, 3, 0.7};
  box.y = {true, 0, 3, 0};
  const ParticleSet a = cloud(60, 12, 3), b = cloud(60, 13, 3);
  for (double support : {2.0, 3.5, 6.5}) {
    CrossLists lists(support, 0.1);
    lists.rebuild(a, b, box, 1);
    EXPECT_EQ(listed(lists, a, b), slow(a, b, support, box)) << support;
  }
}

TEST(CrossLists, MissNothingAfterMovesWithinTheSkin) {
  ParticleSet a = cloud(200, 7), b = cloud(300, 8);
  CrossLists lists(1.0, 0.2);
  lists.rebuild(a, b, {}, 1);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> step(-0.057, 0.057);  // 0.1 at the most
  for (auto* p : {&a, &b})
    for (std::size_t i = 0; i < p->size(); ++i)
      p->x[i] += step(random), p->y[i] += step(random), p->z[i] += step(random);
  lists.add_relative_motion(0.199);
  EXPECT_FALSE(lists.needs_rebuild());
  EXPECT_EQ(listed(lists, a, b), slow(a, b, 1.0, {}));
  lists.add_relative_motion(0.01);
  EXPECT_TRUE(lists.needs_rebuild());
}

TEST(CrossLists, OrderAndThreadsDoNotChangeTheSums) {
  ParticleSet a = cloud(3000, 10), b = cloud(3000, 11);
  const auto sums = [&](int threads) {
    CrossLists lists(1.0, 0.1);
    lists.rebuild(a, b, {}, threads);
    std::vector<double> by_id(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      lists.for_each(i, a, b, [&](std::size_t, const Vec3& r) { by_id[a.id[i]] += r.norm(); });
    return by_id;
  };
  const auto first = sums(1);
  EXPECT_EQ(sums(2), first);
  std::vector<std::uint32_t> order(b.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  b.permute(order);
  a.permute(order);
  EXPECT_EQ(sums(2), first);
}

TEST(CrossLists, EmptySetsHaveNoNeighbours) {
  const ParticleSet a = cloud(10, 1), none;
  CrossLists lists(1, 0.1);
  lists.rebuild(a, none, {}, 1);
  EXPECT_EQ(lists.n_entries(), 0u);
  lists.rebuild(none, a, {}, 1);
  EXPECT_EQ(lists.n_entries(), 0u);
}

}  // namespace
}  // namespace sturz
