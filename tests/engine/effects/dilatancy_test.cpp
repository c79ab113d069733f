// SPDX-License-Identifier: Apache-2.0
// Grains in full stress that loosen or tighten where they are sheared.
#include "engine/effects/arrivals.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/dilatancy/effect.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sturz::test {
namespace {

constexpr double density = 1560, released = 0.6, slope = 0.6;
constexpr int wide = 6, layers = 8;

/// A periodic sheet on a slope, which flows.
struct Sheet {
  HandMade made;
  double start_height = 0;

  /// \param critical  fraction that steady shear leaves as it is; 0: no dilatancy
  explicit Sheet(double critical, int threads = 1)
      : made{State(even_ground(64, slope), periods()), {}} {
    State& s = made.state;
    s.threads = threads;
    MovingSet& p = s.sets[0];
    const auto places = block({wide, wide, layers});
    p.grow(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      p.x[i] = places[i].x(), p.y[i] = places[i].y();
      p.z[i] = places[i].z() * std::sqrt(1 + slope * slope) - slope * places[i].x();
      p.mass[i] = density;
      p.ledger.released_mass += density;
    }
    mark_start(s.domain, p, 0);
    add_gravity(made.step, s, 0);
    ContactSettings contact;
    contact.reference_density = density;
    contact.stiffness = 4000;
    contact.bed = {{0.8}};
    add_terrain_contact(made.step, 0, contact);
    GrainStressSettings g;
    g.reference_density = density;
    g.sound_speed = 100;
    g.law.grain_diameter = 0.5;
    g.instruction_set = best_instruction_set();
    std::vector<double> depth;
    for (const Vec3& at : places) depth.push_back(layers - at.z());
    const auto shared = add_grain_stress(made.step, s, 0, g, depth);
    if (critical > 0) {
      DilatancySettings d;
      d.law.critical_fraction = critical;
      d.law.fluid_viscosity = 0;
      d.reference_fraction = released;
      add_dilatancy(made.step, s, shared, d);
    }
    add_motion(made.step, 0, {1, g.smoothing_length});
    refresh_motion(s, p, 0);
    start_height = mean_height();
  }

  static Domain periods() {
    Domain d;
    d.x = {true, 0, wide, -slope * wide};
    d.y = {true, 0, wide, 0};
    return d;
  }
  /// Over the slope, mean of the particles [m].
  double mean_height() const {
    const MovingSet& p = made.state.grains();
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.z[i] + slope * p.x[i];
    return sum / static_cast<double>(p.size()) / std::sqrt(1 + slope * slope);
  }
  double mean_packing() const {
    double sum = 0;
    const auto& packing = made.state.grains().scalar(fields::packing_change);
    for (const double e : packing) sum += e;
    return sum / static_cast<double>(packing.size());
  }
  void run(double seconds) {
    while (made.state.time < seconds) made.advance();
  }
};

TEST(Dilatancy, AFlowingSheetComesToItsCriticalFraction) {
  for (const double critical : {0.54, 0.66}) {
    Sheet sheet(critical);
    sheet.run(12);
    const double packing = critical / released - 1;
    EXPECT_NEAR(sheet.mean_packing() / packing, 1, 0.15) << critical;
    // The packing is what the place is: a looser sheet stands higher by as much.
    EXPECT_NEAR(sheet.mean_height() / sheet.start_height, 1 / (1 + sheet.mean_packing()), 0.02)
        << critical;
    EXPECT_TRUE(sheet.made.state.grains().motion.finite);
  }
}

TEST(Dilatancy, PairForcesStayOppositeInAnUnevenPacking) {
  Sheet sheet(0.54);
  sheet.run(3);
  const Ledger l = sheet.made.state.ledger();
  EXPECT_GT(std::abs(sheet.mean_packing()), 0.01);
  EXPECT_LT(l.stress_impulse.norm(), 1e-4 * l.stress_impulse_scale);
}

TEST(Dilatancy, AtRestNothingChanges) {
  Sheet sheet(0.54);
  sheet.made.state.gravity = 0;
  sheet.run(0.5);
  EXPECT_NEAR(sheet.mean_packing(), 0, 1e-3);
}

TEST(Dilatancy, AccountsForTheWorkOfLoosening) {
  Sheet sheet(0.54);
  sheet.run(4);
  const Ledger l = sheet.made.state.ledger();
  EXPECT_LT(std::abs(l.residual()), 0.02 * l.gravity_work);
}

TEST(Dilatancy, GivesTheSameBitsAtAnyNumberOfThreads) {
  Sheet one(0.54, 1), two(0.54, 2);
  one.run(0.5), two.run(0.5);
  EXPECT_EQ(one.made.state.grains().x, two.made.state.grains().x);
  EXPECT_EQ(one.made.state.grains().scalar(fields::packing_change),
            two.made.state.grains().scalar(fields::packing_change));
}

TEST(Dilatancy, IsNotThereWithoutIt) {
  const Sheet sheet(0);
  EXPECT_FALSE(sheet.made.state.grains().has(fields::packing_change));
}

}  // namespace
}  // namespace sturz::test
