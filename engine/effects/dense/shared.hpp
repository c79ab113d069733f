// SPDX-License-Identifier: Apache-2.0
/// What the effects of one set's grains share: dense, kinetic and isolated.
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/dense/sweep_arrays.hpp"
#include "engine/effects/step.hpp"

#include <memory>
#include <vector>

namespace sturz {

/// Changes of which particles belong to the continuum, made when neighbours are sorted. A scene in
/// which all grains always do has none.
class ListChanges {
 public:
  virtual ~ListChanges() = default;
  /// Puts the grains of the continuum first in storage and sets MovingSet::n_listed.
  virtual void before_sorting(MovingSet&) = 0;
  /// With fresh lists. \return whether a particle rejoined, so that the lists must be made again
  virtual bool after_sorting(const Domain&, MovingSet&, const NeighborLists&) = 0;
};

/// What the pair sweep of grains needs and leaves.
struct GrainStress : SweepArrays {
  GrainStressSettings settings;
  std::vector<float> smooth[6];
  // Only where grains may disperse:
  std::vector<float>
      dispersed[9];  // support completeness, neighbours, conduction, pair gradient; see SweepOutput
  std::vector<KineticRecord> kinetic;
  std::vector<std::uint8_t> dense_group;
  std::unique_ptr<ListChanges> changes;  // isolated particles, where the scene calls for them
  double smoothing_now = 0;  // zeta of this step's sweep: every smoothing_interval-th, else 0

  GrainStress(std::size_t set_index, const GrainStressSettings& s)
      : SweepArrays(set_index, s.smoothing_length, s.skin, s.instruction_set), settings(s) {}

  /// Without accelerations and the walls' mirror weights, which live in the state.
  SweepOutput output() {
    SweepOutput out = SweepArrays::output();
    for (int k = 0; k < 6; ++k) out.smooth[k] = smooth[k].data();
    out.support_completeness = dispersed[0].data(), out.neighbors = dispersed[1].data(),
    out.conducted = dispersed[2].data();
    for (int k = 0; k < 6; ++k) out.pair_gradient[k] = dispersed[3 + k].data();
    return out;
  }
};

/// What the passes that only grains in flight call for count to.
inline std::string_view dispersed_effect(const GrainStressSettings& g) {
  return g.states->dilute ? EffectName::kinetic_theory : EffectName::states;
}

/// c0 of a mass that starts with the velocities it has, where it follows the flow [m/s].
double sound_speed_at_start(const ParticleSet&, const GrainStressSettings&);
/// Lets c0 follow the flow, see sound_speed.cpp. \param planned  c0 of the whole descent [m/s]
void add_sound_speed(Step&, const std::shared_ptr<GrainStress>&, double planned);

}  // namespace sturz
