// SPDX-License-Identifier: Apache-2.0
#include "tests/engine/effects/coupling/coupled_sets.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"
#include "engine/effects/step.hpp"
#include "tests/support/hand_made.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

/// What a set's own pair forces do at the gather stage.
class Remember final : public Pass {
 public:
  explicit Remember(std::size_t set) : set_(set) {}
  std::string_view name() const override { return "velocity before"; }
  Stage stage() const override { return Stage::gather; }
  void apply(State& s, double) override {
    MovingSet& p = s.sets[set_];
    auto& before = p.components(fields::velocity_before);
    before[0] = p.vx, before[1] = p.vy, before[2] = p.vz;
  }

 private:
  std::size_t set_;
};

void place(const Lattice& l, unsigned seed, MovingSet& p) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-l.jitter, l.jitter);
  p.spacing = l.spacing;
  p.reference_fraction = l.fraction;
  p.grow(static_cast<std::size_t>(l.n[0]) * l.n[1] * l.n[2]);
  std::size_t i = 0;
  for (int a = 0; a < l.n[0]; ++a)
    for (int b = 0; b < l.n[1]; ++b)
      for (int c = 0; c < l.n[2]; ++c, ++i) {
        const Vec3 at(a + 0.5 + unit(random), b + 0.5 + unit(random), c + 0.5 + unit(random));
        p.x[i] = l.corner.x() + l.spacing * at.x();
        p.y[i] = l.corner.y() + l.spacing * at.y();
        p.z[i] = l.corner.z() + l.spacing * at.z();
        p.vx[i] = l.velocity.x(), p.vy[i] = l.velocity.y(), p.vz[i] = l.velocity.z();
        p.mass[i] = l.bulk * l.spacing * l.spacing * l.spacing;
      }
}

}  // namespace

Vec3 CoupledSets::momentum() const {
  Vec3 sum(0, 0, 0);
  for (const MovingSet& p : state.sets)
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]);
  return sum;
}

double CoupledSets::kinetic() const {
  double sum = 0;
  for (const MovingSet& p : state.sets)
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += 0.5 * p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]).squaredNorm();
  return sum;
}

CoupledSets coupled_sets(const Lattice& grains, const Lattice& liquid, const Domain& domain,
                         const CouplingSettings& settings, int threads) {
  CoupledSets made{State(even_ground(8), domain), {}};
  State& s = made.state;
  s.gravity = 0;
  s.threads = threads;
  s.sets.resize(2);
  place(grains, 1, s.sets[0]);
  place(liquid, 2, s.sets[1]);
  add_coupling_fields(s, 1);
  for (const std::size_t k : {0u, 1u}) {
    s.sets[k].add(fields::velocity_before);
    mark_start(domain, s.sets[k], 0);
    made.step.add(std::make_unique<Remember>(k));
    add_gravity(made.step, s, k);
  }
  add_coupling(made.step, s, 0, 1, settings);
  for (const std::size_t k : {0u, 1u}) {
    add_motion(made.step, k, {s.sets[k].spacing, 1.3 * s.sets[k].spacing});
    refresh_motion(s, s.sets[k], 0);
    s.sets[k].ledger.kinetic_0 = s.sets[k].ledger.kinetic;
  }
  return made;
}

Domain periodic_box(double length) {
  Domain box;
  box.x = box.y = {true, 0, length, 0};
  return box;
}

std::array<Lattice, 2> full_pores(int n, double jitter, double solids) {
  Lattice grains, liquid;
  grains.n = liquid.n = {n, n, n};
  grains.jitter = liquid.jitter = jitter;
  grains.bulk = 2600 * solids, liquid.bulk = 1000 * (1 - solids);
  grains.fraction = solids;
  return {grains, liquid};
}

void shuffle(MovingSet& p, unsigned seed) {
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  for (auto* a : {&p.ax, &p.ay, &p.az}) {
    const std::vector<float> old = *a;
    for (std::size_t i = 0; i < p.size(); ++i) (*a)[i] = old[order[i]];
  }
  p.permute(order);
  ++p.n_sorts;
}

}  // namespace sturz::test
