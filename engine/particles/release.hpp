// SPDX-License-Identifier: Apache-2.0
/// From a release thickness to particles: a lattice in map x, y, stacked on the bed.
#pragma once

#include "engine/particles/release_columns.hpp"
#include "engine/terrain/terrain.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

struct ReleaseSettings {
  double spacing_m = 1;           ///< dx of the lattice
  double bulk_density_kg_m3 = 1;  ///< alpha rho_p
  double jitter = 0.05;           ///< amplitude in spacings, uniform in +-jitter, each direction
  std::uint64_t seed = 1;         ///< Philox key
  std::int64_t member = 0;        ///< Philox counter, with the particle's number
  bool columns = false;           ///< one column on the bed per lattice cell instead of a stack
};

/// Particles of a release; all arrays [n], stack by stack, each from the bed up.
struct Release {
  std::vector<double> x, y, z;  ///< [m]
  std::vector<double> mass;     ///< [kg]
  std::vector<double> depth;    ///< vertical distance below the free surface [m]
  std::vector<double>
      thickness;  ///< vertical, of the lattice cell that the particle belongs to [m]
  /// Share of that lattice cell that the source covers, 0..1.
  std::vector<double> covered;
  double volume_m3 = 0;           ///< bulk volume of the pattern on its raster
  double area_m2 = 0;             ///< plan area with thickness > 0
  double layers = 0;              ///< volume-weighted median of vertical thickness / spacing
  double median_thickness_m = 0;  ///< volume-weighted
  double max_thickness_m = 0;
  /// Highest point of the surface of the mass: cell centre of the thickness raster, bed plus
  /// thickness. Cells under 1 % of the median thickness do not count.
  double crown_x_m = 0, crown_y_m = 0, crown_z_m = 0;
  /// Of the volume, in lattice cells too thin for a particle (0.2 dx; columns: 1 % of the median
  /// thickness); given to the others.
  double dropped_fraction = 0;
};

/// Fills bed .. bed + thickness. Sum of masses = bulk density x raster volume to round-off.
/// \param thickness vertical [m] on any grid; NaN and <= 0 count as nothing
/// \param cover share of each of its cells that the source covers; null: see release_columns
/// \throws SetupError when there is no mass or a column lies outside the terrain
Release release_particles(const Terrain& bed, const Raster<double>& thickness,
                          const ReleaseSettings&, const Raster<double>* cover = nullptr);

/// How many particles a stack of that thickness has.
std::size_t layers_of(double thickness_m, double spacing_m);

/// A column of the lattice that stands on what lies on the bed.
struct UpperColumn {
  ReleaseColumn column;         ///< `thickness_m` holds its volume over all of the lattice cell
  double base_m = 0;            ///< of its foot above the bed, vertical
  std::size_t first_layer = 0;  ///< layers under it, so that its jitter is not theirs
};

/// Fills columns of thickness_m / covered from their foot up: a cell that is covered in part is
/// filled as high as others, by lighter particles. `depth` counts from the column's own top.
/// \param volume_m3 sum of masses = bulk density x this, to round-off
Release fill_columns(const Terrain& bed, const std::vector<UpperColumn>&, const ReleaseSettings&,
                     double volume_m3);

}  // namespace sturz
