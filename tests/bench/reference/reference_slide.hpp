// SPDX-License-Identifier: Apache-2.0
/// A hand-written minimal step of the dense slide, against which the engine's step is measured.
#pragma once

#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "tests/bench/reference/reference_list.hpp"
#include "tests/bench/reference/reference_pass.hpp"

#include <vector>

namespace sturz::bench {

/// Starts from the same particles as the engine's member and moves them by loops over plain
/// columns in float: sort and lists when the skin is used up, one pass over the lists, one over
/// the particles, ground, drift. See reference_pass.hpp for what it leaves out.
class ReferenceSlide {
 public:
  ReferenceSlide(const SimulationParts&, const ScenePlan&);

  void step(double dt);
  /// Which compilation of the loops was the faster one here.
  const char* variant() const { return pass_->name; }
  std::size_t size() const { return mass_.size(); }
  std::size_t n_rebuilds() const { return n_rebuilds_; }
  double neighbors_per_particle() const {
    return static_cast<double>(neighbors_.begin().back()) / static_cast<double>(size());
  }
  double bytes_per_particle() const;
  /// Mean velocity of the mass down the map's x axis [m/s], to see that both do the same.
  double mean_vx() const;

 private:
  void rebuild();
  void choose_pass();
  std::vector<std::vector<float>*> carried();
  ReferenceColumns columns();
  ReferenceList list() const {
    return {records_.data(), neighbors_.begin().data(), neighbors_.offsets().data()};
  }

  const ReferencePass* pass_ = &reference_gathers;
  ReferenceNumbers numbers_{};
  ReferenceGround ground_{};
  std::vector<float> nodes_;
  ReferenceNeighbors neighbors_;
  float skin_, moved_;
  std::size_t n_rebuilds_ = 0;
  std::vector<float> x_, y_, z_, vx_, vy_, vz_, mass_, density_change_, ax_, ay_, az_;
  std::vector<float> stress_[6], gradient_[9], records_, scratch_;
};

}  // namespace sturz::bench
