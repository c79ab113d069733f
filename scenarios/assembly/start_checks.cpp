// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/start_checks.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace sturz {
namespace {

/// What of a release starts behind one wall.
struct Behind {
  std::size_t n = 0;
  double mass = 0, farthest_m = 0, foremost_m = 0;
};

Behind behind(const Release& r, const Wall& wall) {
  Behind b;
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    const double d = (Vec3(r.x[i], r.y[i], r.z[i]) - wall.point).dot(wall.normal);
    b.foremost_m = std::max(b.foremost_m, d);
    if (!(d < 0)) continue;
    ++b.n;
    b.mass += r.mass[i];
    b.farthest_m = std::max(b.farthest_m, -d);
  }
  return b;
}

std::string vector_text(const Vec3& v) {
  std::string text;
  for (const double x : {v.x(), v.y(), v.z()})
    text.append(text.empty() ? "[" : ", ").append(short_number(x == 0 ? 0 : x));  // no minus zero
  return text.append("]");
}

std::string complaint(std::size_t k, const Wall& wall, const Behind& b, const Release& r,
                      bool columns) {
  double all = 0;
  for (const double m : r.mass) all += m;
  const std::string name = "domain.walls[" + std::to_string(k) + "]: ";
  const std::string what = columns ? " columns" : " particles";
  const std::string far = short_number(b.farthest_m) + " m";
  if (b.n == r.x.size())
    return name + "the release lies behind this wall, all " + std::to_string(b.n) + what +
           " of it, up to " + far + " (its normal " + vector_text(wall.normal) +
           " points away from them, and it would throw them to its front). Turn the normal: " +
           vector_text(-wall.normal) + ".";
  return name + "the release lies across this wall: " + std::to_string(b.n) + " of " +
         std::to_string(r.x.size()) + what + " (" + short_number(100 * b.mass / all) +
         " % of the mass) start behind it, up to " + far + ", the others up to " +
         short_number(b.foremost_m) +
         " m in front (it would throw them to its front). Cut the release at the wall, or move "
         "point_m by " +
         far + " against the normal " + vector_text(wall.normal) + ".";
}

/// Width of the narrow side of the rectangle with the same second moments.
double width_by_moments(const Raster<double>& thickness) {
  const Grid& g = thickness.grid;
  double n = 0, sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      if (!(thickness.at(r, c) > 0)) continue;
      n += 1, sx += c, sy += r;
      sxx += double(c) * c, syy += double(r) * r, sxy += double(c) * r;
    }
  if (n == 0) return 0;
  const double cell = 1.0 / 12;  // of a cell by itself
  const double xx = sxx / n - sx * sx / (n * n) + cell, yy = syy / n - sy * sy / (n * n) + cell;
  const double xy = sxy / n - sx * sy / (n * n);
  const double least = 0.5 * (xx + yy) - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  return std::sqrt(12 * std::max(0.0, least)) * g.cell_m;
}

/// Four times the area over the length of the edge; a edge along the cells is 4/pi times too long.
double width_by_edge(const Raster<double>& thickness) {
  const Grid& g = thickness.grid;
  const auto inside = [&](int r, int c) { return g.contains(r, c) && thickness.at(r, c) > 0; };
  double cells = 0, edges = 0;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      if (!inside(r, c)) continue;
      ++cells;
      edges += !inside(r - 1, c) + !inside(r + 1, c) + !inside(r, c - 1) + !inside(r, c + 1);
    }
  return edges > 0 ? 4 * cells / edges * (4 / std::numbers::pi) * g.cell_m : 0;
}

}  // namespace

void require_before_walls(const Release& release, const Domain& domain, bool columns) {
  std::string text;
  for (std::size_t k = 0; k < domain.walls.size(); ++k) {
    const Behind b = behind(release, domain.walls[k]);
    if (b.n == 0) continue;
    if (!text.empty()) text.push_back('\n');
    text.append(complaint(k, domain.walls[k], b, release, columns));
  }
  require(text.empty(), text);
}

double narrow_side(const Raster<double>& thickness, double source_area_m2) {
  double side = std::min(width_by_moments(thickness), width_by_edge(thickness));
  if (source_area_m2 > 0) side = std::min(side, std::sqrt(source_area_m2));
  return side;
}

}  // namespace sturz
