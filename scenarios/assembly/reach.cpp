// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/reach.hpp"

#include "engine/core/constants.hpp"
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/inflow/inflow_plan.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/checks/distribution_check.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace sturz {
namespace {

/// Of unbounded distributions: one value in 30,000 lies farther out.
constexpr double tail = 4;
/// First look around the release, and least growth [cells].
constexpr int first_look = 64;
/// Around a reach: so many cells, spacings, and this part of its longer side.
constexpr int least_margin = 48;
constexpr double margin_spacings = 12, margin_share = 0.1;

constexpr std::array<const char*, 4> ends{"north", "east", "south", "west"};

/// Where the flood met the end of what is known.
struct Meeting {
  std::array<bool, 4> window_side{};  ///< north, east, south, west: the raster goes on there
  double above_end_m = 0;
  int end = 0;
  double above_unknown_m = 0;
};

/// Spreads from the release over all cells under the line, within one window.
class Flood {
 public:
  Flood(const EnergyLine& line, const Grid& whole, const Raster<double>& ground, const Window& w)
      : line_(line), whole_(whole), ground_(ground), w_(w), seen_(w.n_cells(), 0) {
    box_ = {w.end_row(), w.end_col(), 0, 0};
    row1_ = col1_ = -1;
  }

  void run() {
    for (int r = line_.release.row0; r < line_.release.end_row(); ++r)
      for (int c = line_.release.col0; c < line_.release.end_col(); ++c) visit(r, c);
    while (!open_.empty()) {
      const std::uint32_t i = open_.back();
      open_.pop_back();
      const int r = w_.row0 + static_cast<int>(i / static_cast<std::uint32_t>(w_.n_cols));
      const int c = w_.col0 + static_cast<int>(i % static_cast<std::uint32_t>(w_.n_cols));
      for (int dr = -1; dr <= 1; ++dr)
        for (int dc = -1; dc <= 1; ++dc)
          if (dr != 0 || dc != 0) step_to(r, c, r + dr, c + dc);
    }
  }

  const Meeting& meeting() const { return meeting_; }
  Window box() const {
    return {box_.row0, box_.col0, row1_ - box_.row0 + 1, col1_ - box_.col0 + 1};
  }
  double lowest() const { return lowest_; }
  double farthest() const { return farthest_; }

 private:
  double distance(int r, int c) const {
    const Window& m = line_.release;
    const double dr = std::max({m.row0 - r, r - (m.end_row() - 1), 0});
    const double dc = std::max({m.col0 - c, c - (m.end_col() - 1), 0});
    return std::hypot(dr, dc) * whole_.cell_m;
  }
  double line_at(int r, int c) const { return line_.top_m - line_.friction * distance(r, c); }

  void step_to(int from_row, int from_col, int r, int c) {
    if (w_.contains(r, c) && !std::isnan(z(r, c))) return visit(r, c);
    const double above = line_at(from_row, from_col) - z(from_row, from_col);
    if (w_.contains(r, c)) {
      meeting_.above_unknown_m = std::max(meeting_.above_unknown_m, above);
      return;
    }
    const int side = r < w_.row0 ? 0 : c >= w_.end_col() ? 1 : r >= w_.end_row() ? 2 : 3;
    if (whole_.contains(r, c)) {
      meeting_.window_side[static_cast<std::size_t>(side)] = true;
      return;
    }
    if (above > meeting_.above_end_m) meeting_.above_end_m = above, meeting_.end = side;
  }

  double z(int r, int c) const { return ground_.at(r - w_.row0, c - w_.col0); }

  void visit(int r, int c) {
    const std::size_t i =
        static_cast<std::size_t>(r - w_.row0) * w_.n_cols + static_cast<std::size_t>(c - w_.col0);
    if (seen_[i]) return;
    const bool released = line_.release.contains(r, c);
    const double ground = z(r, c);
    if (std::isnan(ground) || (!released && !(ground < line_at(r, c)))) return;
    seen_[i] = 1;
    box_.row0 = std::min(box_.row0, r), row1_ = std::max(row1_, r);
    box_.col0 = std::min(box_.col0, c), col1_ = std::max(col1_, c);
    lowest_ = std::min(lowest_, ground);
    farthest_ = std::max(farthest_, distance(r, c));
    open_.push_back(static_cast<std::uint32_t>(i));
  }

  const EnergyLine& line_;
  const Grid& whole_;
  const Raster<double>& ground_;
  const Window w_;
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint32_t> open_;
  Meeting meeting_;
  Window box_;
  int row1_, col1_;
  double lowest_ = std::numeric_limits<double>::infinity(), farthest_ = 0;
};

/// Grows by half of the window's length on the sides where the line goes on.
Window grown(const Window& w, const std::array<bool, 4>& side, const Grid& whole) {
  const int rows = std::max(first_look, w.n_rows / 2), cols = std::max(first_look, w.n_cols / 2);
  return window_between(w.row0 - (side[0] ? rows : 0), w.end_row() + (side[2] ? rows : 0),
                        w.col0 - (side[3] ? cols : 0), w.end_col() + (side[1] ? cols : 0), whole);
}

/// Diagonal of a window [m].
double diagonal(const Window& w, double cell_m) { return std::hypot(w.n_rows, w.n_cols) * cell_m; }

/// Greatest vertical thickness that any member releases [m].
double greatest_thickness(const ReleaseSpec& spec, const SceneInputs& in) {
  const Raster<double>& pattern = *in.release;
  double most = 0, sum = 0;
  for (const double h : pattern.values)
    if (h > 0) most = std::max(most, h), sum += h;
  const double cell_area = pattern.grid.cell_m * pattern.grid.cell_m;
  if (spec.volume_m3 && sum > 0)
    return most * std::max(0.0, drawn_range(*spec.volume_m3).second) / (sum * cell_area);
  if (in.pattern == ReleasePattern::cover && spec.thickness_m)
    return most * std::max(0.0, drawn_range(*spec.thickness_m).second);
  return most;
}

/// What the yield stress bears of the greatest load.
double least_liquid_friction(const Scenario& s, const SceneInputs& in) {
  const FluidSpec& fluid = *s.fluid;
  const double yield =
      fluid.yield_stress_pa ? std::max(0.0, drawn_range(*fluid.yield_stress_pa).first) : 0;
  const double load = drawn_range(fluid.density_kg_m3).second * standard_gravity *
                      greatest_thickness(s.release, in);
  return std::max(liquid_friction, load > 0 ? yield / load : 0);
}

/// The friction of grains on what they bear of the weight of both, and what loose ones that shear
/// liquefies keep of it.
double least_wet_share(const Scenario& s, double pore_pressure) {
  Scenario lightest = s;
  lightest.grains->density_kg_m3 = Uncertain(drawn_range(s.grains->density_kg_m3).first);
  lightest.grains->solid_fraction = Uncertain(drawn_range(s.grains->solid_fraction).first);
  lightest.fluid->density_kg_m3 = Uncertain(drawn_range(s.fluid->density_kg_m3).second);
  lightest.fluid->saturation = Uncertain(std::min(1.0, drawn_range(s.fluid->saturation).second));
  const bool liquefies = s.coupling && s.coupling->critical_solid_fraction &&
                         lightest.grains->solid_fraction.value <
                             drawn_range(*s.coupling->critical_solid_fraction).second;
  if (liquefies) return liquefied_share;
  return std::max(liquefied_share, weight_on_grains(lightest) * (1 - pore_pressure));
}

double least_friction(const Scenario& s, const SceneInputs& in) {
  if (is_liquid_alone(s)) return least_liquid_friction(s, in);
  const double friction = drawn_bed_range(s, in, BedNumber::friction).first;
  double pore_pressure = drawn_bed_range(s, in, BedNumber::pore_pressure).second;
  if (s.fluid)
    return std::max(0.0, friction) * least_wet_share(s, std::clamp(pore_pressure, 0.0, 1.0));
  // A mixture may liquefy on its way; what runs farther than this asks for more ground.
  if (s.mixture) pore_pressure = 1 - liquefied_share;
  return std::max(0.0, friction) * std::clamp(1 - pore_pressure, 0.0, 1.0);
}

}  // namespace

std::pair<double, double> drawn_range(const Uncertain& u) {
  auto [low, high] = support(u);
  if (!u.distribution) return {low, high};
  const Distribution& d = *u.distribution;
  using enum Distribution::Kind;
  const bool in_logs = d.kind == lognormal;
  const double below = in_logs ? d.median * std::exp(-tail * d.sigma_ln) : d.mean - tail * d.sd;
  const double above = in_logs ? d.median * std::exp(tail * d.sigma_ln) : d.mean + tail * d.sd;
  if (d.kind == normal || in_logs) low = std::max(low, below), high = std::min(high, above);
  return {low, std::max(low, high)};
}

EnergyLine energy_line(const Scenario& s, const SceneInputs& in, double surface_m) {
  EnergyLine line;
  const Raster<double>& release = *in.release;
  const Window at = window_of(release.grid, in.terrain_grid());
  Window tight;
  for (int r = 0; r < release.grid.n_rows; ++r)
    for (int c = 0; c < release.grid.n_cols; ++c)
      if (release.at(r, c) > 0) tight = joined(tight, {at.row0 + r, at.col0 + c, 1, 1});
  for (const InflowSource& source : in.inflow)
    tight = joined(tight, cells_below(source, in.terrain_grid()));
  line.release = tight;
  const auto& v = s.release.velocity_m_s;
  const double start2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const bool on_top = s.release.surface == ReleaseSurface::bed;
  line.top_m = surface_m + (on_top ? greatest_thickness(s.release, in) : 0) +
               start2 / (2 * standard_gravity);
  for (std::size_t i = 0; i < in.inflow.size(); ++i)
    line.top_m = std::max(line.top_m, surface_m + greatest_head(s.inflow[i], in.inflow[i]));
  line.friction = least_friction(s, in);
  return line;
}

Reach followed(const EnergyLine& line, const Grid& whole, const ReadGround& read,
               double most_cells) {
  Window w = widened(line.release, first_look, whole);
  for (;;) {
    const Raster<double> ground = read(w);
    Flood flood(line, whole, ground, w);
    flood.run();
    const Meeting& met = flood.meeting();
    const Window next = grown(w, met.window_side, whole);
    const bool cut = next != w && static_cast<double>(next.n_cells()) > most_cells;
    if (next != w && !cut) {
      w = next;
      continue;
    }
    Reach reach;
    reach.window = joined(flood.box(), line.release);
    reach.lowest_m = flood.lowest();
    reach.length_m = cut ? diagonal(whole_of(whole), whole.cell_m)
                         : flood.farthest() + diagonal(line.release, whole.cell_m);
    reach.friction = line.friction;
    reach.cut = cut;
    reach.above_end_m = met.above_end_m;
    if (met.above_end_m > 0) reach.end = ends[static_cast<std::size_t>(met.end)];
    reach.above_unknown_m = met.above_unknown_m;
    return reach;
  }
}

Window with_margin(const Window& w, const Grid& whole, double spacing_m) {
  const double cells = std::max({double(least_margin), margin_spacings * spacing_m / whole.cell_m,
                                 margin_share * std::max(w.n_rows, w.n_cols)});
  return widened(w, static_cast<int>(std::min(cells, 1e6)) + 1, whole);
}

Window larger_window(const Window& first, int level, const Grid& whole) {
  Window w = first;
  for (int i = 0; i < level && w != whole_of(whole); ++i)
    w = window_between(w.row0 - std::max(first_look, w.n_rows / 2),
                       w.end_row() + std::max(first_look, w.n_rows / 2),
                       w.col0 - std::max(first_look, w.n_cols / 2),
                       w.end_col() + std::max(first_look, w.n_cols / 2), whole);
  return w;
}

}  // namespace sturz
