// SPDX-License-Identifier: Apache-2.0
/// What members of a scene take, found by computing a few of them, coarser where they are long.
///
/// Steps until rest, the way the mass takes and with it the cells of the maps hang on the ground
/// and on what was drawn; no formula knows them within a factor of two (docs/studies/forecasts.md).
/// A coarser twin does: `coarser` times the spacing and the maps' cell, 1/coarser^3 of the columns'
/// work and 1/coarser^4 of the particles'.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One member as it will be at the scene's own spacing.
struct TriedMember {
  double cpu_s = 0;  ///< building it, its steps, writing its file
  double steps = 0;
  double touched_cells = 0;  ///< cells of the scene's maps that it reaches
  Window window;             ///< around them, in the scene's hazard grid
  double file_bytes = 0;
  /// It was cut off: all of the above is of a part, and of its time limit it may take up to so many
  /// times that part; 1 where it came to its end.
  double longer = 1;
};

struct Trial {
  std::optional<TriedMember> median;  ///< nothing: it cannot be tried, or not in the time given
  std::vector<TriedMember> members;   ///< some of the design, [n_tried]
  double coarser = 1;                 ///< largest spacing tried / the scene's
  /// Factor between what the first, coarser look at the median promised for the second and what
  /// that took; 1 where there was one look.
  double surprise = 1;
  double cpu_s = 0;     ///< spent on all of it
  double slowdown = 1;  ///< elapsed time over computing time: what others take of the cores
  std::string failure;  ///< why nothing could be tried, where it is not the time
};

/// How much may be tried.
struct TrialLimits {
  int workers = 1;      ///< members at a time, as the ensemble will have them
  double budget_s = 1;  ///< computing time, about
  CancelFlag cancel = {};
  double longest_s = 2;  ///< of computing time that a member may take, whatever was thought before
};

/// Computes the medians and, with a design, up to two dozen of its members: `workers` at a time,
/// because cores that share their units or memory are slower together. A member that takes too long
/// is cut off and counts as far as it came: left out it would make the others look like all.
/// \param design null: the median only \throws Cancelled
Trial try_members(const Scene&, const DesignTable* design, const TrialLimits&);

}  // namespace sturz::workflow
