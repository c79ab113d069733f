// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/peak_maps.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz {
namespace {

/// Quadratic B-spline of unit width: support 1.5 each side, integral one.
double b_spline(double t) {
  const double outer = std::max(0.0, 1.5 - std::abs(t)), inner = std::max(0.0, 0.5 - std::abs(t));
  return 0.5 * outer * outer - 1.5 * inner * inner;
}

/// Weights of one particle along one direction, summing to one over the cells on and off the grid.
/// \tparam n_fixed number of cells known to the compiler, 0: `n_cells` says it
/// \param place   in cells from the centre of cell 0
/// \return the first cell
template <int n_fixed>
int spread(double place, double width_cells, int n_cells, double* weight) {
  const int n = n_fixed > 0 ? n_fixed : n_cells;
  const double first = std::floor(place - 1.5 * width_cells) + 1;
  const double per_width = 1 / width_cells;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    weight[k] = b_spline((place - first - k) * per_width);
    sum += weight[k];
  }
  const double scale = 1 / sum;
  for (int k = 0; k < n; ++k) weight[k] *= scale;
  return static_cast<int>(first);
}

/// Bins of layers: 24 per factor of ten, one edge exactly at four layers.
constexpr double bins_per_decade = 24;
constexpr double first_exponent = -2.5;

double layers_at(double bin) { return 4 * std::pow(10, first_exponent + bin / bins_per_decade); }

int layer_bin(double layers) {
  const double bin = (std::log10(layers / 4) - first_exponent) * bins_per_decade;
  return std::clamp(static_cast<int>(bin), 0, 127);
}

/// Width of a particle's spread [cells]: rounded alike wherever room for its weights is counted.
double cells_wide(double width_m, double cell_m) { return std::max(1.0, width_m / cell_m); }

/// Room is added with this margin so that a spreading flow seldom moves the arrays [cells].
int margin(int n) { return 8 + n / 8; }

/// Rows row0..row1 and columns col0..col1 that lie on the grid.
Window clipped(double row0, double row1, double col0, double col1, const Grid& g) {
  if (!(row0 <= row1 && col0 <= col1)) return {};
  row0 = std::max(row0, 0.0), row1 = std::min(row1, g.n_rows - 1.0);
  col0 = std::max(col0, 0.0), col1 = std::min(col1, g.n_cols - 1.0);
  if (row0 > row1 || col0 > col1) return {};
  return {static_cast<int>(row0), static_cast<int>(col0), static_cast<int>(row1 - row0) + 1,
          static_cast<int>(col1 - col0) + 1};
}

bool inside(const Window& outer, const Window& inner) {
  return inner.row0 >= outer.row0 && inner.col0 >= outer.col0 &&
         inner.row0 + inner.n_rows <= outer.row0 + outer.n_rows &&
         inner.col0 + inner.n_cols <= outer.col0 + outer.n_cols;
}

}  // namespace

PeakMaps::PeakMaps(PeakMapSettings settings) : settings_(std::move(settings)) {
  expect(settings_.grid.n_cells() > 0 && settings_.grid.cell_m > 0, "the hazard grid has cells");
}

/// Columns bring their own widths.
PeakMaps::Width PeakMaps::width_of(const MovingSet& p) const {
  const Field* support_radius = p.find(fields::support_radius);
  Width w;
  w.support_radius = support_radius ? support_radius->component[0].data() : nullptr;
  double width_m = p.spacing;
  if (support_radius && p.size() > 0) {
    const auto& all = support_radius->component[0];
    width_m = settings_.width_per_radius * *std::max_element(all.begin(), all.end());
  }
  w.cells = cells_wide(width_m, settings_.grid.cell_m);
  w.n_weights = static_cast<int>(std::ceil(3 * w.cells));
  return w;
}

/// Widths of all sets, and the cells that they can touch.
Window PeakMaps::bounds_of(std::span<const MovingSet> sets) {
  expect(!sets.empty() && (mass_.empty() || mass_.size() == sets.size()), "the sets stay the same");
  mass_.resize(sets.size());
  widths_.clear();
  Window all;
  for (const MovingSet& set : sets) {
    expect(set.spacing > 0 && set.bulk_density > 0, "spacing and bulk density are positive");
    widths_.push_back(width_of(set));
    all = joined(all, cover(set, widths_.back()));
    const auto n = static_cast<std::size_t>(widths_.back().n_weights);
    weights_x_.resize(std::max(weights_x_.size(), n));
    weights_y_.resize(std::max(weights_y_.size(), n));
  }
  return all;
}

/// The cells that the particles can touch.
Window PeakMaps::cover(const ParticleSet& p, const Width& width) const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  double west = inf, east = -inf, south = inf, north = -inf;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isfinite(p.x[i]) || !std::isfinite(p.y[i])) continue;
    west = std::min(west, p.x[i]), east = std::max(east, p.x[i]);
    south = std::min(south, p.y[i]), north = std::max(north, p.y[i]);
  }
  const Grid& g = settings_.grid;
  const double per_cell = 1 / g.cell_m, support = 1.5 * width.cells + 1;
  return clipped(std::floor((g.north_m - north) * per_cell - support),
                 std::ceil((g.north_m - south) * per_cell + support),
                 std::floor((west - g.west_m) * per_cell - support),
                 std::ceil((east - g.west_m) * per_cell + support), g);
}

void PeakMaps::make_room(const Window& w) {
  if (w.n_cells() == 0 || inside(room_, w)) return;
  const Window all = joined(room_, w);
  const int dr = margin(all.n_rows), dc = margin(all.n_cols);
  const Window next = clipped(all.row0 - dr, all.row0 + all.n_rows - 1 + dr, all.col0 - dc,
                              all.col0 + all.n_cols - 1 + dc, settings_.grid);
  std::vector<Peak> peak(next.n_cells());
  for (int r = 0; r < room_.n_rows; ++r)
    std::copy_n(peak_.begin() + static_cast<std::ptrdiff_t>(r) * room_.n_cols, room_.n_cols,
                peak.begin() +
                    static_cast<std::ptrdiff_t>(r + room_.row0 - next.row0) * next.n_cols +
                    (room_.col0 - next.col0));
  peak_.swap(peak);
  room_ = next;
  for (auto& mass : mass_) mass.assign(next.n_cells(), 0.0);
  motion_.assign(next.n_cells(), Motion::Zero());
}

/// Adds one particle to the cells of the room that it touches.
/// \tparam n_fixed number of cells per direction, known to the compiler; 0: `n_cells` says it
template <bool with_motion, int n_fixed>
inline void PeakMaps::add_one(const Room& room, double x, double y, double width, int n_cells,
                              double particle_mass, const Motion& motion) {
  const int n = n_fixed > 0 ? n_fixed : n_cells;
  const int col = spread<n_fixed>(x, width, n, room.wx),
            row = spread<n_fixed>(y, width, n, room.wy);
  const int j0 = std::max(0, -col), j1 = std::min(n, room.n_cols - col);
  const int i0 = std::max(0, -row), i1 = std::min(n, room.n_rows - row);
  for (int k = i0; k < i1; ++k) {
    const double mass_in_row = particle_mass * room.wy[k];
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row + k) * room.n_cols + col;
    for (int j = j0; j < j1; ++j) {
      const double mass = mass_in_row * room.wx[j];
      room.mass[at + j] += mass;
      if constexpr (with_motion) room.motion[at + j] += mass * motion;
    }
  }
}

/// Adds every particle. Narrow spreads, the usual ones, get loops of known length: twice as fast.
template <bool with_motion>
void PeakMaps::scatter_set(const ParticleSet& p, const Width& spread, std::vector<double>& mass) {
  const Grid& g = settings_.grid;
  const double per_cell = 1 / g.cell_m, far = 1.5 * spread.cells + 1;
  const double width_per_radius = settings_.width_per_radius, cell = g.cell_m;
  const double* const support_radius = spread.support_radius;
  // Copies, because the compiler must assume that writing a double may change any member.
  const Room room{weights_x_.data(), weights_y_.data(), mass.data(),
                  motion_.data(),    room_.n_rows,      room_.n_cols};
  const double col0 = room_.col0, row0 = room_.row0;
  double width = spread.cells;
  int n = spread.n_weights;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = (p.x[i] - g.west_m) * per_cell - 0.5 - col0;
    const double y = (g.north_m - p.y[i]) * per_cell - 0.5 - row0;
    const double vx = p.vx[i], vy = p.vy[i], vz = p.vz[i];
    const double v2 = vx * vx + vy * vy + vz * vz;
    if (!(x > -far && x < room.n_cols + far && y > -far && y < room.n_rows + far) ||
        !std::isfinite(v2))
      continue;
    const Motion motion(vx, vy, vz, 0.5 * v2);
    if (support_radius) {
      width = cells_wide(width_per_radius * support_radius[i], cell);
      n = static_cast<int>(std::ceil(3 * width));
    }
    switch (n) {
      case 3:
        add_one<with_motion, 3>(room, x, y, width, n, p.mass[i], motion);
        break;
      case 4:
        add_one<with_motion, 4>(room, x, y, width, n, p.mass[i], motion);
        break;
      case 5:
        add_one<with_motion, 5>(room, x, y, width, n, p.mass[i], motion);
        break;
      case 6:
        add_one<with_motion, 6>(room, x, y, width, n, p.mass[i], motion);
        break;
      default:
        add_one<with_motion, 0>(room, x, y, width, n, p.mass[i], motion);
    }
  }
}

template <bool with_motion>
void PeakMaps::scatter(std::span<const MovingSet> sets) {
  for (std::size_t k = 0; k < sets.size(); ++k)
    scatter_set<with_motion>(sets[k], widths_[k], mass_[k]);
}

/// Takes the instant's sums into the peaks and clears them.
void PeakMaps::keep_peaks(std::span<const MovingSet> sets, const Window& w, float time_s) {
  const double per_area = 1 / (settings_.grid.cell_m * settings_.grid.cell_m);
  const std::size_t n_sets = sets.size();
  double total = 0;
  mass_by_layers_.fill(0);
  for (int r = w.row0 - room_.row0; r < w.row0 - room_.row0 + w.n_rows; ++r)
    for (int c = w.col0 - room_.col0; c < w.col0 - room_.col0 + w.n_cols; ++c) {
      const std::size_t k = static_cast<std::size_t>(r) * room_.n_cols + c;
      double mass = 0, thickness = 0;
      for (std::size_t n = 0; n < n_sets; ++n) {
        mass += mass_[n][k];
        thickness += mass_[n][k] * (per_area / sets[n].bulk_density);
      }
      if (mass == 0) continue;
      Peak& peak = peak_[k];
      total += mass;
      for (std::size_t n = 0; n < n_sets; ++n) {
        double layers = 0;
        for (std::size_t m = 0; m < n_sets; ++m)
          layers += mass_[m][k] * (per_area / sets[m].bulk_density / sets[n].spacing);
        mass_by_layers_[layer_bin(layers)] += mass_[n][k];
      }
      peak.thickness = std::max(peak.thickness, static_cast<float>(thickness));
      if (thickness > settings_.runout_limit_m) {
        const double density =
            n_sets == 1 ? sets[0].bulk_density : mass * per_area / thickness;  // of the mixture
        const Motion& sums = motion_[k];
        const double speed = sums.matrix().head<3>().norm() / mass;
        peak.speed = std::max(peak.speed, static_cast<float>(speed));
        peak.energy = std::max(peak.energy, static_cast<float>(sums[3] * per_area));
        peak.pressure = std::max(peak.pressure, static_cast<float>(density * speed * speed));
        if (std::isnan(peak.arrival)) peak.arrival = time_s;
      }
      for (auto& of_set : mass_) of_set[k] = 0;
      motion_[k].setZero();
    }
  count_layers(total);
}

void PeakMaps::count_layers(double total_mass) {
  layers_ = {};
  if (!(total_mass > 0)) return;
  double below = 0;
  bool half = false, tenth = false;
  for (int bin = 0; bin < n_bins; ++bin) {
    if (layers_at(bin + 1) <= 4 * (1 + 1e-12))
      layers_.thin_fraction += mass_by_layers_[bin] / total_mass;
    below += mass_by_layers_[bin];
    const double middle = layers_at(bin + 0.5);
    if (!tenth && below >= 0.1 * total_mass) tenth = true, layers_.p10 = middle;
    if (!half && below >= 0.5 * total_mass) half = true, layers_.median = middle;
  }
}

void PeakMaps::record(std::span<const MovingSet> sets, double time_s) {
  const Window w = bounds_of(sets);
  if (w.n_cells() == 0) return;
  make_room(w);
  scatter<true>(sets);
  keep_peaks(sets, w, static_cast<float>(time_s));
}

void PeakMaps::keep_deposit(std::span<const MovingSet> sets, const Window& w) {
  const double cell_area = settings_.grid.cell_m * settings_.grid.cell_m;
  for (int r = w.row0 - room_.row0; r < w.row0 - room_.row0 + w.n_rows; ++r)
    for (int c = w.col0 - room_.col0; c < w.col0 - room_.col0 + w.n_cols; ++c) {
      const std::size_t k = static_cast<std::size_t>(r) * room_.n_cols + c;
      double thickness = 0;
      for (std::size_t n = 0; n < sets.size(); ++n) {
        thickness += mass_[n][k] * (1 / (sets[n].bulk_density * cell_area));
        mass_[n][k] = 0;
      }
      peak_[k].deposit = static_cast<float>(thickness);
      peak_[k].thickness = std::max(peak_[k].thickness, peak_[k].deposit);
    }
}

Window PeakMaps::tight_window() const {
  int row0 = room_.n_rows, row1 = -1, col0 = room_.n_cols, col1 = -1;
  for (int r = 0; r < room_.n_rows; ++r)
    for (int c = 0; c < room_.n_cols; ++c)
      if (peak_[static_cast<std::size_t>(r) * room_.n_cols + c].thickness > 0) {
        row0 = std::min(row0, r), row1 = std::max(row1, r);
        col0 = std::min(col0, c), col1 = std::max(col1, c);
      }
  if (row1 < 0) return {};
  return {room_.row0 + row0, room_.col0 + col0, row1 - row0 + 1, col1 - col0 + 1};
}

/// Writes layers and window; \return cells reached, cells covered at the end, and maxima.
PeakMaps::Totals PeakMaps::write_layers(MemberResult& result) const {
  result.grid = settings_.grid;
  result.window = tight_window();
  for (auto& layer : result.layers) layer.assign(result.window.n_cells(), 0.0f);
  Totals totals;
  std::size_t k = 0;
  for (int r = 0; r < result.window.n_rows; ++r)
    for (int c = 0; c < result.window.n_cols; ++c, ++k) {
      const Peak& p =
          peak_[static_cast<std::size_t>(result.window.row0 - room_.row0 + r) * room_.n_cols +
                (result.window.col0 - room_.col0 + c)];
      result.layer(PeakLayer::thickness)[k] = p.thickness;
      result.layer(PeakLayer::speed)[k] = p.speed;
      result.layer(PeakLayer::energy)[k] = p.energy;
      result.layer(PeakLayer::pressure)[k] = p.pressure;
      result.layer(PeakLayer::arrival)[k] = p.arrival;
      result.layer(PeakLayer::deposit)[k] = p.deposit;
      totals.reached += !std::isnan(p.arrival);
      totals.covered += p.deposit > settings_.runout_limit_m;
      Peak& most = totals.most;
      most.thickness = std::max(most.thickness, p.thickness);
      most.deposit = std::max(most.deposit, p.deposit);
      most.energy = std::max(most.energy, p.energy);
      most.pressure = std::max(most.pressure, p.pressure);
    }
  return totals;
}

void PeakMaps::finish(std::span<const MovingSet> final_state, MemberResult& result) {
  for (Peak& peak : peak_) peak.deposit = 0;
  const Window w = bounds_of(final_state);
  if (w.n_cells() > 0) {
    make_room(w);
    scatter<false>(final_state);
    keep_deposit(final_state, w);
  }
  const Totals totals = write_layers(result);
  const double cell_area = settings_.grid.cell_m * settings_.grid.cell_m;
  MemberScalars& s = result.scalars;
  s.reached_area_m2 = static_cast<double>(totals.reached) * cell_area;
  s.deposit_area_m2 = static_cast<double>(totals.covered) * cell_area;
  s.max_thickness_m = totals.most.thickness;
  s.max_deposit_m = totals.most.deposit;
  s.max_energy_j_m2 = totals.most.energy;
  s.max_pressure_pa = totals.most.pressure;
}

}  // namespace sturz
