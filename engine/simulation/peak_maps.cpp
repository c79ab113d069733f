// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/peak_maps.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/maps/spread_weights.hpp"
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace sturz {
namespace {

/// Where particles cover this much of a cell, it is reached.
constexpr double enough_cover = 0.75;
/// Half the width of what a particle surely covers, in mean distances. A little less than a half,
/// for at an edge columns seem farther apart than they are.
constexpr double own_share = 0.4;

/// Width of a particle's spread [cells]: rounded alike wherever room for its weights is counted.
double cells_wide(double width_m, double cell_m) { return std::max(1.0, width_m / cell_m); }

/// Rows row0..row1 and columns col0..col1 that lie on the grid.
Window clipped(double row0, double row1, double col0, double col1, const Grid& g) {
  if (!(row0 <= row1 && col0 <= col1)) return {};
  row0 = std::max(row0, 0.0), row1 = std::min(row1, g.n_rows - 1.0);
  col0 = std::max(col0, 0.0), col1 = std::min(col1, g.n_cols - 1.0);
  if (row0 > row1 || col0 > col1) return {};
  return {static_cast<int>(row0), static_cast<int>(col0), static_cast<int>(row1 - row0) + 1,
          static_cast<int>(col1 - col0) + 1};
}

/// The cell of the hazard grid where a particle was last seen; off the grid there is none.
std::optional<std::pair<int, int>> cell_of(const Departure& gone, const Grid& g) {
  if (!std::isfinite(gone.x + gone.y)) return std::nullopt;
  const double row = std::floor((g.north_m - gone.y) / g.cell_m);
  const double col = std::floor((gone.x - g.west_m) / g.cell_m);
  if (!(row >= 0 && row < g.n_rows && col >= 0 && col < g.n_cols)) return std::nullopt;
  return std::pair(static_cast<int>(row), static_cast<int>(col));
}

/// Window of the cells over whose edge mass left.
Window window_of_departures(std::span<const MovingSet> sets, const Grid& g) {
  Window all;
  for (const MovingSet& set : sets)
    for (const Departure& gone : set.departures)
      if (const auto cell = cell_of(gone, g)) all = joined(all, {cell->first, cell->second, 1, 1});
  return all;
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
  w.thickness = p.find(fields::thickness);
  w.ground = p.find(fields::ground);
  w.volume_per_mass = 1 / p.bulk_density;
  double width_m = p.spacing;
  if (support_radius && p.size() > 0) {
    const auto& all = support_radius->component[0];
    width_m = settings_.width_per_radius * *std::max_element(all.begin(), all.end());
  }
  w.cells = cells_wide(width_m, settings_.grid.cell_m);
  w.n_weights = static_cast<int>(std::ceil(3 * w.cells));
  return w;
}

double PeakMaps::Width::area(std::size_t i, double mass, double distance) const {
  const double square = distance * distance;
  if (!thickness || !ground) return square;
  const double h = thickness->component[0][i];
  const Vec3 n = upward_normal(ground->component[0][i], ground->component[1][i]);
  return h > 0 ? std::max(square, mass * volume_per_mass * n.z() / h) : square;
}

/// Widths of all sets, and the cells that they can touch.
Window PeakMaps::bounds_of(std::span<const MovingSet> sets) {
  expect(!sets.empty() && (tiles_.n_sets() == 0 || tiles_.n_sets() == sets.size()),
         "the sets stay the same");
  tiles_.set_n_sets(sets.size());
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

/// Adds what falls on the cells of one tile. \param part  rows and columns of the spread
template <bool with_motion>
inline void PeakMaps::add_part(std::size_t set, const Spread& p, const Window& part) {
  constexpr int edge = PeakTiles::edge;
  const int row0 = p.row + part.row0, col0 = p.col + part.col0;
  const std::size_t slot = tiles_.slot_at(row0 / edge, col0 / edge);
  const int in_col = col0 % edge;
  const auto bits = static_cast<std::uint16_t>(((1U << part.n_cols) - 1U) << in_col);
  const int first = row0 % edge * edge + in_col;
  double* mass = tiles_.mass(set, slot) + first;
  double* coverage = tiles_.coverage(slot) + first;
  Motion* motion = tiles_.motion(slot) + first;
  std::uint16_t* touched = tiles_.touched(slot) + row0 % edge;
  const double* wx = &weights_x_[static_cast<std::size_t>(part.col0)];
  const double* wy = &weights_y_[static_cast<std::size_t>(part.row0)];
  for (int k = 0; k < part.n_rows; ++k, mass += edge, coverage += edge, motion += edge) {
    touched[k] |= bits;
    const double mass_in_row = p.mass * wy[k], area_in_row = p.area * wy[k];
    for (int j = 0; j < part.n_cols; ++j) {
      const double m = mass_in_row * wx[j];
      mass[j] += m;
      coverage[j] += area_in_row * wx[j];
      if constexpr (with_motion) motion[j] += m * p.motion;
    }
  }
}

/// Adds one particle to the cells on the grid that it touches, tile by tile.
template <bool with_motion>
inline void PeakMaps::add_one(std::size_t set, const Spread& p) {
  constexpr int edge = PeakTiles::edge;
  const Grid& g = settings_.grid;
  const int row1 = std::min(p.row + p.n, g.n_rows), col1 = std::min(p.col + p.n, g.n_cols);
  const int from_col = std::max(p.col, 0);
  for (int row = std::max(p.row, 0); row < row1;) {
    const int next_row = std::min(row1, (row / edge + 1) * edge);
    for (int col = from_col; col < col1;) {
      const int next_col = std::min(col1, (col / edge + 1) * edge);
      add_part<with_motion>(set, p, {row - p.row, col - p.col, next_row - row, next_col - col});
      col = next_col;
    }
    row = next_row;
  }
}

/// Covers the cells whose centre lies under the particle itself, and the one that it is in.
void PeakMaps::cover_own(double x, double y, double half_width) {
  const Grid& g = settings_.grid;
  const int row0 = std::max(0, static_cast<int>(std::ceil(y - half_width)));
  const int col0 = std::max(0, static_cast<int>(std::ceil(x - half_width)));
  const int row1 = std::min(g.n_rows, static_cast<int>(std::ceil(y + half_width)));
  const int col1 = std::min(g.n_cols, static_cast<int>(std::ceil(x + half_width)));
  constexpr int edge = PeakTiles::edge;
  for (int row = row0; row < row1; ++row)
    for (int col = col0; col < col1; ++col)
      tiles_.coverage(tiles_.slot_at(row / edge, col / edge))[row % edge * edge + col % edge] +=
          enough_cover;
}

template <bool with_motion>
void PeakMaps::scatter_set(const MovingSet& p, std::size_t set) {
  const Grid& g = settings_.grid;
  const Width& widest = widths_[set];
  const double per_cell = 1 / g.cell_m, far = 1.5 * widest.cells + 1;
  const double distance_per_radius = settings_.width_per_radius / 1.5, spacing = p.spacing;
  double width = widest.cells;
  Spread one;
  one.n = widest.n_weights;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = (p.x[i] - g.west_m) * per_cell - 0.5;
    const double y = (g.north_m - p.y[i]) * per_cell - 0.5;
    const double vx = p.vx[i], vy = p.vy[i], vz = p.vz[i];
    const double v2 = vx * vx + vy * vy + vz * vz;
    if (!(x > -far && x < g.n_cols + far && y > -far && y < g.n_rows + far) || !std::isfinite(v2))
      continue;
    if (widest.support_radius) {
      width = cells_wide(settings_.width_per_radius * widest.support_radius[i], g.cell_m);
      one.n = static_cast<int>(std::ceil(3 * width));
    }
    std::tie(one.row, one.col) = weights(x, y, width, one.n, weights_x_.data(), weights_y_.data());
    one.mass = p.mass[i];
    const double distance =
        widest.support_radius ? distance_per_radius * widest.support_radius[i] : spacing;
    one.area = widest.area(i, p.mass[i], distance) * per_cell * per_cell;
    one.motion = Motion(vx, vy, vz, 0.5 * v2);
    add_one<with_motion>(set, one);
    cover_own(x, y, std::max(0.5, own_share * distance * per_cell));
  }
}

template <bool with_motion>
void PeakMaps::scatter(std::span<const MovingSet> sets) {
  for (std::size_t k = 0; k < sets.size(); ++k) scatter_set<with_motion>(sets[k], k);
}

/// Takes the instant's sums into the peaks and clears them.
void PeakMaps::keep_peaks(std::span<const MovingSet> sets, float time_s) {
  const double per_area = 1 / (settings_.grid.cell_m * settings_.grid.cell_m);
  const std::size_t n_sets = sets.size();
  std::vector<double> thickness_per_mass(n_sets), layers_per_mass(n_sets * n_sets);
  for (std::size_t m = 0; m < n_sets; ++m) {
    thickness_per_mass[m] = per_area / sets[m].bulk_density;
    for (std::size_t n = 0; n < n_sets; ++n)
      layers_per_mass[n * n_sets + m] = per_area / sets[m].bulk_density / sets[n].spacing;
  }
  double total = 0;
  histogram_.clear();
  tiles_.take_sums([&](CellPeak& peak, std::size_t slot, std::size_t cell) {
    double mass = 0, thickness = 0;
    for (std::size_t n = 0; n < n_sets; ++n) {
      const double of_set = tiles_.mass(n, slot)[cell];
      mass += of_set;
      thickness += of_set * thickness_per_mass[n];
    }
    if (mass == 0) return;
    total += mass;
    for (std::size_t n = 0; n < n_sets; ++n) {
      double layers = 0;
      for (std::size_t m = 0; m < n_sets; ++m)
        layers += tiles_.mass(m, slot)[cell] * layers_per_mass[n * n_sets + m];
      histogram_.add(layers, tiles_.mass(n, slot)[cell]);
    }
    peak.thickness = std::max(peak.thickness, static_cast<float>(thickness));
    if (!(thickness > settings_.runout_limit_m)) return;
    const double density =
        n_sets == 1 ? sets[0].bulk_density : mass * per_area / thickness;  // of the mixture
    const Motion& sums = tiles_.motion(slot)[cell];
    const double speed = sums.matrix().head<3>().norm() / mass;
    peak.speed = std::max(peak.speed, static_cast<float>(speed));
    peak.energy = std::max(peak.energy, static_cast<float>(sums[3] * per_area));
    peak.pressure = std::max(peak.pressure, static_cast<float>(density * speed * speed));
    if (std::isnan(peak.arrival) && tiles_.coverage(slot)[cell] >= enough_cover)
      peak.arrival = time_s;
  });
  layers_ = histogram_.count(total);
}

void PeakMaps::record(std::span<const MovingSet> sets, double time_s) {
  const Window w = bounds_of(sets);
  if (w.n_cells() == 0) return;
  tiles_.cover(w);
  scatter<true>(sets);
  keep_peaks(sets, static_cast<float>(time_s));
}

void PeakMaps::keep_deposit(std::span<const MovingSet> sets) {
  const double cell_area = settings_.grid.cell_m * settings_.grid.cell_m;
  tiles_.take_sums([&](CellPeak& peak, std::size_t slot, std::size_t cell) {
    double thickness = 0;
    for (std::size_t n = 0; n < sets.size(); ++n)
      thickness += tiles_.mass(n, slot)[cell] * (1 / (sets[n].bulk_density * cell_area));
    peak.deposit = static_cast<float>(thickness);
    peak.covered =
        thickness > settings_.runout_limit_m && tiles_.coverage(slot)[cell] >= enough_cover;
    peak.thickness = std::max(peak.thickness, peak.deposit);
  });
}

void PeakMaps::write_left(std::span<const MovingSet> sets, MemberResult& result) const {
  const Window& w = result.window;
  auto& left = result.layer(PeakLayer::left);
  left.clear();
  if (std::all_of(sets.begin(), sets.end(), [](const auto& s) { return s.departures.empty(); }))
    return;
  std::vector<double> mass(w.n_cells());
  for (const MovingSet& set : sets)
    for (const Departure& gone : set.departures)
      if (const auto cell = cell_of(gone, settings_.grid))
        mass[static_cast<std::size_t>(cell->first - w.row0) * w.n_cols + (cell->second - w.col0)] +=
            gone.mass;
  left.resize(w.n_cells());
  const double per_area = 1 / (settings_.grid.cell_m * settings_.grid.cell_m);
  for (std::size_t k = 0; k < mass.size(); ++k) left[k] = static_cast<float>(per_area * mass[k]);
}

/// Writes layers; \return cells reached, cells covered at the end, and maxima.
PeakMaps::Totals PeakMaps::write_layers(MemberResult& result) const {
  constexpr int edge = PeakTiles::edge;
  const Window& w = result.window;
  for (int k = 0; k < n_peak_layers; ++k)
    result.layers[static_cast<std::size_t>(k)].assign(w.n_cells(),
                                                      info(static_cast<PeakLayer>(k)).untouched);
  Totals totals;
  CellPeak& most = totals.most;
  for (const PeakTiles::Tile& tile : tiles_.tiles())
    for (int cell = 0; cell < PeakTiles::n_cells; ++cell) {
      const CellPeak& p = tile.peak[static_cast<std::size_t>(cell)];
      const int row = tile.row0 + cell / edge - w.row0, col = tile.col0 + cell % edge - w.col0;
      if (row < 0 || row >= w.n_rows || col < 0 || col >= w.n_cols) continue;
      const std::size_t k = static_cast<std::size_t>(row) * w.n_cols + col;
      result.layer(PeakLayer::thickness)[k] = p.thickness;
      result.layer(PeakLayer::speed)[k] = p.speed;
      result.layer(PeakLayer::energy)[k] = p.energy;
      result.layer(PeakLayer::pressure)[k] = p.pressure;
      result.layer(PeakLayer::arrival)[k] = p.arrival;
      result.layer(PeakLayer::deposit)[k] = p.deposit;
      totals.reached += !std::isnan(p.arrival);
      totals.covered += p.covered;
      most.thickness = std::max(most.thickness, p.thickness);
      most.deposit = std::max(most.deposit, p.deposit);
      most.energy = std::max(most.energy, p.energy);
      most.pressure = std::max(most.pressure, p.pressure);
    }
  return totals;
}

std::vector<PeakMaps::Cell> PeakMaps::deposit_cells() const {
  constexpr int edge = PeakTiles::edge;
  std::vector<Cell> cells;
  for (const PeakTiles::Tile& tile : tiles_.tiles())
    for (int k = 0; k < PeakTiles::n_cells; ++k)
      if (tile.peak[static_cast<std::size_t>(k)].covered)
        cells.push_back({tile.row0 + k / edge, tile.col0 + k % edge});
  return cells;
}

void PeakMaps::finish(std::span<const MovingSet> final_state, MemberResult& result) {
  for (PeakTiles::Tile& tile : tiles_.tiles())
    for (CellPeak& peak : tile.peak) peak.deposit = 0, peak.covered = false;
  const Window w = bounds_of(final_state);
  if (w.n_cells() > 0) {
    tiles_.cover(w);
    scatter<false>(final_state);
    keep_deposit(final_state);
  }
  result.grid = settings_.grid;
  result.window = joined(tiles_.window(), window_of_departures(final_state, settings_.grid));
  const Totals totals = write_layers(result);
  write_left(final_state, result);
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
