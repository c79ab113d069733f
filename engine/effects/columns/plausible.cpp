// SPDX-License-Identifier: Apache-2.0
// Whether columns did what a mass of grains can do: rise no higher than its energy, rest no steeper
// than its friction.
#include "engine/effects/columns/shared.hpp"
#include "engine/neighbors/column_smoothing.hpp"

#include <algorithm>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <unordered_map>

namespace sturz {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double margin_deg = 5;   ///< on the angle of rest
constexpr double overshoot = 0.1;  ///< of the release's thickness that smoothing may add
constexpr double share_that_counts = 0.01;

std::string whole(double value) { return std::to_string(std::lround(value)); }

/// A height that never reads as 0: two digits, whole from 10 on.
std::string height(double value) {
  if (std::abs(value) >= 9.95) return whole(value);
  std::ostringstream text;
  text << std::setprecision(2) << value;
  return text.str();
}

/// Columns by square of the map as wide as the longest support radius.
class Squares {
 public:
  Squares(const ParticleSet& p, double width) : width_(width) {
    for (std::size_t i = 0; i < p.size(); ++i)
      columns_[key(square(p.x[i]), square(p.y[i]))].push_back(i);
  }
  template <class F>
  void around(double x, double y, F&& visit) const {
    for (std::int64_t row = square(y) - 1; row <= square(y) + 1; ++row)
      for (std::int64_t col = square(x) - 1; col <= square(x) + 1; ++col)
        if (const auto found = columns_.find(key(col, row)); found != columns_.end())
          for (const std::size_t j : found->second) visit(j);
  }

 private:
  std::int64_t square(double at) const { return std::llround(std::floor(at / width_)); }
  static std::int64_t key(std::int64_t col, std::int64_t row) { return (row << 32) + col; }

  double width_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> columns_;
};

/// Slope of the free surface above column i: of the ground and of the thickness in the map [-].
double surface_slope(const ParticleSet& p, const Squares& squares, const ColumnFlow& flow,
                     std::size_t i) {
  const auto& ground = p.components(fields::ground);
  const auto& support_radius = p.scalar(fields::support_radius);
  double east = ground[0][i], north = ground[1][i];
  squares.around(p.x[i], p.y[i], [&](std::size_t j) {
    const double x = p.x[i] - p.x[j], y = p.y[i] - p.y[j], distance = std::hypot(x, y);
    const double radius = std::min(support_radius[i], support_radius[j]);
    if (j == i || distance >= radius) return;
    const double rise =
        p.mass[j] / flow.settings.density * ColumnSmoothing{radius}.gradient(distance);
    east -= rise * x, north -= rise * y;
  });
  return std::hypot(east, north);
}

/// Steeper than the friction of grains and bed, by the margin [-].
double steepest_rest(const DepthAveragedSettings& s) {
  double friction = s.internal_friction;
  for (const BasalResistance& bed : s.bed) {
    const double most = s.rasters.range(bed, BedNumber::friction).second;
    friction = std::max(friction, bed.samosat ? 2 * most : most);  // at rest, slowness()
  }
  return std::tan(std::min(89 * degree, std::atan(friction) + margin_deg * degree));
}

bool is_sticky(const BasalResistance& bed) {
  return bed.cohesion_pa > 0 || bed.yield_stress_pa > 0;
}

}  // namespace

SteepRest steep_rest(const State& s, const ColumnFlow& flow, double limit) {
  const ParticleSet& p = s.sets[flow.set];
  const auto& thickness = p.scalar(fields::thickness);
  const auto& support_radius = p.scalar(fields::support_radius);
  SteepRest out;
  if (p.size() == 0) return out;
  const Squares squares(p, *std::max_element(support_radius.begin(), support_radius.end()));
  double mass = 0, steep = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    mass += p.mass[i];
    const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (v2 > 1e-4 * s.gravity * thickness[i]) continue;
    const double slope = surface_slope(p, squares, flow, i);
    out.steepest = std::max(out.steepest, slope);
    if (slope > limit) steep += p.mass[i];
  }
  out.share = steep / mass;
  return out;
}

void warn_of_implausible(const State& s, const ColumnFlow& flow, std::vector<std::string>& out) {
  const double above = flow.highest_surface - flow.release_top;
  if (above > overshoot * flow.release_thickness)
    out.push_back("columns: the mass rose " + height(above) +
                  " m above its highest point at release, more than its energy allows (it was " +
                  height(flow.release_thickness) +
                  " m thick). Use a finer spacing, or formulation: full_stress where the scene's "
                  "effects exist in it");
  const DepthAveragedSettings& set = flow.settings;
  const Domain& domain = s.domain;
  if (!(set.internal_friction > 0) || std::any_of(set.bed.begin(), set.bed.end(), is_sticky) ||
      set.rasters.has(BedNumber::cohesion) || domain.x.active || domain.y.active ||
      !domain.walls.empty())
    return;
  const SteepRest steep = steep_rest(s, flow, steepest_rest(set));
  if (steep.share > share_that_counts)
    out.push_back("columns: " + whole(100 * steep.share) +
                  " % of the mass rests under a surface of up to " +
                  whole(std::atan(steep.steepest) / degree) +
                  " degrees, steeper than its friction allows by more than " + whole(margin_deg) +
                  " degrees. The deposit there is no measure: use another spacing or formulation: "
                  "full_stress");
}

}  // namespace sturz
