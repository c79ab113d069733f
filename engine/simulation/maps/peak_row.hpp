// SPDX-License-Identifier: Apache-2.0
/// Takes one row of a tile's sums into its peaks, eight cells at a time.
#pragma once

#include "engine/simulation/maps/eight.hpp"
#include "engine/simulation/maps/peak_tiles.hpp"
#include "engine/simulation/maps/sum_tiles.hpp"

namespace sturz {

/// What a row is looked at with.
struct PeakRow {
  float time_s = 0;
  bool has_three = false;          ///< instants so far: a parabola needs them
  float newer_s = 1, older_s = 1;  ///< between the last three
  float runout_limit_m = 0;        ///< motion counts in cells that are thicker
  float enough_cover = 0;          ///< and they are reached where as much of them is covered
  float enough_under = 0;          ///< or as much of them lies under the particles themselves
  float per_area = 0;              ///< of a cell [1/m2]

  /// \param cells, under  of the row  \param first  of the row's cells within the tile
  void keep(const CellSums* cells, const float* under, std::size_t first, PeakTile& peaks) const {
    for (int j = 0; j < PeakTile::edge; j += 8)
      keep_eight(cells[j].data(), under + j, first + j, peaks);
  }

 private:
  /// Of values at the last three instants that hold the largest in their middle: the top of the
  /// parabola through them, for between two instants a peak passes unseen. It stands over the
  /// middle one by an eighth at most, which is what three evenly spaced instants give; uneven ones
  /// (a member's last) could give anything. Elsewhere the middle one itself.
  Eight top_of(const Eight& now, const Eight& middle, const Eight& before) const {
    const Eight rise = (middle - before) / older_s, fall = (now - middle) / newer_s;
    const Eight slope = (rise * newer_s + fall * older_s) / (older_s + newer_s);
    const Eight curvature =
        (rise - fall) / (older_s + newer_s);  // minus half the second derivative
    const Eight most = has_three ? 0.125F * middle : 0.0F * middle;
    const Eight over = smaller(0.25F * slope * slope / curvature, most);
    const auto is_top = (middle >= before) & (middle >= now) & (curvature > 0.0F);
    return middle + (is_top ? over : 0.0F * middle);
  }

  /// Moves the instants on. \return the largest of the new value and a top that it closes
  Eight pass(const Eight& now, float* last, float* before, bool gaps_count) const {
    const Eight middle = eight_at(last), first = eight_at(before);
    put_eight(before, middle);
    put_eight(last, now);
    const Eight top = top_of(now, middle, first);
    if (gaps_count) return larger(now, top);
    // Where the flow was too thin to count there is no value, and no parabola through it.
    return ((now > 0.0F) & (middle > 0.0F) & (first > 0.0F)) ? larger(now, top) : now;
  }

  void keep_eight(const float* cells, const float* under, std::size_t at, PeakTile& peaks) const {
    Eight sums[n_cell_sums];
    transpose_eight(cells, sums);
    const auto sum = [&](CellSum s) { return sums[static_cast<int>(s)]; };
    const Eight none{}, mass = sum(CellSum::mass), volume = sum(CellSum::volume);
    const Eight thickness = volume * per_area;
    const auto counts = thickness > runout_limit_m;
    const Eight per_mass = counts ? 1.0F / mass : none;
    const Eight vx = sum(CellSum::momentum_x) * per_mass, vy = sum(CellSum::momentum_y) * per_mass,
                vz = sum(CellSum::momentum_z) * per_mass;
    const Eight speed_now = root(vx * vx + vy * vy + vz * vz);
    const Eight energy_now = counts ? sum(CellSum::energy) * per_area : none;
    const Eight density = counts ? mass / volume : none;  // of the mixture

    const auto raise = [&](PeakTile::PerCell<float>& peak, const Eight& value) {
      put_eight(&peak[at], larger(eight_at(&peak[at]), value));
    };
    PeakTile::Instant &last = peaks.last, &before = peaks.before;
    const Eight speed = pass(speed_now, &last.speed[at], &before.speed[at], false);
    raise(peaks.thickness, pass(thickness, &last.thickness[at], &before.thickness[at], true));
    raise(peaks.energy, pass(energy_now, &last.energy[at], &before.energy[at], true));
    raise(peaks.speed, speed);
    raise(peaks.pressure, density * speed * speed);
    const auto covered =
        (sum(CellSum::coverage) >= enough_cover) | (eight_at(under) >= enough_under);
    const auto reached = counts & covered;
    const Eight now = reached ? none + time_s : none + PeakTile::never;
    put_eight(&peaks.arrival[at], smaller(eight_at(&peaks.arrival[at]), now));
  }
};

}  // namespace sturz
