// SPDX-License-Identifier: Apache-2.0
#include "tests/support/two_sets.hpp"

#include "engine/effects/arrivals.hpp"
#include "engine/effects/motion/accounts.hpp"
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

/// Linear drag between two sets: a pair exchanges k W(r) m_i m_j (v_j - v_i), W = (1 - r/R)^3, each
/// side summed from its own lists.
class Exchange final : public Pass {
 public:
  Exchange(double rate, double support) : rate_(rate), support_(support) {
    for (auto& lists : lists_) lists = std::make_unique<CrossLists>(support, 0.1 * support);
  }
  std::string_view name() const override { return "exchange"; }
  std::string_view effect() const override { return "exchange"; }
  Stage stage() const override { return Stage::force; }

  void apply(State& s, double) override {
    for (int side : {0, 1}) {
      CrossLists& lists = *lists_[side];
      MovingSet &from = s.sets[side], &to = s.sets[1 - side];
      lists.add_relative_motion((from.motion.max_speed + to.motion.max_speed) * s.previous_dt);
      if (sorts_[side] != from.n_sorts + to.n_sorts) lists.invalidate();
      sorts_[side] = from.n_sorts + to.n_sorts;
      if (lists.needs_rebuild()) lists.rebuild(from, to, s.domain, s.threads);
      drag(lists, from, to);
    }
  }

 private:
  void drag(const CrossLists& lists, MovingSet& from, const MovingSet& to) const {
    for (std::size_t i = 0; i < from.size(); ++i) {
      Vec3 a(0, 0, 0);
      lists.for_each(i, from, to, [&](std::size_t j, const Vec3& r) {
        const double t = 1 - r.norm() / support_;
        const Vec3 slip(to.vx[j] - from.vx[i], to.vy[j] - from.vy[i], to.vz[j] - from.vz[i]);
        a += rate_ * t * t * t * to.mass[j] * slip;
      });
      from.ax[i] += static_cast<float>(a.x());
      from.ay[i] += static_cast<float>(a.y());
      from.az[i] += static_cast<float>(a.z());
    }
  }

  double rate_, support_;
  std::unique_ptr<CrossLists> lists_[2];
  std::size_t sorts_[2] = {0, 0};
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

Simulation simulation_of(HandMade made, double end_time_s) {
  StopSettings stop;
  stop.end_time_s = end_time_s;
  stop.stop_at_rest = false;
  RunFacts facts;
  for (const MovingSet& set : made.state.sets)
    facts.spacing_m = std::min(facts.spacing_m, set.spacing);
  return Simulation(std::make_unique<SimulationParts>(
      SimulationParts{std::move(made.state), std::move(made.step),
                      PeakMaps({Grid{64, 64, -32, 32, 1, ""}, 0.05}), StopRule(stop), facts}));
}

}  // namespace sturz::test
