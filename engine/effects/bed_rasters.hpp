// SPDX-License-Identifier: Apache-2.0
/// Numbers of the bed that rasters give cell by cell.
#pragma once

#include "engine/laws/basal_resistance.hpp"
#include "engine/terrain/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sturz {

/// Which number a raster gives, in the order of their arrays.
enum class BedNumber : std::size_t { friction, pore_pressure, cohesion, turbulence };
inline constexpr std::size_t n_bed_numbers = 4;

inline double& number_of(BasalResistance& bed, BedNumber number) {
  switch (number) {
    case BedNumber::friction:
      return bed.friction_coefficient;
    case BedNumber::pore_pressure:
      return bed.pore_pressure_ratio;
    case BedNumber::cohesion:
      return bed.cohesion_pa;
    case BedNumber::turbulence:
      break;
  }
  return bed.turbulent_coefficient;
}

/// Shared, read-only; without any every place has the numbers of its zone.
struct BedRasters {
  struct Layer {
    BedNumber number = BedNumber::friction;
    /// Part of the whole grid that is held; NaN: the raster says nothing there.
    std::shared_ptr<const Raster<double>> values;
    double factor = 1;
    double least = 0, most = 0;  ///< of its values where the flow may come, times the factor
  };
  std::vector<Layer> layers;
  /// By zone, [0] where there is none: numbers that the zone itself gives. Those stay.
  std::vector<std::array<bool, n_bed_numbers>> given{{}};
  Grid whole;
  int row0 = 0, col0 = 0;  ///< of the part

  bool any() const { return !layers.empty(); }
  bool has(BedNumber number) const {
    return std::any_of(layers.begin(), layers.end(),
                       [&](const Layer& l) { return l.number == number; });
  }

  /// The bed of a zone with the rasters' numbers at (x, y). A place has the numbers of the cell
  /// that it lies in.
  BasalResistance over(BasalResistance bed, int zone, double x, double y) const {
    const int row = whole.row_of(y) - row0, col = whole.col_of(x) - col0;
    for (const Layer& layer : layers) {
      const Raster<double>& r = *layer.values;
      if (given[static_cast<std::size_t>(zone)][static_cast<std::size_t>(layer.number)] ||
          !r.grid.contains(row, col))
        continue;
      const double v = r.at(row, col);
      if (!std::isnan(v)) number_of(bed, layer.number) = layer.factor * v;
    }
    return bed;
  }

  /// Least and most that a bed's number comes to anywhere, with what the raster gives.
  std::pair<double, double> range(const BasalResistance& bed, BedNumber number) const {
    BasalResistance copy = bed;
    std::pair<double, double> out(number_of(copy, number), number_of(copy, number));
    for (const Layer& l : layers)
      if (l.number == number) out = {std::min(out.first, l.least), std::max(out.second, l.most)};
    return out;
  }
};

}  // namespace sturz
