// SPDX-License-Identifier: Apache-2.0
/// What one member left in a part of its window, without the cells that it did not touch.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

struct TouchedCells {
  /// Neighbours in one row.
  struct Run {
    int row = 0, col = 0, n = 0;  ///< of the first cell, in the grid; number of cells
  };
  std::vector<Run> runs;                   ///< by row, then column; none overlaps another
  std::vector<std::vector<float>> values;  ///< [layer that was asked for][cell of the runs]
  std::size_t n_cells = 0;                 ///< of all runs

  void reset(std::size_t n_layers) {
    runs.clear();
    values.resize(n_layers);
    for (auto& layer : values) layer.clear();
    n_cells = 0;
  }

  /// From all cells of a window. \param dense [layer][window.n_cells()]
  void take_touched(const Window& window, std::span<const PeakLayer> layers,
                    const std::vector<std::vector<float>>& dense) {
    reset(layers.size());
    std::size_t i = 0;
    for (int row = window.row0; row < window.end_row(); ++row) {
      bool goes_on = false;
      for (int col = window.col0; col < window.end_col(); ++col, ++i) {
        bool touched = false;
        for (std::size_t l = 0; l < layers.size(); ++l)
          touched |= differs(dense[l][i], info(layers[l]).untouched);
        if (touched) {
          if (!goes_on) runs.push_back({row, col, 0});
          ++runs.back().n;
          ++n_cells;
          for (std::size_t l = 0; l < layers.size(); ++l) values[l].push_back(dense[l][i]);
        }
        goes_on = touched;
      }
    }
  }

 private:
  static bool differs(float value, float untouched) {
    return value != untouched && !(std::isnan(value) && std::isnan(untouched));
  }
};

}  // namespace sturz
