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

/// A parcel's fields as the continuum would have them.
struct GrainFields {
  explicit GrainFields(ParticleSet& p)
      : compression(p.scalar(fields::compression)),
        stress(p.components(fields::stress)),
        state(p.flags(fields::state)),
        alone(p.flags(fields::steps_alone)),
        membership(p.flags(fields::membership)),
        fill(p.scalar(fields::fill)),
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

  std::vector<double>& compression;
  std::vector<std::vector<double>>& stress;
  std::vector<std::uint8_t>&state, &alone, &membership;
  std::vector<double>& fill;
  Field *theta, *kinetic;
};

/// What a parcel finds around it.
struct Surroundings {
  int neighbors = 0;
  double fill = 0;              ///< of its support, 1 inside a dense mass
  double weight = 0, warm = 0;  ///< of the grains among them: sum of weights, and times theta

  double theta() const { return weight > 0 ? warm / weight : 0; }
  bool enough(const GrainStressSettings& g) const {
    return neighbors >= attach_neighbors && fill * g.states->reference_fraction > attach_fraction;
  }
};

/// Looks around every parcel, for grains in the lists and for other parcels.
class Lookout {
 public:
  Lookout(const Domain& domain, const MovingSet& set, const GrainStressSettings& g)
      : domain_(domain),
        set_(set),
        g_(g),
        reach_(2 * g.smoothing_length),
        factor_(SmoothingKernel{g.smoothing_length}.discrete_gradient_factor()),
        volume_(g.spacing * g.spacing * g.spacing),
        around_(set.size() - set.n_listed) {}

  const Surroundings& of(std::size_t parcel) const { return around_[parcel - set_.n_listed]; }

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
  /// Counts those parcels besides that come too. One that stays in flight is in no list: who came
  /// for its sake would be alone there, and leave again. \return who comes, by parcel
  std::vector<char> parcels(ParcelSearch& search) {
    const MovingSet& p = set_;
    std::vector<ParcelSphere> spheres;
    for (std::size_t i = p.n_listed; i < p.size(); ++i)
      spheres.push_back({Vec3(p.x[i], p.y[i], p.z[i]), Vec3(0, 0, 0), 0, p.id[i]});
    const std::vector<NearPair>& pairs = search.find(spheres, reach_, domain_);
    std::vector<char> comes(spheres.size(), 1);
    const std::vector<Surroundings> among_grains = around_;
    for (bool all = false; !all;) {
      around_ = among_grains;
      for (const NearPair& pair : pairs) {
        const double r2 =
            (spheres[pair.a].place - spheres[pair.b].place - pair.image).squaredNorm();
        if (r2 >= reach_ * reach_ || !comes[pair.a] || !comes[pair.b]) continue;
        count(around_[pair.a], r2);
        count(around_[pair.b], r2);
      }
      all = true;
      for (std::size_t k = 0; k < comes.size(); ++k)
        if (comes[k] && !around_[k].enough(g_)) comes[k] = 0, all = false;
    }
    return comes;
  }

 private:
  double count(Surroundings& found, double r2) const {
    const double t = 1 - std::sqrt(r2) / reach_, w = volume_ * t * t * t;
    ++found.neighbors;
    found.fill += factor_ * w * r2 / 3;
    return w;
  }

  const Domain& domain_;
  const MovingSet& set_;
  const GrainStressSettings& g_;
  double reach_, factor_, volume_;
  std::vector<Surroundings> around_;  // by parcel
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
      const double heat = 1.5 * p.mass[i] * f.theta->component[0][i];
      p.ledger.granular -= heat;
      p.ledger.granular_lost += heat;
    }
    f.clear_stress(i);
    f.compression[i] =
        std::fmin(f.compression[i], detach_fraction / g.states->reference_fraction - 1);
    f.set(i, GrainState::ultradilute, Membership::in_flight);
    any = true;
  }
  return any;
}

void attach_landed(MovingSet& p) {
  GrainFields f(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!f.is(i, Membership::landed)) continue;
    f.compression[i] = GrainStressSettings::separation;
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
                 const NeighborLists& lists, ParcelSearch& search) {
  if (p.n_listed == p.size()) return false;
  GrainFields f(p);
  Lookout lookout(domain, p, g);
  lookout.grains(lists, f.theta);
  const std::vector<char> comes = lookout.parcels(search);
  bool any = false;
  for (std::size_t i = p.n_listed; i < p.size(); ++i) {
    if (!comes[i - p.n_listed]) continue;
    const Surroundings& around = lookout.of(i);
    const double reference = g.states->reference_fraction;
    f.fill[i] = around.fill;
    f.compression[i] = std::fmin(around.fill - 1, GrainStressSettings::separation);
    f.set(i, grain_state(reference * (1 + f.compression[i])), Membership::listed);
    if (f.theta) {
      f.theta->component[0][i] = around.theta();
      const double heat = 1.5 * p.mass[i] * around.theta();
      p.ledger.granular += heat;
      p.ledger.granular_lost -= heat;
    }
    any = true;
  }
  return any;
}

}  // namespace sturz
