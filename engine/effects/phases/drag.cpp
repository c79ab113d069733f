// SPDX-License-Identifier: Apache-2.0
// Drag between grains and liquid, as impulses before the bed acts, and what it costs.
#include "engine/core/parallel.hpp"
#include "engine/effects/phases/nodes.hpp"
#include "engine/effects/phases/shared.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr std::size_t grains = 0, liquid = 1;

/// Distance of nodes over the spacing at release: where columns lie twice as far apart a node still
/// has nine of each set.
constexpr double node_distance = 2;

class DragPass final : public Pass {
 public:
  explicit DragPass(std::shared_ptr<TwoPhases> both) : both_(std::move(both)) {}
  std::string_view name() const override { return "drag between phases"; }
  std::string_view effect() const override { return EffectName::phase_drag; }
  Stage stage() const override { return Stage::kick; }

  void apply(State& s, double dt) override {
    for (std::size_t set : {grains, liquid})
      sturz::forecast(s, s.sets[set], *both_->flow[set], dt, both_->forecast[set]);
    nodes_.clear(s.sets[grains], s.sets[liquid], s.domain,
                 node_distance * both_->settings.grains.spacing);
    for (std::size_t set : {grains, liquid}) spread(s, set);
    meet(s, kick_interval(s, dt));
    for (std::size_t set : {grains, liquid}) push(s, set);
  }
  void warnings(const State& s, std::vector<std::string>& out) const override {
    const Ledger all = s.ledger();
    const double share = s.time > 0 ? all.drag_raised / (all.brought_mass() * s.time) : 0;
    if (!(share > most_raised)) return;
    out.push_back("two phases: for " + std::to_string(std::lround(100 * share)) +
                  " % of mass and time (drag_raised_fraction) drag was raised, because grains and "
                  "liquid so far apart in speed have no solution: they stay closer together than "
                  "their drag alone would have them");
  }
  std::size_t bytes() const override { return nodes_.bytes(); }

 private:
  using Change = Eigen::Array<double, 4, 1>;
  static constexpr double most_raised = 0.01;

  /// In storage order on one thread: the same sums at any number of threads.
  void spread(const State& s, std::size_t set) {
    const MovingSet& p = s.sets[set];
    const ColumnForecast& f = both_->forecast[set];
    const std::vector<double>& wave2 = both_->across[set].wave2;
    for (std::size_t i = 0; i < p.size(); ++i) {
      NodeSums column;
      column.values << (s.leaves(p, i) ? 0 : p.mass[i]), p.vx[i], p.vy[i], p.vz[i], f.vx[i],
          f.vy[i], f.vz[i], (set == grains ? f.spare[i] : wave2[i]);
      nodes_.add(set, p.x[i], p.y[i], column);
    }
  }

  void meet(State& s, double dt) {
    for (auto& change : nodes_.change) change.assign(nodes_.size(), Change::Zero());
    const double raised = ordered_reduce(
        nodes_.size(), s.threads, 0.0,
        [&](std::size_t begin, std::size_t end, double& sum) {
          for (std::size_t node = begin; node < end; ++node) sum += meet_at(s, node, dt);
        },
        [](double& total, double block) { total += block; });
    s.sets[grains].ledger.drag_raised += raised * dt;
  }

  /// \return mass whose drag was raised [kg]
  double meet_at(const State& s, std::size_t node, double dt) {
    const NodeSums &g = nodes_.sums(grains, node), &l = nodes_.sums(liquid, node);
    if (!(g.mass() > 0 && l.mass() > 0)) return 0;
    const PhaseDrag& law = both_->settings.drag;
    const double solids = g.mass() / law.solid_density, fluid = l.mass() / law.fluid_density;
    const double share = solids / (solids + fluid);
    SlippingPair pair;
    pair.grains = g.mass(), pair.liquid = l.mass();
    pair.slip_before = g.before() / g.mass() - l.before() / l.mass();
    pair.slip = g.after() / g.mass() - l.after() / l.mass();
    pair.spare = g.other();
    pair.rate = law.rate(share, s.gravity);
    pair.largest_slip = law.largest_slip(share, l.other() / l.mass());
    const DragImpulse impulse = drag_impulse(pair, dt);
    const Vec3& j = impulse.on_liquid;
    const Change whole(j.x(), j.y(), j.z(), 0);
    nodes_.change[grains][node] = -whole / g.mass();
    nodes_.change[liquid][node] = whole / l.mass();
    return impulse.raised ? g.mass() + l.mass() : 0;
  }

  /// The ground takes what points out of its plane.
  void push(State& s, std::size_t set) {
    MovingSet& p = s.sets[set];
    const GroundColumns ground(p);
    auto &x = both_->push_x[set], &y = both_->push_y[set], &z = both_->push_z[set];
    for (auto* a : {&x, &y, &z}) a->resize(p.size());
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        x[i] = y[i] = z[i] = 0;
        if (s.leaves(p, i)) continue;
        const Vec3 change = nodes_.change_of(set, i);
        const Velocity along = Velocity{change.x(), change.y(), change.z()}.in_plane(
            ground.component[0][i], ground.component[1][i]);
        x[i] = along.x, y[i] = along.y, z[i] = along.z;
        p.vx[i] += along.x, p.vy[i] += along.y, p.vz[i] += along.z;
      }
    });
  }

  std::shared_ptr<TwoPhases> both_;
  DragNodes nodes_;
};

/// Works of the drag with the mean velocity of the step, as all works are taken.
class DragAccounts final : public Pass {
 public:
  explicit DragAccounts(std::shared_ptr<TwoPhases> both) : both_(std::move(both)) {}
  std::string_view name() const override { return "accounts of the drag"; }
  std::string_view effect() const override { return EffectName::phase_drag; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    for (std::size_t set : {grains, liquid}) {
      MovingSet& p = s.sets[set];
      const auto& before = p.components(fields::velocity_before);
      const auto &x = both_->push_x[set], &y = both_->push_y[set], &z = both_->push_z[set];
      p.ledger.drag_loss -= ordered_reduce(
          p.size(), s.threads, 0.0,
          [&](std::size_t begin, std::size_t end, double& sum) {
            for (std::size_t i = begin; i < end; ++i)
              sum += 0.5 * p.mass[i] *
                     (x[i] * (before[0][i] + p.vx[i]) + y[i] * (before[1][i] + p.vy[i]) +
                      z[i] * (before[2][i] + p.vz[i]));
          },
          [](double& total, double block) { total += block; });
    }
  }

 private:
  std::shared_ptr<TwoPhases> both_;
};

}  // namespace

void add_phase_drag(Step& step, const std::shared_ptr<TwoPhases>& both) {
  step.add(std::make_unique<DragPass>(both));
  step.add(std::make_unique<DragAccounts>(both));
}

}  // namespace sturz
