// SPDX-License-Identifier: Apache-2.0
/// How many layers of particles lie over each other: thickness over spacing, weighted by mass.
#pragma once

#include <array>
#include <cstdint>

namespace sturz {

/// Of one instant.
struct LayerCount {
  double median = 0, p10 = 0;  ///< exceeded by half and by 90 % of the mass; to about 5 %
  double thin_fraction = 0;    ///< share of the mass in cells under four layers
};

/// A histogram of mass over layers: 24 bins per factor of ten, one edge exactly at four layers.
class LayerHistogram {
 public:
  static constexpr int n_bins = 128;

  void clear();
  /// \param layers  thickness / spacing of the cell that `mass` [kg] lies in
  void add(double layers, double mass) { mass_[bin_of(layers)] += mass; }
  /// \param total_mass  of all that was added [kg]
  LayerCount count(double total_mass) const;
  /// Bin 0 takes all that is thinner than the first edge, the last all that is thicker.
  static int bin_of(double layers);

 private:
  std::array<double, n_bins> mass_{};  ///< [kg]
};

}  // namespace sturz
