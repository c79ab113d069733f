// SPDX-License-Identifier: Apache-2.0
/// Takes one row of a tile's sums into its peaks, all cells of the row alike.
#pragma once

#include "engine/simulation/maps/peak_tiles.hpp"
#include "engine/simulation/maps/sum_tiles.hpp"
#include "engine/simulation/maps/transpose.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Values of a cell at the last three instants, the newest first, that hold the largest in their
/// middle: the top of the parabola through them, for between two instants a peak passes unseen.
/// It stands over the middle one by an eighth at most, which is what three evenly spaced instants
/// give; uneven ones (a member's last) could give anything.
/// \param newer,older  time between the middle one and its neighbours [s]
/// \param most_over    that eighth, or 0: no parabola
inline float top_of(float now, float middle, float before, float newer, float older,
                    float most_over) {
  const float rise = (middle - before) / older, fall = (now - middle) / newer;
  const float slope = (rise * newer + fall * older) / (older + newer);
  const float bend = (rise - fall) / (older + newer);  // minus half the second derivative
  const bool is_top = (middle >= before) & (middle >= now) & (bend > 0);
  const float over = is_top ? 0.25F * slope * slope / bend : 0.0F;
  return middle + std::min(over, most_over * middle);
}

/// Loops of known length without branches, so that the compiler makes vector instructions of them.
class PeakRow {
 public:
  static constexpr int edge = PeakTile::edge;

  float time_s = 0;
  bool has_three = false;          ///< instants so far: a parabola needs them
  float newer_s = 1, older_s = 1;  ///< between the last three
  float runout_limit_m = 0;        ///< motion counts in cells that are thicker
  float enough_cover = 0;          ///< and they are reached where as much of them is covered
  float per_area = 0;              ///< of a cell [1/m2]

  /// \param cells  [edge]  \param first  of the row's cells within the tile
  void keep(const CellSums* cells, std::size_t first, PeakTile& peaks) {
    for (int j = 0; j < edge; j += n_cell_sums) {
      float* rows[n_cell_sums];
      for (int k = 0; k < n_cell_sums; ++k) rows[k] = &sums_[k][j];
      transpose_eight(cells[j].data(), rows);
    }
    look();
    keep_tops(first, peaks);
    const float* coverage = sums(CellSum::coverage);
    float* arrival = &peaks.arrival[first];
    for (int j = 0; j < edge; ++j) {
      const bool reached = (thickness_[j] > runout_limit_m) & (coverage[j] >= enough_cover);
      arrival[j] = std::min(arrival[j], reached ? time_s : PeakTile::never);
    }
  }

 private:
  const float* sums(CellSum s) const { return sums_[static_cast<int>(s)]; }

  void look() {
    const float *volume = sums(CellSum::volume), *mass = sums(CellSum::mass),
                *px = sums(CellSum::momentum_x), *py = sums(CellSum::momentum_y),
                *pz = sums(CellSum::momentum_z), *energy = sums(CellSum::energy);
    for (int j = 0; j < edge; ++j) {
      thickness_[j] = volume[j] * per_area;
      const bool counts = thickness_[j] > runout_limit_m;
      const float per_mass = counts ? 1 / mass[j] : 0.0F;
      const float vx = px[j] * per_mass, vy = py[j] * per_mass, vz = pz[j] * per_mass;
      speed_[j] = std::sqrt(vx * vx + vy * vy + vz * vz);
      energy_[j] = counts ? energy[j] * per_area : 0.0F;
      density_[j] = counts ? mass[j] / volume[j] : 0.0F;  // of the mixture
    }
  }

  void keep_tops(std::size_t first, PeakTile& peaks) const {
    const float newer = newer_s, older = older_s;
    const float most_over = has_three ? 0.125F : 0.0F;
    float *h = &peaks.thickness[first], *e = &peaks.energy[first], *v = &peaks.speed[first],
          *p = &peaks.pressure[first];
    float *h1 = &peaks.last.thickness[first], *h2 = &peaks.before.thickness[first];
    float *e1 = &peaks.last.energy[first], *e2 = &peaks.before.energy[first];
    float *v1 = &peaks.last.speed[first], *v2 = &peaks.before.speed[first];
    for (int j = 0; j < edge; ++j) {
      const float top = top_of(thickness_[j], h1[j], h2[j], newer, older, most_over);
      h[j] = std::max(h[j], std::max(top, thickness_[j]));
      h2[j] = h1[j], h1[j] = thickness_[j];
    }
    for (int j = 0; j < edge; ++j) {
      const float top = top_of(energy_[j], e1[j], e2[j], newer, older, most_over);
      e[j] = std::max(e[j], std::max(top, energy_[j]));
      e2[j] = e1[j], e1[j] = energy_[j];
    }
    for (int j = 0; j < edge; ++j) {
      // Where the flow was too thin to count there is no speed, and no parabola through it.
      const bool all = (speed_[j] > 0) & (v1[j] > 0) & (v2[j] > 0);
      const float top = all ? top_of(speed_[j], v1[j], v2[j], newer, older, most_over) : 0.0F;
      const float speed = std::max(top, speed_[j]);
      v[j] = std::max(v[j], speed);
      p[j] = std::max(p[j], density_[j] * speed * speed);
      v2[j] = v1[j], v1[j] = speed_[j];
    }
  }

  float sums_[n_cell_sums][edge];
  float thickness_[edge], speed_[edge], energy_[edge], density_[edge];
};

}  // namespace sturz
