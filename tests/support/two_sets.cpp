// SPDX-License-Identifier: Apache-2.0
#include "tests/support/two_sets.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/neighbors/cross_pairs.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"
#include "engine/simulation/parts.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace sturz::test {
namespace {

constexpr double smoothing_ratio = 1.3;

void place(const GrainBox& box, MovingSet& p) {
  p.name = box.name;
  p.spacing = box.spacing;
  p.bulk_density = box.density;
  p.grow(static_cast<std::size_t>(box.n[0]) * box.n[1] * box.n[2]);
  std::size_t i = 0;
  for (int a = 0; a < box.n[0]; ++a)
    for (int b = 0; b < box.n[1]; ++b)
      for (int c = 0; c < box.n[2]; ++c, ++i) {
        const Vec3 at = box.corner + box.spacing * Vec3(a + 0.5, b + 0.5, c + 0.5);
        p.x[i] = at.x(), p.y[i] = at.y(), p.z[i] = at.z();
        p.vx[i] = box.velocity.x(), p.vy[i] = box.velocity.y(), p.vz[i] = box.velocity.z();
        p.mass[i] = box.density * box.spacing * box.spacing * box.spacing;
        p.ledger.released_mass += p.mass[i];
      }
}

/// Linear drag between two sets: a pair exchanges k W(r)/W(0) m_i m_j (v_j - v_i), each side summed
/// from its own pairs.
class Exchange final : public Pass {
 public:
  Exchange(double rate, double support)
      : per_weight_(rate / SmoothingKernel{0.5 * support}.value(0)),
        pairs_(0.5 * support, 0.05 * support, no_gradients) {}
  std::string_view name() const override { return "exchange"; }
  std::string_view effect() const override { return "exchange"; }
  Stage stage() const override { return Stage::force; }

  void apply(State& s, double) override {
    MovingSet &a = s.sets[0], &b = s.sets[1];
    const double ahead = (a.motion.max_speed + b.motion.max_speed) * s.previous_dt;
    pairs_.update({a, a.n_sorts}, {b, b.n_sorts}, s.domain, ahead, s.time, s.threads);
    for (int side : {0, 1}) drag(side, s.sets[side], s.sets[1 - side]);
  }

 private:
  static constexpr int no_gradients = -1;
  struct Motion {
    Vec3 velocity{0, 0, 0};
    double mass = 0;
  };

  void drag(int side, MovingSet& from, const MovingSet& to) const {
    const PairSide &rows = pairs_.side(side), &sources = pairs_.side(1 - side);
    std::vector<Motion> moved(sources.n_sources());
    for (std::size_t r = 0; r < sources.n_rows(); ++r) {
      const std::uint32_t j = sources.index(r);
      moved[r] = {{to.vx[j], to.vy[j], to.vz[j]}, to.mass[j]};
    }
    sources.copy_images(moved);
    for (std::size_t r = 0; r < rows.n_rows(); ++r) {
      const std::uint32_t i = rows.index(r);
      const PairSide::Pairs pairs = rows.pairs(r);
      const Vec3 own(from.vx[i], from.vy[i], from.vz[i]);
      Vec3 a(0, 0, 0);
      for (std::size_t k = 0; k < pairs.n; ++k) {
        const Motion& other = moved[pairs.source[k]];
        a += per_weight_ * pairs.weight[k] * other.mass * (other.velocity - own);
      }
      from.ax[i] += static_cast<float>(a.x());
      from.ay[i] += static_cast<float>(a.y());
      from.az[i] += static_cast<float>(a.z());
    }
  }

  double per_weight_;
  CrossPairs pairs_;
};

void add_set(HandMade& made, std::size_t k, const GrainBox& box) {
  State& s = made.state;
  place(box, s.sets[k]);
  mark_start(s.domain, s.sets[k], 0);
  GrainStressSettings grains;
  grains.spacing = box.spacing;
  grains.smoothing_length = smoothing_ratio * box.spacing;
  grains.reference_density = box.density;
  grains.sound_speed = 100;
  grains.instruction_set = best_instruction_set();
  add_grain_stress(made.step, s, k, grains, std::vector<double>(s.sets[k].size(), 0));
  add_gravity(made.step, s, k);
  ContactSettings contact;
  contact.spacing = box.spacing;
  contact.smoothing_length = grains.smoothing_length;
  contact.reference_density = box.density;
  contact.stiffness = 4000;
  add_terrain_contact(made.step, k, contact);
  add_motion(made.step, k, {box.spacing, grains.smoothing_length});
  refresh_motion(s, s.sets[k], 0);
  s.sets[k].ledger.kinetic_0 = s.sets[k].ledger.kinetic;
}

}  // namespace

std::vector<GrainBox> coarse_and_fine() {
  return {{"coarse", 1.0, 1600, {-4, -4, 9}, {8, 8, 4}, {0, 0, -4}},
          {"fine", 0.6, 1400, {-3, -3, 2}, {10, 10, 6}, {0, 0, 8}}};
}

HandMade sets_of(const std::vector<GrainBox>& boxes, int threads, double exchange) {
  HandMade made{State(even_ground(64), Domain{}), {}};
  made.state.threads = threads;
  made.state.sets.resize(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) add_set(made, k, boxes[k]);
  if (exchange > 0) made.step.add(std::make_unique<Exchange>(exchange, 2.0));
  return made;
}

Simulation simulation_of(HandMade made, double end_time_s, bool apart) {
  StopSettings stop;
  stop.end_time_s = end_time_s;
  stop.stop_at_rest = false;
  RunFacts facts;
  for (const MovingSet& set : made.state.sets)
    facts.spacing_m = std::min(facts.spacing_m, set.spacing);
  return Simulation(std::make_unique<SimulationParts>(SimulationParts{
      std::move(made.state), std::move(made.step),
      PeakMaps({Grid{64, 64, -32, 32, 1, ""}, 0.05, 0.375, apart}), StopRule(stop), facts}));
}

}  // namespace sturz::test
