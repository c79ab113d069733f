// SPDX-License-Identifier: Apache-2.0
/// What the passes of two coupled sets of columns share.
#pragma once

#include "engine/effects/columns/shared.hpp"
#include "engine/effects/phases/settings.hpp"
#include "engine/neighbors/column_cells.hpp"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace sturz {

/// What the columns of one set see of the other.
struct Across {
  std::vector<ColumnGroup> groups;  ///< of this set, with runs of the other's records
  std::vector<ColumnRun> runs;
  std::array<std::vector<float>, 5> results;  ///< of the sweep, by record
  std::vector<double> thickness;   ///< of the other set, along the normal that pressure knows [m]
  std::vector<double> gravity;     ///< pressure over density and thickness [m/s^2]
  std::vector<double> wave2;       ///< gravity times both thicknesses [m^2/s^2]
  std::vector<double> ax, ay, az;  ///< by the other set's thickness [m/s^2]
};

struct TwoPhases {
  TwoPhaseSettings settings;
  std::array<std::shared_ptr<ColumnFlow>, 2> flow;  ///< grains, liquid
  ColumnFrame frame;
  std::array<Across, 2> across;
  std::array<ColumnForecast, 2> forecast;
  std::array<std::vector<double>, 2> push_x, push_y, push_z;  ///< by drag, this step [m/s]
  double fastest_wave = 0;                                    ///< largest sqrt(G h) / h_s [1/s]
  double fastest_approach = 0;                                ///< between the sets, / h_s [1/s]

  explicit TwoPhases(TwoPhaseSettings s) : settings(std::move(s)) {}
};

void add_phase_frame(Step&, const std::shared_ptr<TwoPhases>&);     ///< cells of both
void add_phase_pressure(Step&, const std::shared_ptr<TwoPhases>&);  ///< of each on the other
void add_phase_drag(Step&, const std::shared_ptr<TwoPhases>&);      ///< and its accounts

}  // namespace sturz
