// SPDX-License-Identifier: Apache-2.0
// Buoyancy and drag as impulses, and what they cost.
#include "engine/core/parallel.hpp"
#include "engine/effects/coupling/drag_batch.hpp"
#include "engine/effects/coupling/shared.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/drag.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using Components = std::vector<std::vector<double>>;

Vec3 at(const Components& v, std::size_t i) { return {v[0][i], v[1][i], v[2][i]}; }
Vec3 velocity(const ParticleSet& p, std::size_t i) { return {p.vx[i], p.vy[i], p.vz[i]}; }
constexpr std::size_t rows = DragBatch::capacity;  // of a range of threads' work

/// The liquid around a grain, means with the weights b_ij.
struct Surroundings {
  Vec3 before{0, 0, 0}, now{0, 0, 0};  ///< velocities [m/s]
  Vec3 push{0, 0, 0};                  ///< kappa rho a: stress divergence [Pa/m]
  double pores = 1, saturation = 1;
};

/// A grain takes its share of what pushes the liquid, and both drag each other.
class ExchangePass final : public Pass {
 public:
  explicit ExchangePass(std::shared_ptr<Coupling> shared) : shared_(std::move(shared)) {
    law_.diameter = shared_->settings.drag_diameter;
    law_.density = shared_->settings.liquid_density;
    law_.viscosity = shared_->settings.viscosity;
  }
  std::string_view name() const override { return "buoyancy and drag"; }
  std::string_view effect() const override { return EffectName::coupling; }
  Stage stage() const override { return Stage::contact; }

  void apply(State& s, double dt) override {
    const double kick = s.n_steps == 0 ? 0.5 * dt : dt;
    look_at_liquid(s, kick);
    move_grains(s, kick);
    move_liquid(s);
  }

 private:
  void look_at_liquid(const State& s, double kick) {
    Coupling& c = *shared_;
    const MovingSet& p = s.sets[c.liquid];
    const Components& before = p.components(fields::velocity_before);
    const Field* change = p.find(fields::density_change);
    const Vec3 gravity(0, 0, -s.gravity);
    parallel_ranges(c.take.size(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t j = c.of_liquid().index(r);
        const double q = c.take[r], x = c.share[r];
        const double kept = std::min(x, CouplingSettings::largest_share);
        const double relative = relative_density(change, j);
        const double kappa = x > 0 ? kept / x : 1;
        const Vec3 now = velocity(p, j), a = (now - at(before, j)) / kick - gravity;
        const Vec3 push = q * kappa * c.settings.liquid_density * relative * a, v = q * now;
        c.held[r] = kick * (a - Vec3(p.ax[j], p.ay[j], p.az[j]));
        c.liquid_now[r].quad[0] = Quad{v.x(), v.y(), v.z(), q / (1 + kept)};
        c.liquid_now[r].quad[1] = Quad{push.x(), push.y(), push.z(), q * std::min(1.0, relative)};
      }
    });
    c.of_liquid().copy_images(c.liquid_now);
  }

  /// What the ground's images will push a grain off with [m/s^2]. Its contact follows the drag, for
  /// friction has the last word; but grains that seem to fall through the bed until then would drag
  /// the liquid along, and a film of it would grow under them.
  Vec3 ground_push(const MovingSet& p, std::size_t i) const {
    const BoundarySupport& b = p.boundary;
    if (i >= b.from_ground[0].size() || i >= b.distance.size()) return Vec3::Zero();
    // Beyond the support the sweep writes nothing: another particle's push stands there.
    const double support = 2 * shared_->settings.smoothing_length;
    if (p.fate[i] != Fate::stays || b.distance[i] >= static_cast<float>(support))
      return Vec3::Zero();
    const Vec3 n(b.nx[i], b.ny[i], b.nz[i]);
    const Vec3 push(b.from_ground[0][i], b.from_ground[1][i], b.from_ground[2][i]);
    return std::max(0.0, push.dot(n)) * n;
  }

  Surroundings surroundings(std::size_t row) const {
    const Coupling& c = *shared_;
    const PairSide::Pairs pairs = c.of_grains().pairs(row);
    Quads<2> sum = gather(pairs, pairs.weight, c.liquid_now);
    turn_images(c.of_grains(), row, c.liquid_now, {0}, sum);  // the push goes on beyond the ground
    const double inverse = 1 / c.met[row].met;
    return {c.met[row].velocity, inverse * sum.vector(0), inverse * sum.vector(4), inverse * sum[3],
            inverse * sum[7]};
  }

  void move_grains(State& s, double kick) {
    Coupling& c = *shared_;
    MovingSet& p = s.sets[c.grains];
    const Components& before = p.components(fields::velocity_before);
    Components& exchange = p.components(fields::exchange_velocity);
    parallel_ranges(c.met.size(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      DragBatch batch(law_);
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t i = c.of_grains().index(r);
        c.lift[r] = c.drag[r] = Vec3::Zero();
        c.impulse[r] = {};
        if (c.met[r].met > 0 && !(p.any_leaving && s.leaves(p, i)))
          lift(r, p.mass[i], at(before, i), velocity(p, i) + kick * ground_push(p, i), kick, batch);
      }
      batch.relax();
      for (std::size_t k = 0; k < batch.size(); ++k) {
        const std::size_t r = batch.row(k);
        const Vec3 impulse = batch.impulse(k), given = impulse / c.met[r].met;
        c.drag[r] = impulse / p.mass[c.of_grains().index(r)];
        c.impulse[r].quad[0] = Quad{given.x(), given.y(), given.z(), 0};
      }
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t i = c.of_grains().index(r);
        const Vec3 gained = c.lift[r] + c.drag[r];
        if (!c.walled.empty()) {
          const Vec3 kicked = kick * Vec3(p.ax[i], p.ay[i], p.az[i] - s.gravity);
          c.walled[r] = velocity(p, i) - at(before, i) - kicked;
        }
        exchange[0][i] = gained.x();
        exchange[1][i] = gained.y();
        exchange[2][i] = gained.z();
        p.vx[i] += gained.x(), p.vy[i] += gained.y(), p.vz[i] += gained.z();
      }
    });
    c.of_grains().copy_images(c.impulse);
  }

  /// A grain's share of the push, and what its drag starts from.
  void lift(std::size_t row, double mass, const Vec3& before, const Vec3& now, double kick,
            DragBatch& batch) {
    Coupling& c = *shared_;
    const MetLiquid& met = c.met[row];
    const Surroundings liquid = surroundings(row);
    if (c.settings.buoyancy) c.lift[row] = met.wet * kick / c.settings.grain_density * liquid.push;
    const double other = met.volume * met.met, reduced = mass * other / (mass + other);
    const double force = kick * met.wet * liquid.saturation * c.settings.drag_multiplier * mass /
                         (c.settings.grain_density * reduced);
    batch.add(static_cast<std::uint32_t>(row), before - liquid.before,
              now + c.lift[row] - liquid.now, 1 - liquid.pores, reduced, force);
  }

  void move_liquid(State& s) {
    Coupling& c = *shared_;
    MovingSet& p = s.sets[c.liquid];
    const PairSide& side = c.of_liquid();
    parallel_ranges(side.n_rows(), rows, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t j = side.index(r);
        const PairSide::Pairs pairs = side.pairs(r);
        Quads<1> sum = gather(pairs, pairs.weight, c.impulse);
        turn_images(side, r, c.impulse, {0}, sum);
        const Vec3 v = -c.take[r] / p.mass[j] * sum.vector(0);
        c.drawn[r] = v;
        p.vx[j] += v.x(), p.vy[j] += v.y(), p.vz[j] += v.z();
      }
    });
  }

  std::shared_ptr<Coupling> shared_;
  GranularDrag law_;
};

/// Works with the mean velocity of the step, as all works are taken; of those that leave, whose
/// energy is that of the step's start, none. A film's friction that the drag changes counts as
/// contact.
class ExchangeAccounts final : public Pass {
 public:
  explicit ExchangeAccounts(std::shared_ptr<Coupling> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "accounts of buoyancy and drag"; }
  std::string_view effect() const override { return EffectName::coupling; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    const Coupling& c = *shared_;
    MovingSet &grains = s.sets[c.grains], &liquid = s.sets[c.liquid];
    const auto mean = [](const MovingSet& p) {
      const Components& before = p.components(fields::velocity_before);
      return [&](std::uint32_t i, std::size_t) -> Vec3 {
        return 0.5 * (at(before, i) + velocity(p, i));
      };
    };
    grains.ledger.exchange_work += work(s, grains, c.of_grains(), c.lift, mean(grains));
    grains.ledger.drag_loss -= work(s, grains, c.of_grains(), c.drag, mean(grains));
    liquid.ledger.drag_loss -= work(s, liquid, c.of_liquid(), c.drawn, mean(liquid));
    // What ground and walls did before the drag was taken with the velocity that they left.
    liquid.ledger.contact_work +=
        work(s, liquid, c.of_liquid(), c.held, [&](std::uint32_t j, std::size_t r) -> Vec3 {
          return 0.5 * (velocity(liquid, j) - c.liquid_now[r].vector(0) / c.take[r]);
        });
    if (!c.walled.empty())
      grains.ledger.contact_work +=
          work(s, grains, c.of_grains(), c.walled,
               [&](std::uint32_t, std::size_t r) -> Vec3 { return 0.5 * (c.lift[r] + c.drag[r]); });
  }

 private:
  /// Sum of m change.speed. \param speed  of particle i in row r [m/s]
  template <class Speed>
  static double work(const State& s, const MovingSet& p, const PairSide& side,
                     const std::vector<Vec3>& change, Speed&& speed) {
    return ordered_reduce(
        side.n_rows(), s.threads, 0.0,
        [&](std::size_t begin, std::size_t end, double& sum) {
          for (std::size_t r = begin; r < end; ++r) {
            const std::uint32_t i = side.index(r);
            if (p.any_leaving && s.leaves(p, i)) continue;
            sum += p.mass[i] * change[r].dot(speed(i, r));
          }
        },
        [](double& total, double block) { total += block; });
  }

  std::shared_ptr<Coupling> shared_;
};

}  // namespace

void add_exchange(Step& step, const std::shared_ptr<Coupling>& shared) {
  step.add(std::make_unique<ExchangePass>(shared));
  step.add(std::make_unique<ExchangeAccounts>(shared));
}

}  // namespace sturz
