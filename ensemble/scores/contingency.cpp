// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/contingency.hpp"

#include <algorithm>

namespace sturz {
namespace {

double ratio(double part, double whole) { return whole > 0 ? part / whole : nan_d; }

}  // namespace

double intersection_over_union(const Contingency& t) {
  return ratio(t.hit_m2, t.hit_m2 + t.false_m2 + t.missed_m2);
}

double hit_rate(const Contingency& t) { return ratio(t.hit_m2, t.hit_m2 + t.missed_m2); }

double false_alarm_ratio(const Contingency& t) { return ratio(t.false_m2, t.hit_m2 + t.false_m2); }

double heidke_skill(const Contingency& t) {
  const double tp = t.hit_m2, fp = t.false_m2, fn = t.missed_m2, tn = t.neither_m2;
  const double by_chance = (tp + fn) * (fn + tn) + (tp + fp) * (fp + tn);
  return by_chance > 0 ? 2 * (tp * tn - fp * fn) / by_chance : nan_d;
}

ObservedCells::ObservedCells(const Raster<double>& cover, const Grid& maps)
    : cover_(cover), maps_(maps), window_(window_of(cover.grid, maps)) {
  Window box;
  for (int r = 0; r < window_.n_rows; ++r)
    for (int c = 0; c < window_.n_cols; ++c) {
      const double share = cover.at(r, c);
      covered_ += share;
      if (share > 0) box = joined(box, {window_.row0 + r, window_.col0 + c, 1, 1});
    }
  const int longer = std::max(box.n_rows, box.n_cols);
  domain_ = widened(box, (longer + 1) / 2, maps);
}

Contingency ObservedCells::against(const Raster<std::uint8_t>& simulated) const {
  const Window at = window_of(simulated.grid, maps_);
  double hit = 0, wrong = 0, wrong_inside = 0;
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c) {
      if (simulated.at(r, c) == 0) continue;
      const int row = at.row0 + r, col = at.col0 + c;
      const double share = std::min(1.0, cover(row, col));
      hit += share;
      wrong += 1 - share;
      if (domain_.contains(row, col)) wrong_inside += 1 - share;
    }
  const double cell = maps_.cell_m * maps_.cell_m;
  const double empty = static_cast<double>(domain_.n_cells()) - covered_;
  return {hit * cell, wrong * cell, std::max(0.0, covered_ - hit) * cell,
          std::max(0.0, empty - wrong_inside) * cell};
}

}  // namespace sturz
