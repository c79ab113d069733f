// SPDX-License-Identifier: Apache-2.0
/// Peaks of thickness, speed, energy and pressure per cell over a member's life.
#pragma once

#include "engine/effects/moving_set.hpp"
#include "engine/simulation/maps/layer_count.hpp"
#include "engine/simulation/maps/peak_tiles.hpp"
#include "engine/simulation/maps/spread_weights.hpp"
#include "engine/simulation/maps/sum_tiles.hpp"
#include "engine/simulation/member_result.hpp"

#include <array>
#include <span>
#include <vector>

namespace sturz {

struct PeakMapSettings {
  Grid grid;                     ///< the whole hazard grid
  double runout_limit_m = 0.05;  ///< smoothed thickness that counts as reached: max(0.05, dx/10)
  /// Width of a particle with a field "support_radius" (a column) over that radius: one and a half
  /// mean distances of columns, so that a lattice leaves no pattern on the map.
  double width_per_radius = 0.375;
  bool by_set = false;  ///< of two sets, grains and liquid: also the peaks and arrival of each
};

struct PeakRow;

/// Spreads particles over cells with a quadratic B-spline of width max(dx, cell), normalised to
/// sum to one (dx: of a depth-averaged column the present mean distance of columns), with the same
/// weights for volume, m v and 1/2 m v^2 (docs/physics.md D.3), and keeps maxima over time of each
/// product at one instant.
///
/// A cell is reached, and covered by the deposit, where the thickness passes the runout limit and
/// half of the cell lies under columns: each covers a square of the map area that it stands for.
/// Where columns lie unevenly, squares leave gaps: cells also count where those areas, spread as
/// the mass is, add up to three quarters. Of other particles the cell counts that one lies in.
/// Spreading carries mass two mean distances beyond the last particle; that counts in the layers,
/// which keep volume, and not in areas, arrival and runout, or a release that never moved would
/// cover twice its area.
///
/// Of grains and liquid that are told apart each has peaks, arrival and cells of its own by the
/// same rules, as if the other were not there; only its dynamic pressure knows the flow's volume
/// (PeakRow::keep_material).
///
/// What falls on cells beyond the grid is dropped, not pushed in. Time follows the cells that the
/// particles touch now, memory those that they ever touched; neither the raster nor the rectangle
/// around the flow counts.
class PeakMaps {
 public:
  explicit PeakMaps(PeakMapSettings);

  /// Takes in one instant of all sets; a particle's volume is its mass over its set's bulk density,
  /// so volume is kept as far as floats can. Serial and in storage order: bitwise reproducible for
  /// a given particle order. Particles without a finite position and speed are left out.
  /// At most two sets. \param with_layers  count the layers too; else those of the last time stay
  void record(std::span<const MovingSet>, double time_s, bool with_layers = true);
  /// Writes window, layers (deposit and mass left from `final_state`) and the map scalars (reached
  /// and deposit area, maxima) into `result`; what was eroded is not theirs. Record the final state
  /// first, as any other instant.
  void finish(std::span<const MovingSet> final_state, MemberResult& result);
  struct Cell {
    int row = 0, col = 0;
  };
  /// Cells that the deposit covers, after `finish`; in no order that means anything.
  std::vector<Cell> deposit_cells() const;
  const PeakMapSettings& settings() const { return settings_; }
  /// How much of the way to the next record the particles make in a step of length dt_s: one for
  /// the particle that is farthest on, when it moves by half a cell or by `record_share` of the
  /// width that it is spread over, whichever is more. Nothing on the map is finer.
  double share_of_record(std::span<const MovingSet>, double dt_s) const;
  /// An isolated particle's peak between two records that lie this share of its width apart is at
  /// most 8 % lower; with the parabola through three records 2 %. Figures of flows:
  /// docs/studies/bookkeeping.md.
  static constexpr double record_share = 0.4;
  /// Layers across the thickness, when they were last counted.
  const LayerCount& layers() const { return layers_; }

 private:
  /// Where this much of a cell lies under particles, it is reached: a half, less what rounding may
  /// take from it.
  static constexpr float enough_under = 0.4998F;

  /// Over the whole map.
  struct Totals {
    std::size_t reached = 0, covered = 0;  ///< cells
    float thickness = 0, deposit = 0, energy = 0, pressure = 0;
  };
  /// How wide the particles of a set are spread.
  struct Width {
    double cells = 1;                        ///< of the B-spline; the largest where it varies
    const double* support_radius = nullptr;  ///< of columns, each its own
    const Field* thickness = nullptr;        ///< of columns, normal to the ground
    const Field* ground = nullptr;           ///< slopes below columns
    const double* area_share = nullptr;      ///< of columns, see fields::area_share
    double volume_per_mass = 0;              ///< [m^3/kg]
    double spacing = 1;                      ///< of other particles [m]
    /// Map area that particle i stands for [m^2].
    double area(std::size_t i, double mass) const;
  };
  Totals write_layers(MemberResult&) const;
  static void write_materials(const PeakTile&, std::size_t cell, std::size_t k, MemberResult&);
  void write_left(std::span<const MovingSet>, MemberResult&) const;
  Width width_of(const MovingSet&) const;
  Window cover(const ParticleSet&, const Width&) const;
  Window bounds_of(std::span<const MovingSet>);
  void add_one(const CellSums&, SumTiles& to) const;
  void cover_cell_of(double x, double y, double half_width, SumTiles& to) const;
  void cover_square(double x, double y, double side, SumTiles& to) const;
  void scatter(std::span<const MovingSet>);
  void scatter_set(const MovingSet&, std::size_t set, SumTiles& to);
  void clear_sums();
  void keep_peaks(double time_s);
  void keep_materials(const PeakRow&, std::size_t slot, PeakTile&);
  void count_layers(std::span<const MovingSet>);
  void keep_deposit();

  PeakMapSettings settings_;
  PeakTiles peaks_;
  SumTiles sums_;                   ///< of all sets
  std::array<SumTiles, 2> of_set_;  ///< of each, where they are told apart
  std::size_t n_sets_ = 0;
  std::vector<Width> widths_;    ///< [set] of the present instant
  SpreadWeights across_, down_;  ///< of one particle: along a row, along a column
  LayerHistogram histogram_;
  LayerCount layers_;
  std::size_t n_records_ = 0;
  double last_s_ = 0, before_s_ = 0;  ///< the last two instants
};

}  // namespace sturz
