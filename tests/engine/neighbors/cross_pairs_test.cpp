// SPDX-License-Identifier: Apache-2.0
// Pairs across two sets with their weights, against a search over all pairs.
#include "engine/neighbors/cross_pairs.hpp"

#include "engine/neighbors/smoothing_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

namespace sturz {
namespace {

constexpr double h = 0.8;

ParticleSet cloud(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 10);
  ParticleSet p;
  p.grow(n);
  for (std::size_t i = 0; i < n; ++i)
    p.x[i] = unit(random), p.y[i] = unit(random), p.z[i] = unit(random);
  return p;
}

/// Weight and gradient by ids.
using Sums = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// \param on  the side whose rows are looked at; ids are those of set 0 first
Sums listed(const CrossPairs& pairs, int on, const ParticleSet& mine, const ParticleSet& other) {
  const PairSide &side = pairs.side(on), &sources = pairs.side(1 - on);
  std::vector<double> id(sources.n_sources());
  for (std::size_t r = 0; r < sources.n_rows(); ++r) id[r] = other.id[sources.index(r)];
  sources.copy_images(id);
  Sums out;
  for (std::size_t r = 0; r < side.n_rows(); ++r)
    for (std::size_t k = 0; k < side.pairs(r).n; ++k) {
      const PairSide::Pairs pairs_of = side.pairs(r);
      const auto theirs = static_cast<std::uint32_t>(id[pairs_of.source[k]]);
      const std::uint32_t own = mine.id[side.index(r)];
      const double w = pairs_of.weight[k];
      if (w > 0) out[on == 0 ? std::pair{own, theirs} : std::pair{theirs, own}] += w;
    }
  return out;
}

Sums slow(const ParticleSet& a, const ParticleSet& b, const Domain& d) {
  const SmoothingKernel kernel{h};
  Sums out;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      for (int m = d.x.active ? -4 : 0; m <= (d.x.active ? 4 : 0); ++m)
        for (int n = d.y.active ? -4 : 0; n <= (d.y.active ? 4 : 0); ++n) {
          const double dx = a.x[i] - b.x[j] - m * d.x.length(),
                       dy = a.y[i] - b.y[j] - n * d.y.length(),
                       dz = a.z[i] - b.z[j] - m * d.x.rise - n * d.y.rise;
          const double w = kernel.value(std::sqrt(dx * dx + dy * dy + dz * dz));
          if (w > 0) out[{a.id[i], b.id[j]}] += w;
        }
  return out;
}

void expect_same(const Sums& found, const Sums& expected) {
  const double scale = SmoothingKernel{h}.value(0);
  for (const auto& [pair, w] : expected) {
    const auto at = found.find(pair);
    EXPECT_NEAR(at == found.end() ? 0 : at->second, w, 1e-6 * scale);
  }
  for (const auto& [pair, w] : found)
    EXPECT_NEAR(w, expected.contains(pair) ? expected.at(pair) : 0, 1e-6 * scale);
}

/// The same weights from both sides, to the last bit of what is summed over images.
void expect_symmetric(const Sums& one, const Sums& other) {
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [pair, w] : one) {
    ASSERT_TRUE(other.contains(pair));
    EXPECT_NEAR(other.at(pair), w, 1e-15 * w);
  }
}

TEST(CrossPairs, HoldEveryPairOfTwoClouds) {
  const ParticleSet a = cloud(300, 1), b = cloud(1500, 2);
  CrossPairs pairs(h, 0.2 * h, 1);
  pairs.update({a, 0}, {b, 0}, {}, 0, 0, 2);
  const Sums from_a = listed(pairs, 0, a, b);
  EXPECT_GT(from_a.size(), 5000u);
  expect_same(from_a, slow(a, b, {}));
  expect_symmetric(from_a, listed(pairs, 1, b, a));
}

TEST(CrossPairs, HoldThoseAcrossPeriodsThatRise) {
  Domain box;
  box.x = {true, 0, 10, -1.5};
  box.y = {true, 0, 10, 0};
  const ParticleSet a = cloud(200, 3), b = cloud(900, 4);
  CrossPairs pairs(h, 0.2 * h, 1);
  pairs.update({a, 0}, {b, 0}, box, 0, 0, 1);
  expect_same(listed(pairs, 0, a, b), slow(a, b, box));
  expect_symmetric(listed(pairs, 0, a, b), listed(pairs, 1, b, a));
  Domain narrow;  // images of images: a box shorter than the support
  narrow.x = {true, 0, 1.2, 0};
  ParticleSet few = cloud(12, 5), some = cloud(30, 6);
  for (auto* p : {&few, &some})
    for (double& x : p->x) x *= 0.12;
  CrossPairs short_pairs(h, 0, 1);
  short_pairs.update({few, 0}, {some, 0}, narrow, 0, 0, 1);
  expect_same(listed(short_pairs, 0, few, some), slow(few, some, narrow));
}

TEST(CrossPairs, FollowMovesWithinTheSkinAndNewOrders) {
  for (const bool periodic : {false, true}) {
    Domain box;
    if (periodic) box.x = {true, 0, 10, 0};
    ParticleSet a = cloud(300, 1), b = cloud(1500, 2);
    CrossPairs pairs(h, 0.3 * h, 1);
    std::size_t sorts[2] = {0, 0};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    const double way = 0.02 * h;  // of each particle along each axis
    pairs.update({a, 0}, {b, 0}, box, 0, 0, 1);
    for (int step = 0; step < 12; ++step) {
      for (auto* p : {&a, &b})
        for (auto* x : {&p->x, &p->y, &p->z})
          for (double& value : *x) value += way * unit(random);
      if (step % 3 == 2) {
        std::vector<std::uint32_t> order(b.size());
        std::iota(order.begin(), order.end(), 0u);
        std::shuffle(order.begin(), order.end(), random);
        b.permute(order);
        ++sorts[1];
      }
      pairs.update({a, sorts[0]}, {b, sorts[1]}, box, 2 * std::sqrt(3.0) * way, 0, 1);
      expect_same(listed(pairs, 0, a, b), slow(a, b, box));
    }
    EXPECT_GT(pairs.n_rebuilds(), 1u);
    EXPECT_LT(pairs.n_rebuilds(), periodic ? 12u : 5u) << "sorting alone makes no new lists";
  }
}

TEST(CrossPairs, KnowWhoCameAndWent) {
  ParticleSet a = cloud(100, 1), b = cloud(400, 2);
  CrossPairs pairs(h, 0.3 * h, 1);
  pairs.update({a, 0}, {b, 0}, {}, 0, 0, 1);
  a.grow(1);
  a.x[100] = b.x[0], a.y[100] = b.y[0], a.z[100] = b.z[0];
  std::vector<std::uint8_t> keep(a.size(), 1);
  keep[4] = 0;
  a.compact(keep);
  pairs.update({a, 0}, {b, 0}, {}, 0, 0, 1);
  expect_same(listed(pairs, 0, a, b), slow(a, b, {}));
  const ParticleSet none;
  pairs.update({none, 0}, {b, 0}, {}, 0, 0, 1);
  EXPECT_TRUE(listed(pairs, 1, b, none).empty());
}

TEST(CrossPairs, GradientIsTheDerivativeOfTheWeight) {
  const ParticleSet a = cloud(300, 1);
  ParticleSet b = cloud(200, 2);
  const auto weights = [&](std::vector<double>* gradient) {
    CrossPairs pairs(h, 0, 1);
    pairs.update({a, 0}, {b, 0}, {}, 0, 0, 1);
    const PairSide& side = pairs.side(1);
    std::vector<double> sum(b.size(), 0);
    for (std::size_t r = 0; r < side.n_rows(); ++r) {
      const PairSide::Pairs near = side.pairs(r);
      for (std::size_t k = 0; k < near.n; ++k) {
        sum[side.index(r)] += near.weight[k];
        const Vec3 apart = pairs.unit() * (pairs.side(0).place(near.source[k]) - side.place(r));
        if (gradient) (*gradient)[side.index(r)] += near.slope[k] * apart.y();
      }
    }
    return sum;
  };
  std::vector<double> gradient(b.size(), 0);
  weights(&gradient);
  const double d = 1e-3;
  for (double& y : b.y) y += d;
  const std::vector<double> up = weights(nullptr);
  for (double& y : b.y) y -= 2 * d;
  const std::vector<double> down = weights(nullptr);
  for (std::size_t j = 0; j < b.size(); ++j)  // made so that linear fields come out: 1/0.9789
    EXPECT_NEAR(0.9789 * gradient[j], (up[j] - down[j]) / (2 * d), 2e-3);
}

}  // namespace
}  // namespace sturz
