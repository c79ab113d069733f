// SPDX-License-Identifier: Apache-2.0
/// Takes one row of a tile's sums into its peaks, eight cells at a time.
#pragma once

#include "engine/simulation/maps/eight.hpp"
#include "engine/simulation/maps/peak_tiles.hpp"
#include "engine/simulation/maps/sum_tiles.hpp"

#include <algorithm>

namespace sturz {

/// What a row is looked at with.
struct PeakRow {
  float time_s = 0;
  float runout_limit_m = 0;  ///< motion counts in cells that are thicker
  float enough_cover = 0;    ///< and they are reached where as much of them is covered
  float enough_under = 0;    ///< or as much of them lies under the particles themselves
  float per_area = 0;        ///< of a cell [1/m2]
  bool is_odd = false;       ///< every other instant takes the place of the tile's `last`

  /// \param cells, under  of the row  \param first  of the row's cells within the tile
  void keep(const CellSums* cells, const float* under, std::size_t first, CellPeaks& peaks) const {
    for (int j = 0; j < PeakTile::edge; j += 8)
      keep_eight(cells[j].data(), nullptr, under + j, first + j, peaks);
  }
  /// The same of one material. Its dynamic pressure is its share of the flow's momentum flux: its
  /// mass over the flow's volume, times its own speed squared; of both together rho v^2 where they
  /// move as one. \param flow  the row's sums of both materials
  void keep_material(const CellSums* cells, const CellSums* flow, const float* under,
                     std::size_t first, CellPeaks& peaks) const {
    for (int j = 0; j < PeakTile::edge; j += 8)
      keep_eight(cells[j].data(), flow[j].data(), under + j, first + j, peaks);
  }
  /// The liquid's share of the flow's volume where the flow is thicker than ever; of matter, so air
  /// between grains is no part of it. \param liquid, flow  sums of the row
  void keep_liquid_fraction(const CellSums* liquid, const CellSums* flow, std::size_t first,
                            PeakTile& peaks) const {
    constexpr int volume = static_cast<int>(CellSum::volume);
    for (int j = 0; j < PeakTile::edge; ++j) {
      const float whole = flow[j][volume], thickness = whole * per_area;
      float& fullest = peaks.fullest[first + j];
      if (!(thickness > runout_limit_m && thickness > fullest)) continue;
      fullest = thickness;
      peaks.liquid_fraction[first + j] = std::min(1.0F, liquid[j][volume] / whole);
    }
  }

  /// Time between the last three instants, which a parabola needs.
  void set_intervals(float newer_s, float older_s) {
    has_three_ = true;
    newer_s_ = newer_s, per_newer_ = 1 / newer_s;
    older_s_ = older_s, per_older_ = 1 / older_s;
    per_both_ = 1 / (newer_s + older_s);
  }

 private:
  /// How far the top of a parabola may stand over the middle of three instants: an eighth, which is
  /// what three evenly spaced ones give; uneven ones (a member's last) could give anything.
  static constexpr float most_over = 0.125F;

  bool has_three_ = false;
  float newer_s_ = 1, older_s_ = 1, per_newer_ = 1, per_older_ = 1, per_both_ = 0.5F;

  /// Of values at the last three instants that hold the largest in their middle: the top of the
  /// parabola through them, for between two instants a peak passes unseen. Elsewhere the middle one
  /// itself.
  Eight top_of(const Eight& now, const Eight& middle, const Eight& before) const {
    const Eight rise = (middle - before) * per_older_, fall = (now - middle) * per_newer_;
    const Eight slope = (rise * newer_s_ + fall * older_s_) * per_both_;
    const Eight curvature = (rise - fall) * per_both_;  // minus half the second derivative
    const Eight over = smaller(0.25F * slope * slope / curvature, most_over * middle);
    const auto is_top = (middle >= before) & (middle >= now) & (curvature > 0.0F);
    return middle + (is_top ? over : 0.0F * middle);
  }

  /// Puts the new value in the place of the oldest. \return the largest of the new value and a top
  /// that it closes, where that is more than the peak so far
  Eight pass(const Eight& now, const float* last, float* before, const Eight& peak,
             bool gaps_count) const {
    const Eight middle = eight_at(last), first = eight_at(before);
    put_eight(before, now);
    const auto may_be_top = (middle >= first) & (middle >= now) & ((1 + most_over) * middle > peak);
    const Eight top = has_three_ && any(may_be_top) ? top_of(now, middle, first) : middle;
    if (gaps_count) return larger(now, top);
    // Where the flow was too thin to count there is no value, and no parabola through it.
    return ((now > 0.0F) & (middle > 0.0F) & (first > 0.0F)) ? larger(now, top) : now;
  }

  static Eight volume_of(const float* flow, const Eight& own) {
    if (flow == nullptr) return own;
    Eight sums[n_cell_sums];
    transpose_eight(flow, sums);
    return sums[static_cast<int>(CellSum::volume)];
  }

  /// \param flow  sums of all materials; null: `cells` are all
  void keep_eight(const float* cells, const float* flow, const float* under, std::size_t at,
                  CellPeaks& peaks) const {
    Eight sums[n_cell_sums];
    transpose_eight(cells, sums);
    const auto sum = [&](CellSum s) { return sums[static_cast<int>(s)]; };
    const Eight none{}, mass = sum(CellSum::mass), volume = sum(CellSum::volume);
    const CellPeaks::Instant& last = is_odd ? peaks.before : peaks.last;
    CellPeaks::Instant& before = is_odd ? peaks.last : peaks.before;
    if (!any((mass > 0.0F) | (eight_at(&last.thickness[at]) > 0.0F) |
             (eight_at(&before.thickness[at]) > 0.0F)))
      return;
    const Eight thickness = volume * per_area;
    const auto counts = thickness > runout_limit_m;
    const Eight per_mass = counts ? 1.0F / mass : none;
    const Eight vx = sum(CellSum::momentum_x) * per_mass, vy = sum(CellSum::momentum_y) * per_mass,
                vz = sum(CellSum::momentum_z) * per_mass;
    const Eight speed_now = root(vx * vx + vy * vy + vz * vz);
    const Eight energy_now = counts ? sum(CellSum::energy) * per_area : none;
    const Eight density = counts ? mass / volume_of(flow, volume) : none;  // of the mixture

    const auto raise = [&](CellPeaks::PerCell<float>& peak, const Eight& value) {
      // Most cells are past their peak: what is not written need not go back to memory.
      const Eight so_far = eight_at(&peak[at]);
      if (any(value > so_far)) put_eight(&peak[at], larger(so_far, value));
    };
    const auto raise_passing = [&](CellPeaks::PerCell<float> CellPeaks::*peak,
                                   CellPeaks::PerCell<float> CellPeaks::Instant::*value,
                                   const Eight& now, bool gaps_count) {
      CellPeaks::PerCell<float>& highest = peaks.*peak;
      const Eight value_now =
          pass(now, &(last.*value)[at], &(before.*value)[at], eight_at(&highest[at]), gaps_count);
      raise(highest, value_now);
      return value_now;
    };
    raise_passing(&CellPeaks::thickness, &CellPeaks::Instant::thickness, thickness, true);
    raise_passing(&CellPeaks::energy, &CellPeaks::Instant::energy, energy_now, true);
    const Eight speed =
        raise_passing(&CellPeaks::speed, &CellPeaks::Instant::speed, speed_now, false);
    raise(peaks.pressure, density * speed * speed);
    const auto covered =
        (sum(CellSum::coverage) >= enough_cover) | (eight_at(under) >= enough_under);
    const auto reached = counts & covered;
    const Eight now = reached ? none + time_s : none + CellPeaks::never;
    const Eight arrival = eight_at(&peaks.arrival[at]);
    if (any(now < arrival)) put_eight(&peaks.arrival[at], smaller(arrival, now));
  }
};

}  // namespace sturz
