// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/hillshade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

struct Slope {
  double east = 0, north = 0;  ///< dz/dx, dz/dy [-]
};

/// Horn (1981): weighted differences over the 3 x 3 neighbourhood; unknown neighbours and those
/// beyond the edge repeat the centre.
Slope slope_at(const Raster<double>& z, int row, int col) {
  const double centre = z.at(row, col);
  const auto node = [&](int dr, int dc) {
    const int r = row + dr, c = col + dc;
    if (!z.grid.contains(r, c)) return centre;
    const double value = z.at(r, c);
    return std::isfinite(value) ? value : centre;
  };
  const double east = node(-1, 1) + 2 * node(0, 1) + node(1, 1);
  const double west = node(-1, -1) + 2 * node(0, -1) + node(1, -1);
  const double north = node(-1, -1) + 2 * node(-1, 0) + node(-1, 1);
  const double south = node(1, -1) + 2 * node(1, 0) + node(1, 1);
  return {(east - west) / (8 * z.grid.cell_m), (north - south) / (8 * z.grid.cell_m)};
}

double exaggeration(const std::vector<Slope>& slopes) {
  std::vector<double> steepness;
  for (const Slope& s : slopes)
    if (std::isfinite(s.east)) steepness.push_back(std::hypot(s.east, s.north));
  if (steepness.empty()) return 1;
  const auto middle = steepness.begin() + static_cast<std::ptrdiff_t>(steepness.size() / 2);
  std::nth_element(steepness.begin(), middle, steepness.end());
  return std::clamp(0.45 / std::max(*middle, 1e-6), 1.0, 3.0);
}

double brightness(const Slope& s, double exaggerate) {
  struct Light {
    double azimuth_deg, weight;
  };
  static constexpr std::array<Light, 4> lights{{{315, 0.55}, {270, 0.15}, {0, 0.2}, {225, 0.1}}};
  const double e = exaggerate * s.east, n = exaggerate * s.north;
  const double scale = std::sqrt(0.5 / (1 + e * e + n * n));  // lights stand at 45 degrees
  double sum = 0;
  for (const Light& light : lights) {
    const double a = light.azimuth_deg * std::numbers::pi / 180;
    sum += light.weight * std::max(0.0, scale * (1 - e * std::sin(a) - n * std::cos(a)));
  }
  return sum;
}

}  // namespace

std::vector<std::uint8_t> hillshade(const Raster<double>& ground) {
  std::vector<Slope> slopes(ground.values.size(), {nan_d, nan_d});
  for (int row = 0; row < ground.grid.n_rows; ++row)
    for (int col = 0; col < ground.grid.n_cols; ++col)
      if (std::isfinite(ground.at(row, col)))
        slopes[ground.grid.index(row, col)] = slope_at(ground, row, col);
  const double exaggerate = exaggeration(slopes);
  std::vector<std::uint8_t> shade(slopes.size(), 255);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (!std::isfinite(slopes[i].east)) continue;
    // Flat ground is 0.707; the range is lifted to 95..250 so that colours on it stay readable.
    const double light = std::clamp(brightness(slopes[i], exaggerate), 0.0, 1.0);
    const double grey = 95 + 155 * std::pow(light, 0.9);
    shade[i] = static_cast<std::uint8_t>(std::lround(grey / 255 * 63) * 255 / 63);
  }
  return shade;
}

}  // namespace sturz
