// SPDX-License-Identifier: Apache-2.0
#include "scenarios/shapes/profile.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/shapes/frame.hpp"
#include "scenarios/shapes/utm_48n.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::shapes {

double at(const Profile& profile, double s) {
  if (s <= profile.front().first) return profile.front().second;
  if (s >= profile.back().first) return profile.back().second;
  const auto next = std::upper_bound(profile.begin(), profile.end(), s,
                                     [](double v, const auto& point) { return v < point.first; });
  const auto& [s1, z1] = *next;
  const auto& [s0, z0] = *(next - 1);
  return z0 + (z1 - z0) * (s - s0) / (s1 - s0);
}

double rounded(const Profile& profile, double s, double half_width) {
  constexpr int steps = 20;
  double sum = 0, weights = 0;
  for (int i = 0; i <= steps; ++i) {
    const double offset = -half_width + 2 * half_width * i / steps;
    const double cosine = std::cos(std::numbers::pi * offset / (2 * half_width));
    sum += cosine * cosine * at(profile, s + offset);
    weights += cosine * cosine;
  }
  return sum / weights;
}

double smooth_min(double a, double b, double blend) {
  const double share = std::clamp(0.5 + 0.5 * (b - a) / blend, 0.0, 1.0);
  return b * (1 - share) + a * share - blend * share * (1 - share);
}

double lateral_share(double n, double half_width) {
  return std::max(0.0, 1 - std::pow(std::abs(n / half_width), 4));
}

void scale_to_volume(Raster<double>& thickness, double volume_m3, const std::string& shape) {
  const double cell = thickness.grid.cell_m;
  double volume = 0;
  for (const double h : thickness.values) volume += h * cell * cell;
  require(volume > 0, "terrain.synthetic." + shape + ".cell_size_m = " + number_text(cell) +
                          " (no cell centre lies in the source). Use smaller cells.");
  for (double& h : thickness.values) h *= volume_m3 / volume;
}

Grid landslide_grid(double s0, double s1, double half_width, double cell_m) {
  Grid grid = grid_from_corner(origin_east_m + s0, origin_north_m - half_width, s1 - s0,
                               2 * half_width, cell_m);
  grid.crs_wkt = utm_48n_wkt;
  return grid;
}

}  // namespace sturz::shapes
