// SPDX-License-Identifier: Apache-2.0
/// Fine steps of spheres in contact, what they remember, and the search for near pairs.
#include "engine/effects/isolated/bodies.hpp"
#include "engine/effects/isolated/contact_memory.hpp"
#include "engine/effects/isolated/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace sturz {
namespace {

IsolatedBody body(const Vec3& position, const Vec3& velocity, std::uint32_t id) {
  IsolatedBody b;
  b.start = b.position = position;
  b.velocity = velocity;
  b.radius = 0.5;
  b.mass = 1000;
  b.id = id;
  return b;
}

/// Of two such bodies, soft enough for 20 m/s.
IsolatedContact soft_contact(double restitution, double friction) {
  const GrainMaterial soft = softened({}, softest_modulus(2600, 20));
  IsolatedContact c;
  c.b = 1;
  c.law = {contact_modulus(soft, soft),
           contact_shear_modulus(soft, soft),
           0.25,
           500,
           damping_ratio(restitution),
           friction,
           false};
  return c;
}

struct After {
  double restitution, surface_speed, energy;
};

/// They meet at 20 m/s, with `across` [m/s] of it to the side each, n fine steps per impact; they
/// first touch at a share of a fine step.
After meet(double restitution, double across, int n, double share) {
  std::vector<IsolatedContact> contacts{soft_contact(restitution, 0.5)};
  const double h = impact_duration(contacts[0].law, 20) / n, x = 0.5 + share * h * 10;
  std::vector<IsolatedBody> two{body({-x, 0, 0}, {10, across, 0}, 0),
                                body({x, 0, 0}, {-10, -across, 0}, 1)};
  step_bodies(two, contacts, (2 * n + 2) * h, 2 * n + 2);
  const IsolatedBody& b = two[0];
  return {-b.velocity.x() / 10, b.spin.z() * b.radius,
          b.mass * b.velocity.squaredNorm() + b.inertia() * b.spin.squaredNorm()};
}

TEST(IsolatedBodies, FineStepsConverge) {
  for (double e : {0.3, 0.7, 0.9})
    for (double across : {0.0, 3.0, 12.0}) {
      const After exact = meet(e, across, 5000, 0.5);
      if (across == 0) {
        EXPECT_NEAR(exact.restitution, e, 1e-4);
      }
      double error[2] = {0, 0}, surface[2] = {0, 0};
      const int steps[2] = {20, 80};
      for (int k = 0; k < 2; ++k)
        for (double share = 0; share < 1; share += 0.1) {
          const After a = meet(e, across, steps[k], share);
          error[k] = std::max(error[k], std::abs(a.restitution - exact.restitution));
          surface[k] = std::max(surface[k], std::abs(a.surface_speed - exact.surface_speed));
          EXPECT_LT(a.energy, 1000 * (100 + across * across));
        }
      EXPECT_LT(error[0], 0.015) << e << ' ' << across;
      EXPECT_LT(error[1], 0.4 * error[0]) << e << ' ' << across;
      EXPECT_LT(surface[0], 0.02 * 20) << e << ' ' << across;
      EXPECT_LE(surface[1], 0.5 * surface[0]) << e << ' ' << across;
    }
}

TEST(IsolatedBodies, HandTheirContactsOnFromStepToStep) {
  // Whole, or in four parts between which only the memory knows of the springs.
  const IsolatedContact contact = soft_contact(0.7, 0.5);
  const double dt = 1.5 * impact_duration(contact.law, 20), start = 0.499;
  const std::vector<IsolatedBody> begin{body({-start, 0, 0}, {10, 2, 0}, 7),
                                        body({start, 0, 0}, {-10, 0, 1}, 3)};
  std::vector<IsolatedBody> whole = begin, parts = begin;
  std::vector<IsolatedContact> contacts{contact};
  step_bodies(whole, contacts, dt, 800);
  const ContactMemory nothing;
  double error[2];
  for (bool forgets : {false, true}) {
    parts = begin;
    ContactMemory memory;
    for (int part = 0; part < 4; ++part) {
      for (IsolatedBody& b : parts) b.start = b.position;
      contacts = {contact};
      if (part > 0) (forgets ? nothing : memory).recall(contacts, parts);
      step_bodies(parts, contacts, dt / 4, 200);
      memory.remember(contacts, parts);
    }
    error[forgets] = (parts[0].velocity - whole[0].velocity).norm();
  }
  EXPECT_LT((parts[0].velocity - begin[0].velocity).norm(), 20);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_GT(error[1], 1) << "without memory";
}

using IdPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

IdPairs by_brute_force(const std::vector<IsolatedSphere>& spheres, double max_gap,
                       const Domain& d) {
  IdPairs all;
  const int p = d.x.active ? 2 : 0, q = d.y.active ? 2 : 0;
  for (const IsolatedSphere& a : spheres)
    for (const IsolatedSphere& b : spheres)
      for (int i = -p; i <= p; ++i)
        for (int j = -q; j <= q; ++j) {
          const Vec3 period(d.x.length() * i, d.y.length() * j, d.x.rise * i + d.y.rise * j);
          const double limit = a.radius + b.radius + max_gap;
          if (a.id < b.id && (b.position + period - a.position).norm() < limit)
            all.emplace_back(a.id, b.id);
        }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(IsolatedSearch, FindsEveryPairAndNoOtherWhileTheyMove) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const bool periodic : {false, true}) {
    Domain domain;
    if (periodic) {
      domain.x = {true, 0, 9, 1.5};
      domain.y = {true, -2, 8, 0};
    }
    std::vector<IsolatedSphere> spheres(200);
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
      const Vec3 position(12 * unit(random) - 1, 10 * unit(random) - 2, 6 * unit(random));
      const Vec3 velocity(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
      spheres[i] = {position, velocity, 0.2 + 0.3 * unit(random), 199 - i};
    }
    IsolatedSearch search;
    const double max_gap = 0.25;
    for (int n = 0; n < 10; ++n) {
      IdPairs found;
      for (const NearPair& p : search.find(spheres, max_gap, domain)) {
        const IsolatedSphere &a = spheres[p.a], &b = spheres[p.b];
        EXPECT_LT((b.position + p.image - a.position).norm(), a.radius + b.radius + max_gap);
        found.emplace_back(a.id, b.id);
      }
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
      ASSERT_EQ(found, by_brute_force(spheres, max_gap, domain)) << n;
      EXPECT_GT(found.size(), 50u);
      for (IsolatedSphere& s : spheres) s.position += 0.2 * s.velocity;
    }
    EXPECT_GT(search.n_grids(), 2u);
    EXPECT_LT(search.n_grids(), 8u);
  }
}

TEST(IsolatedSearch, SeesNewAndWrappedParticles) {
  std::vector<IsolatedSphere> spheres{{{0, 0, 0}, {0, 0, 0}, 0.5, 4},
                                      {{9, 0, 0}, {0, 0, 0}, 0.5, 2}};
  IsolatedSearch search;
  EXPECT_EQ(search.find(spheres, 0.1, {}).size(), 0u);
  spheres.push_back({{0, 0.9, 0}, {0, 0, 0}, 0.5, 1});
  EXPECT_EQ(search.find(spheres, 0.1, {}).size(), 1u);
  spheres[1].position.x() -= 8.1;  // as a period takes it back
  EXPECT_EQ(search.find(spheres, 0.1, {}).size(), 2u);
  std::swap(spheres[1].id, spheres[2].id);  // storage was sorted anew
  EXPECT_EQ(search.find(spheres, 0.1, {}).size(), 2u);
  EXPECT_EQ(search.n_grids(), 4u);
  EXPECT_EQ(search.find(spheres, 0.1, {}).size(), 2u);
  EXPECT_EQ(search.n_grids(), 4u);
}

TEST(IsolatedSearch, SurvivesDistantParticles) {
  std::vector<IsolatedSphere> spheres(5);
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  const Vec3 positions[] = {{0, 0, 0}, {0.9, 0, 0}, {1e300, 0, 0}, {nowhere, 0, 0}, {-1e12, 5, 5}};
  for (std::uint32_t i = 0; i < 5; ++i) spheres[i] = {positions[i], {0, 0, 0}, 0.5, i};
  IsolatedSearch search;
  const auto& pairs = search.find(spheres, 0.1, {});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].a, 0u);
  EXPECT_EQ(pairs[0].b, 1u);
}

}  // namespace
}  // namespace sturz
