// SPDX-License-Identifier: Apache-2.0
/// One member as scores see it: its scalars, and its maps wherever they are kept.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <array>
#include <span>

namespace sturz {

struct MemberView {
  MemberScalars scalars;
  Censoring censoring = Censoring::none;
  bool columns = false;  ///< depth_averaged
  Window window;         ///< in the grid of the maps
  /// [window.n_rows][window.n_cols]; empty where the member has none
  std::array<std::span<const float>, n_peak_layers> layers;

  float at(PeakLayer layer, int row, int col) const {
    const auto& values = layers[static_cast<std::size_t>(layer)];
    if (values.empty() || !window.contains(row, col)) return info(layer).untouched;
    return values[static_cast<std::size_t>(row - window.row0) * window.n_cols +
                  static_cast<std::size_t>(col - window.col0)];
  }
};

/// Of a result in memory, which must outlive it.
MemberView view_of(const MemberResult&);
/// Without its maps.
MemberView view_of(const MemberSummary&);

}  // namespace sturz
