// SPDX-License-Identifier: Apache-2.0
/// What the effects of one set's grains share: dense, kinetic and isolated.
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/step.hpp"
#include "engine/neighbors/neighbor_lists.hpp"

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

/// Lists, and the sweep's results in storage order.
struct GrainStress {
  std::size_t set;  ///< index in State::sets
  GrainStressSettings settings;
  NeighborLists lists;
  /// Velocity gradient, density diffusion, density gradient, weight of the image in the ground.
  std::vector<float> results[14];
  std::vector<float> smooth[6];
  std::vector<GroundRecord> ground;  // by record
  std::vector<HalfDensityGradient> density_gradient;
  // Only where grains may disperse:
  std::vector<float>
      dispersed[9];  // support completeness, neighbours, conduction, pair gradient; see SweepOutput
  std::vector<KineticRecord> kinetic;
  std::vector<std::uint8_t> dense_group;
  std::unique_ptr<ListChanges> changes;  // isolated particles, where the scene calls for them
  double smoothing_now = 0;  // zeta of this step's sweep: every smoothing_interval-th, else 0

  GrainStress(std::size_t set_index, const GrainStressSettings& s)
      : set(set_index),
        settings(s),
        lists(2 * s.smoothing_length, s.skin * s.smoothing_length,
              sweeps(s.instruction_set).tight_list) {}

  /// Without accelerations and the walls' mirror weights, which live in the state.
  SweepOutput output() {
    SweepOutput out{};
    float** slots[] = {&out.lxx,
                       &out.lxy,
                       &out.lxz,
                       &out.lyx,
                       &out.lyy,
                       &out.lyz,
                       &out.lzx,
                       &out.lzy,
                       &out.lzz,
                       &out.diffusion,
                       &out.density_gradient[0],
                       &out.density_gradient[1],
                       &out.density_gradient[2],
                       &out.ground_weight};
    for (int k = 0; k < 14; ++k) *slots[k] = results[k].data();
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
