// SPDX-License-Identifier: Apache-2.0
// Grains and liquid on a plane: what images in it do to their exchange.
#include "engine/effects/fields.hpp"
#include "tests/engine/effects/coupling/coupled_sets.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace sturz::test {
namespace {

/// Both sets on z = 0, whose distances a pass would have looked up.
CoupledSets on_a_plane(double jitter, Fate fate = Fate::stays, NodataRule rule = NodataRule::wall) {
  auto sets = full_pores(8, jitter);
  CouplingSettings settings;
  settings.drag_diameter = 1e-3;
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(8), settings);
  for (MovingSet& p : made.state.sets) {
    BoundarySupport& b = p.boundary;
    b.distance.assign(p.z.begin(), p.z.end());
    b.nx.assign(p.size(), 0.0f), b.ny.assign(p.size(), 0.0f), b.nz.assign(p.size(), 1.0f);
    p.fate.assign(p.size(), fate);
    p.any_leaving = fate != Fate::stays;
  }
  made.state.terrain = even_ground(8, 0, rule);
  return made;
}

TEST(CoupledMirrors, KeepMomentumAlongThePlane) {
  // Walls at its edges would throw back what comes there.
  CoupledSets made = on_a_plane(0.25, Fate::stays, NodataRule::outflow);
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 0.3);
  double scale = 0;
  for (MovingSet& p : made.state.sets)
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.vx[i] = normal(random) + (&p == &made.grains() ? 1 : 0), p.vy[i] = normal(random);
      p.vz[i] = normal(random);
      scale += p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]).norm();
    }
  made.liquid().ax.assign(made.liquid().size(), 2.0f);
  const Vec3 before = made.momentum();
  const double slip = made.grains().vx[0];
  made.step.apply(made.state, 1e-3);
  EXPECT_NE(made.grains().vx[0], slip);
  const MovingSet& l = made.liquid();
  double pushed = 0;  // what the room of the grains says is handed on
  for (std::size_t j = 0; j < l.size(); ++j)
    pushed += l.mass[j] * (1 + l.scalar(fields::grain_share)[j]) * 2 * 0.5e-3;
  EXPECT_NEAR(made.momentum().x() - before.x(), pushed, 1e-12 * scale);
  EXPECT_NEAR(made.momentum().y(), before.y(), 1e-12 * scale);
}

/// The lattice goes on as its own image: beside the plane grains take the room that they take
/// inside, and a flow of theirs along it or towards it diverges as it does inside.
TEST(CoupledMirrors, ShowWhatIsInsideBesideThePlane) {
  CoupledSets made = on_a_plane(0);
  MovingSet& p = made.grains();
  for (std::size_t i = 0; i < p.size(); ++i) p.vz[i] = -0.1 * p.z[i], p.vx[i] = 0.3;
  made.step.apply(made.state, 1e-9);
  const MovingSet& l = made.liquid();
  for (std::size_t j = 0; j < l.size(); ++j) {
    if (l.z[j] > 3) continue;  // the open top reaches no further
    EXPECT_NEAR(l.scalar(fields::grain_share)[j], 1, 1e-5) << l.z[j];
    EXPECT_NEAR(l.scalar(fields::slip_divergence)[j], -0.05, 1e-4 * 0.05) << l.z[j];
  }
}

/// There the distance is no number that means anything, and is 0.
TEST(CoupledMirrors, AreNotThereBeyondTheKnownGround) {
  const auto lowest = [](CoupledSets made) {
    for (MovingSet& p : made.state.sets)
      if (p.fate[0] != Fate::stays) p.boundary.distance.assign(p.size(), 0.0f);
    made.step.apply(made.state, 1e-9);
    double sum = 0;
    for (std::size_t j = 0; j < made.liquid().size(); ++j)
      if (made.liquid().z[j] < 1) sum += made.liquid().scalar(fields::grain_share)[j];
    return sum / 64;
  };
  EXPECT_NEAR(lowest(on_a_plane(0)), 1, 1e-5);
  auto open = full_pores(8, 0);  // no ground at all
  CoupledSets bare = coupled_sets(open[0], open[1], periodic_box(8), {});
  for (MovingSet& p : bare.state.sets) p.fate.assign(p.size(), Fate::stays);
  EXPECT_NEAR(lowest(on_a_plane(0, Fate::off_terrain)), lowest(std::move(bare)), 1e-12);
}

}  // namespace
}  // namespace sturz::test
