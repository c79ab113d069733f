// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/isolated/effect.hpp"

#include "engine/core/parallel.hpp"
#include "engine/effects/dense/shared.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/isolated/flight.hpp"
#include "engine/effects/isolated/search.hpp"
#include "engine/laws/grain_states.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using fields::Membership;

/// Which particles leave the continuum and which rejoin it, whenever neighbours are sorted.
class Flight final : public ListChanges {
 public:
  explicit Flight(const GrainStressSettings& settings) : settings_(settings) {}

  void before_sorting(MovingSet& p) override {
    attach_landed(p);
    detach_isolated(p, settings_);
    put_listed_first(p);
  }
  bool after_sorting(const Domain& domain, MovingSet& p, const NeighborLists& lists) override {
    if (!attach_near(domain, p, settings_, lists, search_)) return false;
    put_listed_first(p);
    return true;
  }

 private:
  const GrainStressSettings& settings_;  // of the grain stress that owns this
  IsolatedSearch search_;
};

/// Counts for how long every grain has been alone, and marks those that have landed.
class IsolationPass final : public Pass {
 public:
  explicit IsolationPass(std::shared_ptr<GrainStress> shared) : shared_(std::move(shared)) {}
  std::string_view name() const override { return "isolation"; }
  std::string_view effect() const override { return EffectName::isolated; }
  Stage stage() const override { return Stage::stress; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[shared_->set];
    const double reference = shared_->settings.states->reference_fraction;
    const double touching = shared_->settings.touching_distance();
    const SweepOutput out = shared_->output();
    const auto& density_change = p.scalar(fields::density_change);
    auto& alone = p.flags(fields::steps_alone);
    parallel_ranges(
        p.n_listed, reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const double fraction = reference * (1 + density_change[i]);
            const bool few = fraction < detach_fraction || out.neighbors[i] < detach_neighbors;
            const bool isolated = few && p.boundary.distance[i] >= touching;
            alone[i] =
                isolated ? static_cast<std::uint8_t>(std::min(alone[i] + 1, detach_steps)) : 0;
          }
        });
    land(p, s.gravity, touching);
  }

 private:
  /// An isolated particle that lies on the ground and does not bounce any more has landed.
  void land(MovingSet& p, double gravity, double touching) const {
    const BoundarySupport& b = p.boundary;
    auto& membership = p.flags(fields::membership);
    const double landing_speed = 0.1 * std::sqrt(gravity * shared_->settings.spacing);
    for (std::size_t i = p.n_listed; i < p.size(); ++i) {
      const double vn = p.vx[i] * b.nx[i] + p.vy[i] * b.ny[i] + p.vz[i] * b.nz[i];
      if (b.distance[i] < touching && std::abs(vn) < landing_speed)
        membership[i] = static_cast<std::uint8_t>(Membership::landed);
    }
  }

  std::shared_ptr<GrainStress> shared_;
};

}  // namespace

void add_isolated_particles(Step& step, State& state, const std::shared_ptr<GrainStress>& shared) {
  MovingSet& p = state.sets[shared->set];
  p.add(fields::steps_alone);
  p.add(fields::membership);
  shared->changes = std::make_unique<Flight>(shared->settings);
  step.add(std::make_unique<IsolationPass>(shared));
}

}  // namespace sturz
