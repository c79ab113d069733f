// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/isolated/flight.hpp"

#include "engine/effects/dense/stored_energy.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/grain_states.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

using fields::Membership;

/// The fields of an isolated particle, as grains of the continuum have them.
struct GrainFields {
  explicit GrainFields(ParticleSet& p)
      : density_change(p.scalar(fields::density_change)),
        stress(p.components(fields::stress)),
        state(p.flags(fields::state)),
        alone(p.flags(fields::steps_alone)),
        membership(p.flags(fields::membership)),
        support_completeness(p.scalar(fields::support_completeness)),
        theta(p.find(fields::granular_temperature)),
        kinetic(p.find(fields::kinetic_stress)) {}

  void set(std::size_t i, GrainState name, Membership member) {
    state[i] = static_cast<std::uint8_t>(name);
    membership[i] = static_cast<std::uint8_t>(member);
    alone[i] = 0;
  }
  bool is(std::size_t i, Membership member) const {
    return membership[i] == static_cast<std::uint8_t>(member);
  }
  void clear_stress(std::size_t i) {
    for (auto& component : stress) component[i] = 0;
    if (!kinetic) return;
    for (auto& component : kinetic->component) component[i] = 0;
    theta->component[0][i] = 0;
  }

  std::vector<double>& density_change;
  std::vector<std::vector<double>>& stress;
  std::vector<std::uint8_t>&state, &alone, &membership;
  std::vector<double>& support_completeness;
  Field *theta, *kinetic;
};

/// The neighbourhood of an isolated particle.
struct Surroundings {
  int neighbors = 0;
  double support_completeness = 0;  ///< 1 inside a dense mass
  double weight = 0, warm = 0;      ///< of the grains among them: sum of weights, and times theta

  double theta() const { return weight > 0 ? warm / weight : 0; }
  bool enough(const GrainStressSettings& g) const {
    return neighbors >= attach_neighbors &&
           support_completeness * g.states->reference_fraction > attach_fraction;
  }
};

/// Surveys the neighbourhood of every isolated particle: listed grains and other isolated
/// particles.
class NeighborhoodSurvey {
 public:
  NeighborhoodSurvey(const Domain& domain, const MovingSet& set, const GrainStressSettings& g)
      : domain_(domain),
        set_(set),
        g_(g),
        support_radius_(2 * g.smoothing_length),
        factor_(SmoothingKernel{g.smoothing_length}.discrete_gradient_factor()),
        volume_(g.spacing * g.spacing * g.spacing),
        around_(set.size() - set.n_listed) {}

  const Surroundings& of(std::size_t particle) const { return around_[particle - set_.n_listed]; }

  void grains(const NeighborLists& lists, const Field* theta) {
    const MovingSet& p = set_;
    for (std::size_t i = p.n_listed; i < p.size(); ++i)
      lists.for_each_near(p.x[i], p.y[i], p.z[i], [&](std::size_t j, double r2) {
        Surroundings& found = around_[i - p.n_listed];
        const double w = count(found, r2);
        if (!theta || j >= p.n_listed) return;  // an image stands for a grain counted elsewhere
        found.weight += w;
        found.warm += w * theta->component[0][j];
      });
  }
  /// Also counts isolated particles that rejoin at the same time. One that stays in flight is in no
  /// list: a particle that rejoined because of it would be alone there, and leave again.
  /// \return whether each isolated particle rejoins
  std::vector<char> rejoining(IsolatedSearch& search) {
    const MovingSet& p = set_;
    std::vector<IsolatedSphere> spheres;
    for (std::size_t i = p.n_listed; i < p.size(); ++i)
      spheres.push_back({Vec3(p.x[i], p.y[i], p.z[i]), Vec3(0, 0, 0), 0, p.id[i]});
    const std::vector<NearPair>& pairs = search.find(spheres, support_radius_, domain_);
    std::vector<char> rejoins(spheres.size(), 1);
    const std::vector<Surroundings> among_grains = around_;
    for (bool all = false; !all;) {
      around_ = among_grains;
      for (const NearPair& pair : pairs) {
        const double r2 =
            (spheres[pair.a].position - spheres[pair.b].position - pair.image).squaredNorm();
        if (r2 >= support_radius_ * support_radius_ || !rejoins[pair.a] || !rejoins[pair.b])
          continue;
        count(around_[pair.a], r2);
        count(around_[pair.b], r2);
      }
      all = true;
      for (std::size_t k = 0; k < rejoins.size(); ++k)
        if (rejoins[k] && !around_[k].enough(g_)) rejoins[k] = 0, all = false;
    }
    return rejoins;
  }

 private:
  double count(Surroundings& found, double r2) const {
    const double t = 1 - std::sqrt(r2) / support_radius_, w = volume_ * t * t * t;
    ++found.neighbors;
    found.support_completeness += factor_ * w * r2 / 3;
    return w;
  }

  const Domain& domain_;
  const MovingSet& set_;
  const GrainStressSettings& g_;
  double support_radius_, factor_, volume_;
  std::vector<Surroundings> around_;  // by isolated particle
};

}  // namespace

bool detach_isolated(MovingSet& p, const GrainStressSettings& g) {
  GrainFields f(p);
  bool any = false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (f.alone[i] != detach_steps) continue;
    const double stored = stored_energy(g, p, i);
    p.ledger.elastic -= stored;
    p.ledger.lost_energy += stored;
    if (f.theta) {
      const double granular_energy = 1.5 * p.mass[i] * f.theta->component[0][i];
      p.ledger.granular -= granular_energy;
      p.ledger.granular_lost += granular_energy;
    }
    f.clear_stress(i);
    f.density_change[i] =
        std::fmin(f.density_change[i], detach_fraction / g.states->reference_fraction - 1);
    f.set(i, GrainState::ultradilute, Membership::in_flight);
    any = true;
  }
  return any;
}

void attach_landed(MovingSet& p) {
  GrainFields f(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!f.is(i, Membership::landed)) continue;
    f.density_change[i] = GrainStressSettings::separation_threshold;
    f.set(i, GrainState::dense, Membership::listed);
  }
}

void put_listed_first(MovingSet& p) {
  const auto& membership = p.flags(fields::membership);
  const auto in_flight = static_cast<std::uint8_t>(Membership::in_flight);
  std::vector<std::uint32_t> order, behind;
  order.reserve(membership.size());
  for (std::size_t i = 0; i < membership.size(); ++i)
    (membership[i] == in_flight ? behind : order).push_back(static_cast<std::uint32_t>(i));
  p.n_listed = order.size();
  if (behind.empty()) return;
  order.insert(order.end(), behind.begin(), behind.end());
  p.permute(order);
}

bool attach_near(const Domain& domain, MovingSet& p, const GrainStressSettings& g,
                 const NeighborLists& lists, IsolatedSearch& search) {
  if (p.n_listed == p.size()) return false;
  GrainFields f(p);
  NeighborhoodSurvey survey(domain, p, g);
  survey.grains(lists, f.theta);
  const std::vector<char> rejoins = survey.rejoining(search);
  bool any = false;
  for (std::size_t i = p.n_listed; i < p.size(); ++i) {
    if (!rejoins[i - p.n_listed]) continue;
    const Surroundings& around = survey.of(i);
    const double reference = g.states->reference_fraction;
    f.support_completeness[i] = around.support_completeness;
    f.density_change[i] =
        std::fmin(around.support_completeness - 1, GrainStressSettings::separation_threshold);
    f.set(i, grain_state(reference * (1 + f.density_change[i])), Membership::listed);
    if (f.theta) {
      f.theta->component[0][i] = around.theta();
      const double granular_energy = 1.5 * p.mass[i] * around.theta();
      p.ledger.granular += granular_energy;
      p.ledger.granular_lost -= granular_energy;
    }
    any = true;
  }
  return any;
}

}  // namespace sturz
