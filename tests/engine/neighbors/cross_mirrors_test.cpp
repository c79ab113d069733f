// SPDX-License-Identifier: Apache-2.0
// Images in ground and walls of the pairs across two sets.
#include "engine/neighbors/cross_pairs.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace sturz {
namespace {

constexpr double h = 0.8;

/// Points above the plane through the origin with the given normal.
ParticleSet cloud(std::size_t n, unsigned seed, const Vec3& normal) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-3, 3), above(0, 4);
  ParticleSet p;
  p.grow(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 at(along(random), along(random), along(random));
    at += (above(random) - normal.dot(at)) * normal;
    p.x[i] = at.x(), p.y[i] = at.y(), p.z[i] = at.z();
  }
  return p;
}

Vec3 at(const ParticleSet& p, std::size_t i) { return {p.x[i], p.y[i], p.z[i]}; }

/// The plane as a pass that looks up the ground would have it.
struct Plane {
  std::vector<float> distance, nx, ny, nz;
  Plane(const ParticleSet& p, const Vec3& n)
      : nx(p.size(), static_cast<float>(n.x())),
        ny(p.size(), static_cast<float>(n.y())),
        nz(p.size(), static_cast<float>(n.z())) {
    for (std::size_t i = 0; i < p.size(); ++i)
      distance.push_back(static_cast<float>(n.dot(at(p, i))));
  }
  CrossPairs::Ground ground() const { return {distance.data(), nx.data(), ny.data(), nz.data()}; }
};

/// Weights by ids, those of set 0 first. \param on  the side whose rows are looked at
std::map<std::pair<std::uint32_t, std::uint32_t>, double> listed(const CrossPairs& pairs, int on,
                                                                 const ParticleSet& mine,
                                                                 const ParticleSet& other) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> out;
  const PairSide &side = pairs.side(on), &sources = pairs.side(1 - on);
  for (std::size_t r = 0; r < side.n_rows(); ++r) {
    const PairSide::Pairs near = side.pairs(r);
    for (std::size_t k = 0; k < near.n; ++k) {
      const std::uint32_t own = mine.id[side.index(r)];
      const std::uint32_t theirs = other.id[sources.index(near.source[k])];
      out[on == 0 ? std::pair{own, theirs} : std::pair{theirs, own}] = near.weight[k];
    }
  }
  return out;
}

/// W of the pair and of one particle with the image of the other.
double expected(const ParticleSet& a, std::size_t i, const ParticleSet& b, std::size_t j,
                const Vec3& n) {
  const SmoothingKernel kernel{h};
  const Vec3 image = at(b, j) - 2 * n.dot(at(b, j)) * n;
  return kernel.value((at(a, i) - at(b, j)).norm()) + kernel.value((at(a, i) - image).norm());
}

void expect_mirrored(const CrossPairs& pairs, const ParticleSet& a, const ParticleSet& b,
                     const Vec3& n) {
  const auto from_a = listed(pairs, 0, a, b), from_b = listed(pairs, 1, b, a);
  const double scale = SmoothingKernel{h}.value(0);
  std::size_t images = 0;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const auto found = from_a.find({i, j});
      EXPECT_NEAR(found == from_a.end() ? 0 : found->second, expected(a, i, b, j, n), 2e-6 * scale);
      images += n.dot(at(a, i)) + n.dot(at(b, j)) < 2 * h && found != from_a.end();
    }
  EXPECT_GT(images, 100u) << "or nothing was looked at";
  EXPECT_EQ(from_a, from_b) << "the same from both sides, to the last bit";
}

TEST(CrossMirrors, AnImageHasTheWeightOfItsPlace) {
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(Vec3(0.3, -0.2, 0.8).normalized())}) {
    const ParticleSet a = cloud(400, 1, n), b = cloud(700, 2, n);
    const Plane under_a(a, n), under_b(b, n);
    CrossPairs pairs(h, 0.2 * h, 1);
    pairs.update({a, 0, under_a.ground()}, {b, 0, under_b.ground()}, {}, 0, 0, 2);
    expect_mirrored(pairs, a, b, n);
  }
}

TEST(CrossMirrors, AWallIsOneUntilItIsRemoved) {
  const Vec3 n = Vec3(1, 0.5, 0).normalized();
  const ParticleSet a = cloud(400, 3, n), b = cloud(700, 4, n);
  Domain d;
  d.walls = {Wall{{0, 0, 0}, n}};
  d.walls[0].remove_at_s = 5;
  CrossPairs pairs(h, 0.2 * h, 1);
  pairs.update({a, 0}, {b, 0}, d, 0, 0, 1);
  expect_mirrored(pairs, a, b, n);
  pairs.update({a, 0}, {b, 0}, d, 0, 6, 1);
  for (const auto& [pair, w] : listed(pairs, 0, a, b))
    EXPECT_NEAR(w, SmoothingKernel{h}.value((at(a, pair.first) - at(b, pair.second)).norm()),
                1e-6 * SmoothingKernel{h}.value(0));
}

/// Beside a plane a lattice goes on as its own image: sums of weights and of slopes are those
/// inside.
TEST(CrossMirrors, SumsOverALatticeBesideAPlaneAreThoseInside) {
  const double dx = h / 1.3;
  ParticleSet rows, lattice;
  rows.grow(6), lattice.grow(std::size_t{11} * 11 * 14);
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows.x[k] = 0.2 * dx, rows.y[k] = -0.1 * dx, rows.z[k] = (0.3 + static_cast<double>(k)) * dx;
  std::size_t at_point = 0;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j)
      for (int k = 0; k < 14; ++k, ++at_point)
        lattice.x[at_point] = i * dx, lattice.y[at_point] = j * dx,
        lattice.z[at_point] = (k + 0.5) * dx;
  const Plane under_rows(rows, {0, 0, 1}), under_lattice(lattice, {0, 0, 1});
  CrossPairs pairs(h, 0.1 * h, 0);
  pairs.update({rows, 0, under_rows.ground()}, {lattice, 0, under_lattice.ground()}, {}, 0, 0, 1);
  const PairSide& side = pairs.side(0);
  std::vector<double> weights(rows.size(), 0), slopes(rows.size(), 0);
  for (std::size_t r = 0; r < side.n_rows(); ++r) {
    const PairSide::Pairs near = side.pairs(r), images = side.image_pairs(r, 0);
    for (std::size_t k = 0; k < near.n; ++k)
      weights[side.index(r)] += near.weight[k], slopes[side.index(r)] += near.slope[k];
    for (std::size_t k = 0; k < images.n; ++k) slopes[side.index(r)] += images.slope[k];
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(weights[k], weights[5], 2e-6 * weights[5]) << k;
    EXPECT_NEAR(slopes[k], slopes[5], 2e-6 * slopes[5]) << k;
  }
}

TEST(CrossMirrors, ACommonApproachMakesNewWeights) {
  const Vec3 n(0, 0, 1);
  ParticleSet a = cloud(300, 5, n), b = cloud(500, 6, n);
  for (const bool wall : {false, true}) {
    Domain d;
    if (wall) d.walls = {Wall{{0, 0, 0}, n}};
    CrossPairs pairs(h, 0.5 * h, 1);
    for (int step = 0; step < 4; ++step) {
      const Plane under_a(a, n), under_b(b, n);
      const auto ground = [&](const Plane& p) { return wall ? CrossPairs::Ground{} : p.ground(); };
      pairs.update({a, 0, ground(under_a)}, {b, 0, ground(under_b)}, d, 0, 0, 1);
      expect_mirrored(pairs, a, b, n);
      for (auto* p : {&a, &b})
        for (double& z : p->z) z += 0.05 * h;  // relative to each other they stay
    }
    EXPECT_EQ(pairs.n_rebuilds(), 1u) << "of weights, not of lists";
  }
}

/// Far from a mirror nothing is kept of it, and what is kept is counted.
TEST(CrossMirrors, TakeMemoryOnlyWhereTheyAreNear) {
  const Vec3 n(0, 0, 1);
  ParticleSet a = cloud(2000, 7, n), b = cloud(2000, 8, n);
  const auto bytes = [&](double lift, bool ground) {
    for (auto* p : {&a, &b})
      for (double& z : p->z) z += lift;
    const Plane under_a(a, n), under_b(b, n);
    CrossPairs pairs(h, 0.2 * h, 1);
    if (ground)
      pairs.update({a, 0, under_a.ground()}, {b, 0, under_b.ground()}, {}, 0, 0, 1);
    else
      pairs.update({a, 0}, {b, 0}, {}, 0, 0, 1);
    for (auto* p : {&a, &b})
      for (double& z : p->z) z -= lift;
    return static_cast<double>(pairs.bytes());
  };
  const double none = bytes(0, false), far = bytes(10, true), near = bytes(0, true);
  EXPECT_LT(far, 1.05 * none);
  EXPECT_GT(near, 1.15 * none);
}

/// As where no ground is known: a pass says so with an endless distance.
TEST(CrossMirrors, WithoutAKnownGroundThereIsNoImage) {
  const Vec3 n(0, 0, 1);
  const ParticleSet a = cloud(300, 9, n), b = cloud(300, 10, n);
  Plane under_a(a, n), under_b(b, n);
  for (auto* p : {&under_a, &under_b})
    p->distance.assign(p->distance.size(), std::numeric_limits<float>::infinity());
  CrossPairs pairs(h, 0.2 * h, 1), plain(h, 0.2 * h, 1);
  pairs.update({a, 0, under_a.ground()}, {b, 0, under_b.ground()}, {}, 0, 0, 1);
  plain.update({a, 0}, {b, 0}, {}, 0, 0, 1);
  EXPECT_EQ(listed(pairs, 0, a, b), listed(plain, 0, a, b));
}

}  // namespace
}  // namespace sturz
