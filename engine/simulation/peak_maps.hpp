// SPDX-License-Identifier: Apache-2.0
/// Peaks of thickness, speed, energy and pressure per cell over a member's life.
#pragma once

#include "engine/core/vec.hpp"
#include "engine/effects/moving_set.hpp"
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
};

/// Thickness over spacing, weighted by mass, at one instant.
struct LayerCount {
  double median = 0, p10 = 0;  ///< exceeded by half and by 90 % of the mass; to about 5 %
  double thin_fraction = 0;    ///< share of the mass in cells under four layers
};

/// Spreads particles over cells with a quadratic B-spline of width max(dx, cell), normalised to
/// sum to one (dx: of a depth-averaged column the present mean distance of columns), with the same
/// weights for volume, m v and 1/2 m v^2 (docs/physics.md D.3), and keeps maxima over time of each
/// product at one instant.
///
/// What falls on cells beyond the grid is dropped, not pushed in. Memory follows the part of the
/// grid that the flow has touched.
class PeakMaps {
 public:
  explicit PeakMaps(PeakMapSettings);

  /// Takes in one instant of all sets; a particle's volume is its mass over its set's bulk density,
  /// so volume is exact. Serial, summed in double and in storage order: bitwise reproducible for
  /// a given particle order. Particles without a finite position and speed are left out.
  void record(std::span<const MovingSet>, double time_s);
  /// Writes window, layers (deposit from `final_state`) and the map scalars (reached and deposit
  /// area, maxima) into `result`. Record the final state first, as any other instant.
  void finish(std::span<const MovingSet> final_state, MemberResult& result);
  const PeakMapSettings& settings() const { return settings_; }
  /// Layers across the thickness at the last instant.
  const LayerCount& layers() const { return layers_; }

 private:
  struct Peak {
    float thickness = 0, speed = 0, energy = 0, pressure = 0, arrival = nan_f, deposit = 0;
  };
  /// Over the whole map.
  struct Totals {
    std::size_t reached = 0, covered = 0;  ///< cells
    Peak most;
  };
  Totals write_layers(MemberResult&) const;
  /// Momentum x, y, z [kg m/s] and kinetic energy [J] of one instant in a cell.
  using Motion = Eigen::Array4d;
  /// How wide the particles of a set are spread.
  struct Width {
    double cells = 1;                        ///< of the B-spline; the largest where it varies
    int n_weights = 3;                       ///< cells that one particle can touch per direction
    const double* support_radius = nullptr;  ///< of columns, each its own
  };
  Width width_of(const MovingSet&) const;
  Window cover(const ParticleSet&, const Width&) const;
  Window bounds_of(std::span<const MovingSet>);
  void make_room(const Window&);
  /// What adding a particle needs, at hand.
  struct Room {
    double *wx, *wy, *mass;
    Motion* motion;
    int n_rows, n_cols;
  };
  template <bool with_motion, int n_fixed>
  static void add_one(const Room&, double x, double y, double width, int n_cells,
                      double particle_mass, const Motion&);
  template <bool with_motion>
  void scatter(std::span<const MovingSet>);
  template <bool with_motion>
  void scatter_set(const ParticleSet&, const Width&, std::vector<double>& mass);
  void keep_peaks(std::span<const MovingSet>, const Window&, float time_s);
  void count_layers(double total_mass);
  void keep_deposit(std::span<const MovingSet>, const Window&);
  Window tight_window() const;

  PeakMapSettings settings_;
  static constexpr int n_bins = 128;           ///< of thickness over spacing, 24 per decade
  Window room_;                                ///< the part of the grid that the arrays below hold
  std::vector<Peak> peak_;                     ///< [room_]
  std::vector<std::vector<double>> mass_;      ///< [set][room_], zero between instants [kg]
  std::vector<Motion> motion_;                 ///< [room_], zero between instants
  std::vector<Width> widths_;                  ///< [set] of the present instant
  std::vector<double> weights_x_, weights_y_;  ///< scratch of one particle
  std::array<double, n_bins> mass_by_layers_{};
  LayerCount layers_;
};

}  // namespace sturz
