// SPDX-License-Identifier: Apache-2.0
/// The layout that the loop over neighbouring columns reads and writes: plain arrays, because the
/// loop is compiled once per instruction set.
#pragma once

#include "engine/neighbors/neighbor_records.hpp"

#include <cstddef>
#include <cstdint>

namespace sturz {

/// One column of a depth-averaged flow as neighbour. Positions are fixed point, see ColumnView.
struct alignas(16) ColumnRecord {
  std::int32_t x, y, z;
  float volume;          ///< [m^3]
  float vx, vy, vz;      ///< [m/s]
  float inverse_radius;  ///< one over the support radius [1/m]
  float thickness;       ///< along the normal of the ground that pressure knows [m]
  float lateral;         ///< K g_n: lateral pressure over density and thickness [m/s^2]
  float wave_speed;      ///< sqrt(K g_n thickness) [m/s]
  float share;           ///< of the ground's slope that pressure knows [-]
};
static_assert(sizeof(ColumnRecord) == 48);

/// Records [begin, end).
struct ColumnRun {
  std::uint32_t begin, end;
};

/// At most group_size records that follow each other, and the runs that hold all their neighbours,
/// one run per row of cells.
struct ColumnGroup {
  std::uint32_t begin, end;           ///< records
  std::uint32_t first_run, last_run;  ///< [first_run, last_run) into ColumnView::runs
};

/// Everything that a sweep over columns needs to read.
struct ColumnView {
  const ColumnRecord* records = nullptr;  ///< in order of their cells, periodic images included
  const ColumnGroup* groups = nullptr;
  const ColumnRun* runs = nullptr;
  double unit_m = 1;  ///< metres per position unit
};

/// Columns of one set and those of another near them, see ColumnCells::list_across.
struct AcrossView {
  const ColumnRecord* records = nullptr;  ///< of the groups
  const ColumnRecord* others = nullptr;   ///< of the runs; the same position units
  const ColumnGroup* groups = nullptr;
  const ColumnRun* runs = nullptr;
  double unit_m = 1;
};

/// Sums per record over the other set, each [n_records]; see phases/sums.hpp.
struct AcrossOutput {
  float* thickness;  ///< sum V_j W_ij [m]
  float* ax;
  float* ay;
  float* az;        ///< -G grad of that thickness [m/s^2]
  float* approach;  ///< largest relative speed of a neighbour, squared [m^2/s^2]
};

/// Constants of the pair terms of columns.
struct ColumnConstants {
  double viscosity = 0.5;  ///< alpha of Monaghan's viscosity between approaching columns
  bool steep = false;      ///< a share under one occurs
};

/// Sums per record, each [n_records]; see columns/sums.hpp.
struct ColumnSweepOutput {
  float* thickness;  ///< sum V_j W_ij [m]
  float* density;    ///< sum W_ij: columns per area [1/m^2]
  float* ax;
  float* ay;
  float* az;  ///< acceleration by lateral pressure and viscosity [m/s^2]
  float*
      divergence;   ///< sum V_j (v_j - v_i).grad W_ij [m/s]; over thickness: of the velocity [1/s]
  float* approach;  ///< largest relative speed of a neighbour, squared [m^2/s^2]
};

}  // namespace sturz
