// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/structures/dams.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

/// The dam over the cells of a raster. A cell belongs to the place of the line that is nearest: a
/// crest that rises along the line is as high across as there, and not as high as farther up.
class Body {
 public:
  Body(const DamLine& line, const DamSpec& spec, double width, const Raster<double>& ground)
      : line_(line),
        spec_(spec),
        half_(0.5 * width),
        ground_(ground),
        crest_(crest_of(line, spec)),
        window_(window_around(line.points, farthest_side(line, spec, width) + ground.grid.cell_m,
                              ground.grid)),
        nearest_(window_.n_cells()) {}

  void lay() {
    for (std::size_t i = 0; i + 1 < line_.points.size(); ++i) lay_piece(i);
  }
  /// visit(index of a cell of the ground, top of the dam there, whether its side ends there).
  template <class Visit>
  void each(Visit visit) const {
    std::size_t k = 0;
    for (int r = window_.row0; r < window_.end_row(); ++r)
      for (int c = window_.col0; c < window_.end_col(); ++c, ++k)
        if (nearest_[k].distance <= nearest_[k].limit)
          visit(ground_.grid.index(r, c), nearest_[k].top, nearest_[k].last);
  }

 private:
  struct Nearest {
    double distance = INFINITY;
    double limit = -1;  ///< how far the side may go there
    double top = 0;     ///< elevation
    bool last = false;  ///< beside the end of the side
  };

  /// How far the sides may go from point i.
  double foot(std::size_t i) const {
    return half_ +
           line_.foot_heights * spec_.side_slope * std::max(0.0, crest_[i] - line_.ground_m[i]);
  }

  void lay_piece(std::size_t i) {
    const Grid& g = ground_.grid;
    const Vec2 &a = line_.points[i], &b = line_.points[i + 1];
    const double reach = std::max(foot(i), foot(i + 1));
    const Window near = window_around({a, b}, reach + g.cell_m, g);
    const Vec2 along = b - a;
    const double length2 = along.squaredNorm();
    for (int r = near.row0; r < near.end_row(); ++r)
      for (int c = near.col0; c < near.end_col(); ++c) {
        if (!window_.contains(r, c)) continue;
        const Vec2 p(g.x_center(c), g.y_center(r));
        const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
        Nearest one;
        one.distance = (p - a - t * along).norm();
        one.limit = foot(i) + t * (foot(i + 1) - foot(i));
        const double crest = crest_[i] + t * (crest_[i + 1] - crest_[i]);
        const double beyond = one.distance - half_;
        one.top = beyond > 0 ? crest - beyond / spec_.side_slope : crest;
        one.last = beyond > 0 && one.distance > one.limit - 1.5 * g.cell_m;
        take(one, nearest_[static_cast<std::size_t>(r - window_.row0) * window_.n_cols +
                           static_cast<std::size_t>(c - window_.col0)]);
      }
  }

  /// At the same distance from two places the higher one holds.
  static void take(const Nearest& one, Nearest& known) {
    if (one.distance < known.distance || (one.distance == known.distance && one.top > known.top))
      known = one;
  }

  const DamLine& line_;
  const DamSpec& spec_;
  double half_;
  const Raster<double>& ground_;
  std::vector<double> crest_;
  Window window_;
  std::vector<Nearest> nearest_;  ///< [cells of window_]
};

}  // namespace

Window window_around(const std::vector<Vec2>& points, double margin_m, const Grid& g) {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const Vec2& p : points) {
    west = std::min(west, p.x()), east = std::max(east, p.x());
    south = std::min(south, p.y()), north = std::max(north, p.y());
  }
  const auto cell = [](double at, int n) {
    return static_cast<int>(std::floor(std::clamp(at, -1.0, n + 1.0)));
  };
  return window_between(cell((g.north_m - north - margin_m) / g.cell_m, g.n_rows),
                        cell((g.north_m - south + margin_m) / g.cell_m, g.n_rows) + 1,
                        cell((west - margin_m - g.west_m) / g.cell_m, g.n_cols),
                        cell((east + margin_m - g.west_m) / g.cell_m, g.n_cols) + 1, g);
}

DamFacts& DamFacts::operator+=(const DamFacts& o) {
  if (o.cells == 0) return *this;
  lowest_crest_m = cells > 0 ? std::min(lowest_crest_m, o.lowest_crest_m) : o.lowest_crest_m;
  highest_crest_m = cells > 0 ? std::max(highest_crest_m, o.highest_crest_m) : o.highest_crest_m;
  cells += o.cells, fill_m3 += o.fill_m3;
  highest_m = std::max(highest_m, o.highest_m);
  crest_width_m = std::max(crest_width_m, o.crest_width_m);
  cut = cut || o.cut;
  return *this;
}

std::vector<double> crest_of(const DamLine& line, const DamSpec& spec) {
  std::vector<double> crest(line.points.size());
  if (spec.crest_elevation_m) {
    std::fill(crest.begin(), crest.end(), spec.crest_elevation_m->value);
    return crest;
  }
  const double height = line.height_m ? *line.height_m : spec.height_m->value;
  for (std::size_t i = 0; i < crest.size(); ++i) crest[i] = line.ground_m[i] + height;
  return crest;
}

double farthest_side(const DamLine& line, const DamSpec& spec, double crest_width_m) {
  const std::vector<double> crest = crest_of(line, spec);
  double most = 0;
  for (std::size_t i = 0; i < crest.size(); ++i) most = std::max(most, crest[i] - line.ground_m[i]);
  return 0.5 * crest_width_m + line.foot_heights * spec.side_slope * most;
}

double standing_width(const DamSpec& spec, double cell_m) {
  // Every cell that the line crosses has its centre within half a diagonal of it.
  return std::max(spec.crest_width_m, std::numbers::sqrt2 * cell_m);
}

DamFacts raise_dam(const DamLine& line, const DamSpec& spec, double crest_width_m,
                   Raster<double>& ground) {
  Body body(line, spec, crest_width_m, ground);
  body.lay();
  DamFacts facts;
  const std::vector<double> crest = crest_of(line, spec);
  facts.crest_width_m = crest_width_m;
  facts.lowest_crest_m = *std::min_element(crest.begin(), crest.end());
  facts.highest_crest_m = *std::max_element(crest.begin(), crest.end());
  const double cell_area = ground.grid.cell_m * ground.grid.cell_m;
  body.each([&](std::size_t cell, double top, bool last) {
    const double raise = top - ground.values[cell];
    if (!(raise > 0)) return;  // nodata stays
    ground.values[cell] = top;
    facts.cut = facts.cut || last;
    ++facts.cells;
    facts.fill_m3 += raise * cell_area;
    facts.highest_m = std::max(facts.highest_m, raise);
  });
  return facts;
}

DamFacts raise_dams(const GroundStructures& structures, const std::vector<DamSpec>& dams,
                    WhichDams which, Raster<double>& ground) {
  DamFacts facts;
  for (const DamLine& line : structures.dams) {
    const bool by_member = structures.by_member[line.dam];
    if (which != WhichDams::all && by_member != (which == WhichDams::by_member)) continue;
    const DamSpec& spec = dams[line.dam];
    facts += raise_dam(line, spec, standing_width(spec, ground.grid.cell_m), ground);
  }
  return facts;
}

}  // namespace sturz
