// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/map_models.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/signed_distance.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Weights fall by e over so many spacings of the dearest level, and over no less than so many
/// cells: what a member does far from the cell says little of it.
constexpr double spacings_of_weight = 5, cells_of_weight = 3;
constexpr double least_weight = 1e-4;

/// Sums of one fold in every cell, added up over the cells around.
std::vector<MarginSums> added_around(const std::vector<MarginSums>& sums,
                                     const DrawDistances& distances, int radius) {
  const int rows = distances.grid().n_rows, cols = distances.grid().n_cols;
  const std::vector<std::size_t>& cells = distances.cells();
  std::vector<std::ptrdiff_t> place(distances.grid().n_cells(), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) place[cells[i]] = static_cast<std::ptrdiff_t>(i);
  std::vector<MarginSums> added(sums.size());
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
    const int row = static_cast<int>(cells[i]) / cols, col = static_cast<int>(cells[i]) % cols;
    MarginSums all(sums[i].n_levels());
    for (int r = std::max(0, row - radius); r <= std::min(rows - 1, row + radius); ++r)
      for (int c = std::max(0, col - radius); c <= std::min(cols - 1, col + radius); ++c)
        if (const auto at = place[static_cast<std::size_t>(r) * cols + c]; at >= 0)
          all += sums[static_cast<std::size_t>(at)];
    added[i] = all;
  });
  return added;
}

}  // namespace

DrawDistances::DrawDistances(const MapLevels& levels, const Exceedance& what, CancelFlag cancel)
    : levels_(levels), what_(what), cancel_(cancel) {
  for (const MemberParts* level : levels.levels) {
    std::vector<std::int64_t>& numbers = numbers_.emplace_back();
    for (const MemberSummary& m : level->members()) numbers.push_back(m.member);
  }
  for (const LevelDraw& draw : levels.draws)
    for (std::size_t l = draw.from; l < numbers_.size(); ++l)
      extent_ = joined(extent_, levels.levels[l]->members()[index_of(l, draw.number)].window);
  const Grid& whole = levels.levels.front()->grid();
  extent_ = widened(extent_, 1, whole);
  grid_ = grid_of(extent_, whole);
  std::vector<std::uint32_t> some(grid_.n_cells(), 0);
  std::uint32_t n = 0;
  for (const LevelDraw& draw : levels.draws)
    for (std::size_t l = draw.from; l < numbers_.size(); ++l, ++n) {
      cancel.check();
      const auto covered =
          covered_cells(*levels.levels[l], index_of(l, draw.number), what, extent_);
      for (std::size_t i = 0; i < some.size(); ++i) some[i] += covered.values[i];
    }
  for (std::size_t i = 0; i < some.size(); ++i) {
    always_.push_back(some[i] == n && n > 0 ? 1 : 0);
    if (some[i] > 0 && some[i] < n) cells_.push_back(i);
  }
}

std::size_t DrawDistances::index_of(std::size_t level, std::int64_t number) const {
  const std::vector<std::int64_t>& numbers = numbers_[level];
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
  expect(found != numbers.end() && *found == number, "a member of the level");
  return static_cast<std::size_t>(found - numbers.begin());
}

void DrawDistances::read(const LevelDraw& draw, std::vector<Margins>& out) const {
  cancel_.check();
  out.resize(cells_.size());
  for (std::size_t l = draw.from; l < numbers_.size(); ++l) {
    const Raster<float> distance = signed_distance(
        covered_cells(*levels_.levels[l], index_of(l, draw.number), what_, extent_));
    for (std::size_t i = 0; i < cells_.size(); ++i) out[i][l] = distance.values[cells_[i]];
  }
}

std::size_t map_bytes_a_cell(std::size_t n_levels, std::size_t n_dear) {
  const std::size_t n_folds = std::min(n_dear, most_folds);
  return n_folds * (sizeof(MarginSums) + (n_levels - 1) * sizeof(MarginModel)) +
         2 * sizeof(MarginSums) + sizeof(FoldedModels) + sizeof(IncrementMoments) +
         sizeof(Surprises) + 2 * sizeof(double) + sizeof(std::uint32_t) +
         n_dear * (sizeof(Margins) + 2 * sizeof(float)) + most_waiting * sizeof(Margins);
}

std::vector<FoldedModels> map_models(const DrawDistances& distances,
                                     const std::vector<std::vector<Margins>>& dear,
                                     std::span<const double> spacings_m, CancelFlag cancel) {
  const std::size_t n_cells = distances.cells().size(), n_levels = spacings_m.size();
  const std::size_t n_folds = std::min(dear.size(), most_folds);
  const double cell_m = distances.grid().cell_m;
  const double fall_m = std::max(spacings_of_weight * spacings_m.front(), cells_of_weight * cell_m);
  const double coarsest = *std::max_element(spacings_m.begin(), spacings_m.end());
  const int radius = static_cast<int>(coarsest / cell_m);
  std::vector<double> counts(n_folds, 0);
  std::vector<std::vector<MarginSums>> folds(n_folds);
  for (std::size_t f = 0; f < n_folds; ++f) {
    cancel.check();
    std::vector<MarginSums> sums(n_cells, MarginSums(n_levels));
    for (std::size_t k = f; k < dear.size(); k += n_folds) {
      counts[f] += 1;
      for (std::size_t i = 0; i < n_cells; ++i)
        sums[i].add(dear[k][i],
                    std::max(least_weight, std::exp(-std::abs(dear[k][i][0]) / fall_m)));
    }
    folds[f] = radius > 0 ? added_around(sums, distances, radius) : std::move(sums);
  }
  std::vector<FoldedModels> models(n_cells);
  tbb::parallel_for(std::size_t{0}, n_cells, [&](std::size_t i) {
    std::vector<MarginSums> of_cell;
    for (std::size_t f = 0; f < n_folds; ++f) of_cell.push_back(folds[f][i]);
    models[i] = FoldedModels(of_cell, counts, 0.01 * cell_m);
  });
  return models;
}

}  // namespace sturz
