// SPDX-License-Identifier: Apache-2.0
/// The engine's pair sweep by itself, on the lists of a moving member.
#pragma once

#include "engine/neighbors/neighbor_lists.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/scene_plan.hpp"

#include <array>
#include <vector>

namespace sturz::bench {

/// Useful operations of DenseSums::add per directed pair within 2h (a fused multiply-add counts
/// two, every other operation and each integer difference one): differences 3, r^2 5, t 4, weight
/// 3, d 3, velocity difference 3, velocity gradient 18, moment matrix 12, G 3, u.r 5, viscosity 3,
/// force 21, density diffusion 15. What follows the loop, once per particle, is not counted.
inline constexpr double flops_per_pair = 3 + 5 + 4 + 3 + 3 + 3 + 18 + 12 + 3 + 5 + 3 + 21 + 15;

class SweepAlone {
 public:
  /// Copies the particles and makes lists and records of its own, without walls.
  SweepAlone(const SimulationParts&, const ScenePlan&, InstructionSet);

  /// One sweep without stress smoothing. \return thread seconds
  double run();
  std::size_t n_particles() const { return set_.size(); }
  std::size_t n_entries() const { return lists_.n_entries(); }
  /// Entries of a group's list, one of which serves 16 particles.
  double entries_per_group() const {
    return static_cast<double>(n_entries()) / static_cast<double>(lists_.n_groups());
  }
  /// Directed pairs within 2h, a particle with itself left out.
  std::size_t n_pairs() const { return n_pairs_; }

 private:
  void gather_records(const GrainStressSettings&);
  std::size_t count_pairs() const;
  SweepOutput output();

  InstructionSet set_of_instructions_;
  ParticleSet set_;
  NeighborLists lists_;
  SweepConstants constants_;
  std::array<std::vector<float>, 23> results_;
  std::vector<float> zeros_;
  std::vector<GroundRecord> far_;
  std::vector<HalfDensityGradient> density_gradient_;
  std::size_t n_pairs_ = 0;
};

}  // namespace sturz::bench
