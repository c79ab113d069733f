// SPDX-License-Identifier: Apache-2.0
/// What the passes of erosion share.
#pragma once

#include "engine/core/sum.hpp"
#include "engine/effects/erosion/settings.hpp"
#include "engine/effects/state.hpp"
#include "engine/effects/step.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace sturz {

struct Erosion {
  std::size_t set;  ///< index in State::sets
  ErosionSettings settings;
  std::vector<double>
      gained;  ///< mass that each column takes up in this step, half of it twice [kg]

  Sum entrained;  ///< of the run so far [kg]

  Erosion(std::size_t set_index, ErosionSettings s) : set(set_index), settings(std::move(s)) {}
};

/// What a column would take in a step, and of which square of the map.
struct Appetite {
  double mass = 0;        ///< [kg]
  double most_depth = 0;  ///< of a place in all, vertical [m]
  double x = 0, y = 0;    ///< centre [m]
  double side = 0;        ///< [m]
  bool none() const { return !(mass > 0); }
};

/// Half of what each column takes up enters it: its momentum stays. In the ledger the mass, and
/// what the mixing takes of the kinetic energy. \param keeps_works the works of this step are yet
/// to be summed up with the velocity before it, which is to be that of the mixture then
void mix_half(const State&, MovingSet&, Erosion&, bool keeps_works);

/// Room for what entrained mass takes off the travel of new columns.
void begin_lags(MovingSet&);

void add_taking(Step&, const std::shared_ptr<Erosion>&);  ///< and the first half
void add_mixing(Step&, const std::shared_ptr<Erosion>&);  ///< the second half

}  // namespace sturz
