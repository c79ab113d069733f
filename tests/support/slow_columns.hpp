// SPDX-License-Identifier: Apache-2.0
/// The slow twin of the sweep over columns: every pair, double precision, the formulas in full.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"

#include <vector>

namespace sturz::test {

/// A column as the sweep sees it.
struct SlowColumn {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};
  double volume = 1;          ///< [m^3]
  double support_radius = 4;  ///< support radius R [m]
  double thickness = 1;       ///< h [m]
  double lateral = 9.81;      ///< K g_n [m/s^2]
  double share = 1;           ///< of the ground's slope that pressure knows [-]
};

struct ColumnRates {
  double thickness = 0;        ///< sum V_j W_ij [m]
  double density = 0;          ///< sum W_ij [1/m^2]
  Vec3 acceleration{0, 0, 0};  ///< -sum V_j ((K g_n)_ij + Pi_ij) grad W_ij [m/s^2]
  double divergence = 0;       ///< sum V_j (v_j - v_i).grad W_ij [m/s]
  double approach = 0;         ///< greatest squared relative speed of a neighbour [m^2/s^2]
  double pull = 0;             ///< sum of the pairs' |acceleration|; slow twin only [m/s^2]
};

/// \param images  extra columns that are neighbours only
std::vector<ColumnRates> slow_columns(const std::vector<SlowColumn>&,
                                      const std::vector<SlowColumn>& images,
                                      const ColumnConstants&);

/// What the sweep wrote.
struct FastColumns {
  std::vector<ColumnRates> rates;  ///< in the order of the columns it was given
  std::vector<float> raw;          ///< all outputs in the records' order, to compare bits
};

/// Runs cells and sweep on copies of the columns.
FastColumns fast_columns(const std::vector<SlowColumn>&, const ColumnConstants&, InstructionSet,
                         const Domain& = {});

}  // namespace sturz::test
