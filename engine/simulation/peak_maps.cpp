// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/peak_maps.hpp"

#include "engine/core/error.hpp"
#include "engine/effects/fields.hpp"
#include "engine/particles/column_area.hpp"
#include "engine/simulation/maps/departed_cells.hpp"
#include "engine/simulation/maps/peak_row.hpp"
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace sturz {
namespace {

/// Where as much of a cell is covered by what is spread, it is reached too: at the edge of a mass
/// that is a half, and no cell beyond it may count for being near.
constexpr float enough_cover = 0.75F;
/// Half the width of what a particle of no columns surely covers, in spacings.
constexpr double own_share = 0.4;
float& sum_of(CellSums& cell, CellSum what) { return cell[static_cast<int>(what)]; }

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
  const Field* area_share = p.find(fields::area_share);
  w.area_share = area_share ? area_share->component[0].data() : nullptr;
  w.spacing = p.spacing;
  w.volume_per_mass = p.filled_share / p.bulk_density;
  double width_m = p.spacing;
  if (support_radius && p.size() > 0) {
    const auto& all = support_radius->component[0];
    width_m = settings_.width_per_radius * *std::max_element(all.begin(), all.end());
  }
  w.cells = cells_wide(width_m, settings_.grid.cell_m);
  return w;
}

double PeakMaps::Width::area(std::size_t i, double mass) const {
  if (!support_radius) return spacing * spacing;
  const double h = thickness ? thickness->component[0][i] : 0;
  const double east = ground ? ground->component[0][i] : 0;
  const double north = ground ? ground->component[1][i] : 0;
  const double upright = ground ? 1 / std::sqrt(1 + east * east + north * north) : 1;
  const double area = column_area(support_radius[i], upright, mass * volume_per_mass, h);
  return area_share ? area * area_share[i] : area;
}

/// Widths of all sets, and the cells that they can touch.
Window PeakMaps::bounds_of(std::span<const MovingSet> sets) {
  expect(!sets.empty() && sets.size() <= 2, "one set, or two");
  expect(!settings_.by_set || sets.size() == 2, "of two sets each can be told apart");
  expect((n_sets_ == 0 || n_sets_ == sets.size()), "the sets stay the same");
  n_sets_ = sets.size();
  widths_.clear();
  Window all;
  for (const MovingSet& set : sets) {
    expect(set.spacing > 0 && set.bulk_density > 0, "spacing and bulk density are positive");
    widths_.push_back(width_of(set));
    all = joined(all, cover(set, widths_.back()));
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

double PeakMaps::share_of_record(std::span<const MovingSet> sets, double dt_s) const {
  const double least = 0.5 * settings_.grid.cell_m;
  double largest = 0;  // of the squares
  for (const MovingSet& p : sets) {
    const Field* support_radius = p.find(fields::support_radius);
    if (!support_radius) {
      const double distance = std::max(least, record_share * p.spacing);
      const double share = p.motion.max_speed / distance;
      largest = std::max(largest, share * share);
      continue;
    }
    const double* radius = support_radius->component[0].data();
    const double per_radius = record_share * settings_.width_per_radius;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double distance = std::max(least, per_radius * radius[i]);
      const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
      largest = std::max(largest, v2 / (distance * distance));
    }
  }
  return dt_s * std::sqrt(largest);
}

/// Adds one particle to the cells on the grid that it touches, tile by tile.
void PeakMaps::add_one(const CellSums& whole, SumTiles& to) const {
  constexpr int edge = SumTiles::edge;
  const Grid& g = settings_.grid;
  const int row1 = std::min(down_.first() + down_.n(), g.n_rows);
  const int col1 = std::min(across_.first() + across_.n(), g.n_cols);
  const int from_col = std::max(across_.first(), 0);
  for (int row = std::max(down_.first(), 0); row < row1;) {
    const int next_row = std::min(row1, (row / edge + 1) * edge);
    const std::uint32_t rows = ((1U << (next_row - row)) - 1U) << row % edge;
    for (int col = from_col; col < col1;) {
      const int next_col = std::min(col1, (col / edge + 1) * edge);
      const std::size_t slot = to.slot_at(row / edge, col / edge);
      to.mark_rows(slot, rows);
      CellSums* cells = to.cells(slot) + std::ptrdiff_t{edge} * (row % edge) + col % edge;
      const float *down = down_.weights() + (row - down_.first()),
                  *across = across_.weights() + (col - across_.first());
      const int n = next_col - col;
      for (int k = row; k < next_row; ++k, cells += edge) {
        const CellSums in_row = whole * down[k - row];
        for (int j = 0; j < n; ++j) cells[j] += in_row * across[j];
      }
      col = next_col;
    }
    row = next_row;
  }
}

void PeakMaps::scatter_set(const MovingSet& p, std::size_t set, SumTiles& to) {
  const Grid& g = settings_.grid;
  const Width& widest = widths_[set];
  const double per_cell = 1 / g.cell_m, far = 1.5 * widest.cells + 1;
  const double volume_per_mass = p.filled_share / p.bulk_density, in_first = set == 0 ? 1 : 0;
  const double half_width = std::max(0.5, own_share * p.spacing * per_cell);
  double width = widest.cells;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = (p.x[i] - g.west_m) * per_cell - 0.5;
    const double y = (g.north_m - p.y[i]) * per_cell - 0.5;
    const double vx = p.vx[i], vy = p.vy[i], vz = p.vz[i], mass = p.mass[i];
    const double v2 = vx * vx + vy * vy + vz * vz;
    if (!(x > -far && x < g.n_cols + far && y > -far && y < g.n_rows + far) || !std::isfinite(v2))
      continue;
    if (widest.support_radius)
      width = cells_wide(settings_.width_per_radius * widest.support_radius[i], g.cell_m);
    across_.set(x, width);
    down_.set(y, width);
    const double area = widest.area(i, mass) * per_cell * per_cell;
    const Eigen::Array<double, n_cell_sums, 1> whole{
        mass * volume_per_mass, mass, mass * vx,      mass * vy, mass * vz,
        0.5 * mass * v2,        area, mass * in_first};
    add_one(whole.cast<float>(), to);
    if (widest.support_radius)
      cover_square(x, y, std::sqrt(area), to);
    else
      cover_cell_of(x, y, half_width, to);
  }
}

void PeakMaps::scatter(std::span<const MovingSet> sets) {
  for (std::size_t k = 0; k < sets.size(); ++k)
    scatter_set(sets[k], k, settings_.by_set ? of_set_[k] : sums_);
  if (!settings_.by_set) return;
  for (const SumTiles& set : of_set_) sums_.add(set);
  for (SumTiles& set : of_set_) set.open_as(sums_);
}

void PeakMaps::clear_sums() {
  sums_.clear();
  for (SumTiles& set : of_set_) set.clear();
}

/// Takes the instant's sums into the peaks.
void PeakMaps::keep_peaks(double time_s) {
  constexpr int edge = SumTiles::edge;
  PeakRow row;
  row.time_s = static_cast<float>(time_s);
  row.runout_limit_m = static_cast<float>(settings_.runout_limit_m);
  row.enough_cover = enough_cover, row.enough_under = enough_under;
  row.per_area = static_cast<float>(1 / (settings_.grid.cell_m * settings_.grid.cell_m));
  if (n_records_ >= 2)
    row.set_intervals(time_s > last_s_ ? static_cast<float>(time_s - last_s_) : 1,
                      last_s_ > before_s_ ? static_cast<float>(last_s_ - before_s_) : 1);
  row.is_odd = n_records_ % 2 != 0;
  ++n_records_;
  for (std::size_t slot = 0; slot < sums_.tiles().size(); ++slot) {
    const SumTiles::Open& open = sums_.tiles()[slot];
    PeakTile& peaks = peaks_.at(open.tile_row, open.tile_col);
    if (settings_.by_set && peaks.of_set.empty()) {
      peaks.of_set.resize(of_set_.size());
      peaks.fullest.assign(PeakTile::n_cells, 0), peaks.liquid_fraction = peaks.fullest;
    }
    if (peaks.n_seen + 1 != n_records_ && peaks.rows_seen != 0) {
      peaks.last = peaks.before = {}, peaks.rows_seen = 0;
      for (CellPeaks& set : peaks.of_set) set.last = set.before = {};
    }
    peaks.n_seen = n_records_;
    peaks.rows_seen |= open.rows;
    for (unsigned rows = peaks.rows_seen; rows != 0; rows &= rows - 1) {
      const int first = std::countr_zero(rows) * edge;
      row.keep(sums_.cells(slot) + first, sums_.under(slot) + first,
               static_cast<std::size_t>(first), peaks);
    }
    if (settings_.by_set) keep_materials(row, slot, peaks);
  }
  before_s_ = last_s_, last_s_ = time_s;
}

/// Takes what grains and liquid are by themselves into their peaks.
void PeakMaps::keep_materials(const PeakRow& row, std::size_t slot, PeakTile& peaks) {
  const SumTiles::Open& open = sums_.tiles()[slot];
  const CellSums* flow = sums_.cells(slot);
  for (std::size_t k = 0; k < of_set_.size(); ++k) {
    const std::size_t own = of_set_[k].slot_at(open.tile_row, open.tile_col);
    const CellSums* cells = of_set_[k].cells(own);
    for (unsigned rows = peaks.rows_seen; rows != 0; rows &= rows - 1) {
      const int first = std::countr_zero(rows) * PeakTile::edge;
      const auto at = static_cast<std::size_t>(first);
      row.keep_material(cells + first, flow + first, of_set_[k].under(own) + first, at,
                        peaks.of_set[k]);
      if (k == 1) row.keep_liquid_fraction(cells + first, flow + first, at, peaks);
    }
  }
}

/// Of every set, over the cells: how many of its layers the cell's whole thickness is.
void PeakMaps::count_layers(std::span<const MovingSet> sets) {
  const double per_area = 1 / (settings_.grid.cell_m * settings_.grid.cell_m);
  double total = 0;
  histogram_.clear();
  for (std::size_t slot = 0; slot < sums_.tiles().size(); ++slot)
    for (int k = 0; k < SumTiles::n_cells; ++k) {
      if (!(sums_.tiles()[slot].rows >> k / SumTiles::edge & 1U)) {
        k += SumTiles::edge - 1;
        continue;
      }
      CellSums& cell = sums_.cells(slot)[k];
      const double mass = sum_of(cell, CellSum::mass), first = sum_of(cell, CellSum::first_mass);
      if (mass == 0) continue;
      const double thickness = per_area * sum_of(cell, CellSum::volume);
      histogram_.add(thickness / sets.front().spacing, first);
      if (sets.size() > 1) histogram_.add(thickness / sets[1].spacing, mass - first);
      total += mass;
    }
  layers_ = histogram_.count(total);
}

void PeakMaps::record(std::span<const MovingSet> sets, double time_s, bool with_layers) {
  const Window w = bounds_of(sets);
  if (w.n_cells() == 0) return;
  sums_.cover(w);
  if (settings_.by_set)
    for (SumTiles& set : of_set_) set.cover(w);
  peaks_.cover(w);
  scatter(sets);
  if (with_layers) count_layers(sets);
  keep_peaks(time_s);
  clear_sums();
}

void PeakMaps::keep_deposit() {
  const auto per_area = static_cast<float>(1 / (settings_.grid.cell_m * settings_.grid.cell_m));
  for (std::size_t slot = 0; slot < sums_.tiles().size(); ++slot) {
    PeakTile& peaks = peaks_.at(sums_.tiles()[slot].tile_row, sums_.tiles()[slot].tile_col);
    for (std::size_t k = 0; k < SumTiles::n_cells; ++k) {
      CellSums& cell = sums_.cells(slot)[k];
      const float thickness = sum_of(cell, CellSum::volume) * per_area;
      peaks.deposit[k] = thickness;
      peaks.covered[k] =
          thickness > settings_.runout_limit_m &&
          (sum_of(cell, CellSum::coverage) >= enough_cover || sums_.under(slot)[k] >= enough_under);
      peaks.thickness[k] = std::max(peaks.thickness[k], thickness);
    }
  }
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
  constexpr int edge = PeakTile::edge;
  const Window& w = result.window;
  for (int k = 0; k < n_peak_layers; ++k) {
    const auto layer = static_cast<PeakLayer>(k);
    if (is_of_materials(layer) && !settings_.by_set) continue;
    result.layer(layer).assign(w.n_cells(), info(layer).untouched);
  }
  Totals totals;
  for (const PeakTile& p : peaks_.tiles())
    for (std::size_t cell = 0; cell < PeakTile::n_cells; ++cell) {
      const int row = p.row0 + static_cast<int>(cell) / edge - w.row0;
      const int col = p.col0 + static_cast<int>(cell) % edge - w.col0;
      if (row < 0 || row >= w.n_rows || col < 0 || col >= w.n_cols) continue;
      const std::size_t k = static_cast<std::size_t>(row) * w.n_cols + col;
      const bool reached = p.arrival[cell] < PeakTile::never;
      result.layer(PeakLayer::thickness)[k] = p.thickness[cell];
      result.layer(PeakLayer::speed)[k] = p.speed[cell];
      result.layer(PeakLayer::energy)[k] = p.energy[cell];
      result.layer(PeakLayer::pressure)[k] = p.pressure[cell];
      if (reached) result.layer(PeakLayer::arrival)[k] = p.arrival[cell];
      result.layer(PeakLayer::deposit)[k] = p.deposit[cell];
      if (!p.of_set.empty()) write_materials(p, cell, k, result);
      totals.reached += reached;
      totals.covered += p.covered[cell];
      totals.thickness = std::max(totals.thickness, p.thickness[cell]);
      totals.deposit = std::max(totals.deposit, p.deposit[cell]);
      totals.energy = std::max(totals.energy, p.energy[cell]);
      totals.pressure = std::max(totals.pressure, p.pressure[cell]);
    }
  return totals;
}

std::vector<PeakMaps::Cell> PeakMaps::deposit_cells() const {
  constexpr int edge = PeakTile::edge;
  std::vector<Cell> cells;
  for (const PeakTile& tile : peaks_.tiles())
    for (int k = 0; k < PeakTile::n_cells; ++k)
      if (tile.covered[static_cast<std::size_t>(k)])
        cells.push_back({tile.row0 + k / edge, tile.col0 + k % edge});
  return cells;
}

void PeakMaps::finish(std::span<const MovingSet> final_state, MemberResult& result) {
  for (PeakTile& tile : peaks_.tiles()) tile.deposit.fill(0), tile.covered.fill(false);
  const Window w = bounds_of(final_state);
  if (w.n_cells() > 0) {
    sums_.cover(w);
    if (settings_.by_set)
      for (SumTiles& set : of_set_) set.cover(w);
    peaks_.cover(w);
    scatter(final_state);
    keep_deposit();
    clear_sums();
  }
  result.grid = settings_.grid;
  result.window = joined(peaks_.window(), window_of_departures(final_state, settings_.grid));
  const Totals totals = write_layers(result);
  write_left(final_state, result);
  const double cell_area = settings_.grid.cell_m * settings_.grid.cell_m;
  MemberScalars& s = result.scalars;
  s.reached_area_m2 = static_cast<double>(totals.reached) * cell_area;
  s.deposit_area_m2 = static_cast<double>(totals.covered) * cell_area;
  s.max_thickness_m = totals.thickness;
  s.max_deposit_m = totals.deposit;
  s.max_energy_j_m2 = totals.energy;
  s.max_pressure_pa = totals.pressure;
}

}  // namespace sturz
