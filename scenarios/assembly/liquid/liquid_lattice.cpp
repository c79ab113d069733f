// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/liquid/liquid_lattice.hpp"

#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/liquid/pool.hpp"
#include "scenarios/assembly/scene_plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace sturz {
namespace {

/// Less of a layer, of a stack or of a cell than this is no particle of its own; its mass goes to
/// others [-].
constexpr double thinnest = 0.2;
/// Shallower water than this has none: particles lie half a spacing above the bed [spacings].
constexpr double shallowest = 0.5;

class Layout {
 public:
  Layout(const Scenario& s, const SceneInputs& in, const ScenePlan& plan, std::int64_t member)
      : s_(s), in_(in), plan_(plan), dx_(s.numerics.spacing_m) {
    settings_ = {dx_,  s.fluid->density_kg_m3.value, s.numerics.jitter, s.ensemble.seed, member,
                 false};
    if (s.fluid->pool) pool_ = pool_of(s, in, plan.bed);
    pores_ = s.grains ? 1 - s.grains->solid_fraction.value : 1;
    if (s.grains && has_buoyancy(s))
      lifted_ = s.fluid->density_kg_m3.value / s.grains->density_kg_m3.value;
  }

  LiquidLattice all(const Raster<double>& thickness) {
    const Release& r = plan_.release;
    out_.grain_depth.resize(r.x.size());
    for (std::size_t i = 0; i < r.x.size();) {
      const std::size_t k = std::min(layers_of(r.thickness[i], dx_), r.x.size() - i);
      fill_stack(i, k);
      i += k;
    }
    out_.n_in_release = out_.size();
    if (pool_) fill_pool(thickness);
    for (const double d : out_.depth) out_.deepest_m = std::max(out_.deepest_m, d);
    return std::move(out_);
  }

 private:
  /// The pores of the k particles of a stack that starts at i.
  void fill_stack(std::size_t i, std::size_t k) {
    const Release& r = plan_.release;
    const double h = r.thickness[i], layer = h / static_cast<double>(k);
    const double foot = plan_.bed.height(r.x[i], r.y[i]);
    const bool under = pool_ && pool_->covers(r.x[i], r.y[i]);
    const double stands = under ? pool_->surface_m - foot : 0;
    const double filled = std::clamp(std::max(s_.fluid->saturation.value * h, stands), 0.0, h);
    const double layers = filled / layer, dry = h - filled;
    const auto full = std::min(k, static_cast<std::size_t>(std::floor(layers + 1e-9)));
    const double rest = std::max(0.0, layers - static_cast<double>(full));
    const bool apart = rest >= thinnest || (full == 0 && rest > 1e-9);
    for (std::size_t n = 0; n < k; ++n) {
      const std::size_t at = i + n;
      const double depth = r.depth[at];
      out_.grain_depth[at] = depth - lifted_ * std::max(0.0, depth - dry);
      double share = n < full ? 1 : n == full && apart ? rest : 0;
      if (n + 1 == full && !apart && full < k) share += rest;
      if (!(share > 0)) continue;
      // In the middle of what is filled, but no nearer to the bed than particles lie.
      const double lower = share < 1 && n > 0 ? 0.5 * (1 - share) * layer : 0;
      const double z = r.z[at] - lower;
      const double own = std::max(0.0, depth + lower - dry);
      const double pores = s_.grains ? liquid_of(r.mass[at]) : r.mass[at];
      put(r.x[at], r.y[at], z, share * pores, under ? std::max(own, pool_->surface_m - z) : own);
    }
  }

  /// Mass that fills the pores of a released mass.
  double liquid_of(double released) const {
    return pores_ * settings_.bulk_density_kg_m3 * (released / plan_.bulk_density_kg_m3);
  }
  void put(double x, double y, double z, double mass, double depth) {
    out_.x.push_back(x), out_.y.push_back(y), out_.z.push_back(z);
    out_.mass.push_back(mass);
    out_.depth.push_back(depth);
  }

  void fill_pool(const Raster<double>& thickness) {
    out_.pool_m3 = pool_->volume_m3;
    out_.pool_area_m2 = pool_->area_m2, out_.pool_depth_m = pool_->deepest_m;
    out_.open_edge_m = pool_->open_edge_m;
    Raster<double> depth = pool_->share, cover = pool_->share;
    const bool any = measure_above(thickness, depth, cover);
    if (!any) return;
    const ReleaseColumns above = release_columns(depth, dx_, &cover);
    std::map<std::pair<std::int64_t, std::int64_t>, double> feet;
    for (const ReleaseColumn& c : release_columns(thickness, dx_).columns)
      if (c.thickness_m >= thinnest * dx_) feet[{c.lattice_x, c.lattice_y}] = c.thickness_m;
    std::vector<UpperColumn> columns;
    for (const ReleaseColumn& c : above.columns) {
      const auto foot = feet.find({c.lattice_x, c.lattice_y});
      UpperColumn upper{c, 0, 0};
      if (foot != feet.end())
        upper.base_m = foot->second, upper.first_layer = layers_of(foot->second, dx_);
      if (holds_particles(c)) columns.push_back(upper);
    }
    const Release water = fill_columns(plan_.bed, columns, settings_, above.volume_m3);
    for (std::size_t i = 0; i < water.x.size(); ++i) {
      Vec3 p(water.x[i], water.y[i], water.z[i]);
      keep_off_walls(p);
      put(p.x(), p.y(), p.z(), water.mass[i], std::max(0.0, pool_->surface_m - p.z()));
    }
  }

  /// Depth over what lies on the bed, times the share of each cell, and the share where there is
  /// any. \return whether there is
  bool measure_above(const Raster<double>& thickness, Raster<double>& depth,
                     Raster<double>& cover) const {
    const Grid &whole = in_.terrain_grid(), &g = depth.grid;
    const Window at = window_of(g, whole), held = window_of(thickness.grid, whole);
    bool any = false;
    for (int r = 0; r < g.n_rows; ++r)
      for (int c = 0; c < g.n_cols; ++c) {
        const int row = at.row0 + r, col = at.col0 + c;
        double top = cover.at(r, c) > 0 ? bed_at(plan_.bed, in_, row, col) : nan_d;
        if (held.contains(row, col)) top += thickness.at(row - held.row0, col - held.col0);
        const bool wet = pool_->surface_m > top;
        depth.at(r, c) = wet ? cover.at(r, c) * (pool_->surface_m - top) : 0;
        if (!wet) cover.at(r, c) = 0;
        any = any || wet;
      }
    return any;
  }

  /// A thin film has none, nor has a cell whose middle lies behind a wall.
  bool holds_particles(const ReleaseColumn& c) const {
    if (c.covered < thinnest || c.thickness_m < shallowest * dx_ * c.covered) return false;
    const double x = (static_cast<double>(c.lattice_x) + 0.5) * dx_;
    const double y = (static_cast<double>(c.lattice_y) + 0.5) * dx_;
    const auto& walls = plan_.domain.walls;
    return plan_.bed.inside(x, y) && std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
             return (x - wall.point.x()) * wall.normal.x() +
                        (y - wall.point.y()) * wall.normal.y() >
                    0;
           });
  }
  void keep_off_walls(Vec3& p) const {
    for (const Wall& wall : plan_.domain.walls) {
      const double d = (p - wall.point).dot(wall.normal);
      if (d < 0.5 * dx_) p += (0.5 * dx_ - d) * wall.normal;
    }
  }

  const Scenario& s_;
  const SceneInputs& in_;
  const ScenePlan& plan_;
  double dx_;
  ReleaseSettings settings_;
  std::optional<Pool> pool_;
  double pores_ = 1, lifted_ = 0;
  LiquidLattice out_;
};

}  // namespace

LiquidLattice lay_out_liquid(const Scenario& s, const SceneInputs& in, const ScenePlan& plan,
                             const Raster<double>& thickness, std::int64_t member) {
  return Layout(s, in, plan, member).all(thickness);
}

}  // namespace sturz
