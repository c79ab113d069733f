// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/terms/lone_parcels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/effects/terms/stored_energy.hpp"
#include "engine/laws/grain_states.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

namespace sturz {
namespace {

/// A parcel's fields as the continuum would have them.
struct GrainFields {
  explicit GrainFields(ParticleSet& p)
      : compression(p.find_field("compression")->component[0]),
        stress(p.find_field("stress")->component),
        state(p.find_field("state")->component[0]),
        alone(p.find_field("steps_alone")->component[0]),
        theta(p.find_field("granular_temperature")),
        kinetic(p.find_field("kinetic_stress")) {}

  void clear_stress(std::size_t i) {
    for (auto& component : stress) component[i] = 0;
    if (!kinetic) return;
    for (auto& component : kinetic->component) component[i] = 0;
    theta->component[0][i] = 0;
  }

  std::vector<double>& compression;
  std::vector<std::vector<double>>& stress;
  std::vector<double>&state, &alone;
  Field *theta, *kinetic;
};

/// What a parcel finds around it.
struct Surroundings {
  int neighbors = 0;
  double fill = 0;   ///< of its support, 1 inside a dense mass
  double theta = 0;  ///< mean of the neighbours
};

Surroundings look_around(const State& s, const GrainStressSettings& g, const NeighborLists& lists,
                         const Field* theta, std::size_t i) {
  const SmoothingKernel smoothing{g.smoothing_length};
  const double factor = smoothing.discrete_gradient_factor(), reach = 2 * g.smoothing_length;
  const double volume = g.spacing * g.spacing * g.spacing;
  Surroundings found;
  double weight = 0, warm = 0;
  lists.for_each_near(s.grains.x[i], s.grains.y[i], s.grains.z[i], [&](std::size_t j, double r2) {
    const double t = 1 - std::sqrt(r2) / reach, w = volume * t * t * t;
    ++found.neighbors;
    found.fill += factor * w * r2 / 3;
    weight += w;
    if (theta && j < s.n_listed) warm += w * theta->component[0][j];
  });
  if (weight > 0) found.theta = warm / weight;
  return found;
}

}  // namespace

bool detach_lone(State& s, const GrainStressSettings& g) {
  GrainFields f(s.grains);
  bool any = false;
  for (std::size_t i = 0; i < s.grains.size(); ++i) {
    if (f.alone[i] < detach_steps || f.alone[i] == in_flight) continue;
    const double stored = stored_energy(g, s.grains, i);
    s.ledger.elastic -= stored;
    s.ledger.lost_energy += stored;
    if (f.theta) {
      const double heat = 1.5 * s.grains.mass[i] * f.theta->component[0][i];
      s.ledger.granular -= heat;
      s.ledger.granular_lost += heat;
    }
    f.clear_stress(i);
    f.compression[i] = std::fmin(f.compression[i],
                                 detach_fraction / g.states->reference_fraction - 1);
    f.state[i] = static_cast<double>(GrainState::ultradilute);
    f.alone[i] = in_flight;
    any = true;
  }
  return any;
}

void put_listed_first(State& s) {
  const auto& alone = s.grains.find_field("steps_alone")->component[0];
  std::vector<std::uint32_t> order, behind;
  order.reserve(alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
    (alone[i] == in_flight ? behind : order).push_back(static_cast<std::uint32_t>(i));
  s.n_listed = order.size();
  if (behind.empty()) return;
  order.insert(order.end(), behind.begin(), behind.end());
  s.grains.permute(order);
}

bool attach_near(State& s, const GrainStressSettings& g, const NeighborLists& lists) {
  GrainFields f(s.grains);
  bool any = false;
  for (std::size_t i = s.n_listed; i < s.grains.size(); ++i) {
    const Surroundings around = look_around(s, g, lists, f.theta, i);
    const double reference = g.states->reference_fraction;
    if (around.neighbors < attach_neighbors || around.fill * reference <= attach_fraction) continue;
    f.compression[i] = std::fmin(around.fill - 1, GrainStressSettings::separation);
    f.state[i] = static_cast<double>(grain_state(reference * (1 + f.compression[i])));
    f.alone[i] = 0;
    if (f.theta) {
      f.theta->component[0][i] = around.theta;
      const double heat = 1.5 * s.grains.mass[i] * around.theta;
      s.ledger.granular += heat;
      s.ledger.granular_lost -= heat;
    }
    any = true;
  }
  return any;
}

}  // namespace sturz
