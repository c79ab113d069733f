// SPDX-License-Identifier: Apache-2.0
/// The loop over groups of columns and the columns of another set near them, compiled once per
/// instruction set.
#pragma once

#include "engine/effects/columns/sweep.hpp"
#include "engine/effects/phases/sums.hpp"

namespace sturz::STURZ_ISA {

inline void across_sweep(const AcrossView& view, bool steep, const AcrossOutput& out,
                         std::size_t first_group, std::size_t last_group) {
  const ColumnScale scale({0, steep}, view.unit_m);
  for (std::size_t g = first_group; g < last_group; ++g) {
    const ColumnGroup& group = view.groups[g];
    const int n = static_cast<int>(group.end - group.begin);
    const ColumnRows rows(view.records + group.begin, n);
    for (int lane = 0; lane < n; lane += Lanes::width) {
      const ColumnSelf self(rows, lane);
      AcrossSums sums;
      sums.clear();
      for (std::uint32_t r = group.first_run; r < group.last_run; ++r) {
        const ColumnRecord* end = view.others + view.runs[r].end;
        for (const ColumnRecord* j = view.others + view.runs[r].begin; j != end; ++j)
          sums.add(self, *j, scale);
      }
      const std::size_t at = group.begin + lane;
      store_lanes(sums.thickness, out.thickness + at, n - lane);
      store_lanes(sums.ax, out.ax + at, n - lane);
      store_lanes(sums.ay, out.ay + at, n - lane);
      store_lanes(sums.az, out.az + at, n - lane);
      store_lanes(sums.approach, out.approach + at, n - lane);
    }
  }
}

}  // namespace sturz::STURZ_ISA
