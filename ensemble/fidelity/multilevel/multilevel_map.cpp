// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/multilevel_map.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/multilevel/map_models.hpp"
#include "ensemble/fidelity/multilevel/residual_smoothing.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

constexpr int widest_smoothing = 3;  // cells
constexpr double surely_not = 0.05;  // 1 - that: surely
/// A probability that is seen on a map has a bound.
constexpr double least_shown = 0.005;

void require_memory(const MapLevels& levels, std::size_t n_cells, std::size_t n_dear) {
  const auto bytes = static_cast<double>(n_cells * map_bytes_a_cell(levels.levels.size(), n_dear));
  require(
      !(levels.memory_bytes > 0) || bytes <= levels.memory_bytes,
      fmt::format("hazard.cell_size_m (a multilevel map of {} cells that some members reach and "
                  "others do not takes {:.2g} GB, and {:.2g} GB are free). Free memory and run "
                  "the same again, which computes no member twice, or choose larger cells in "
                  "another folder.",
                  n_cells, bytes / 1e9, levels.memory_bytes / 1e9));
}

bool is_doubtful(double p) { return p > surely_not && p < 1 - surely_not; }

/// The draws of a map, once through: what each cell's levels tell.
class CellSums {
 public:
  CellSums(const MapLevels& levels, const DrawDistances& distances, CancelFlag cancel)
      : levels_(levels),
        n_cells_(distances.cells().size()),
        sums_(n_cells_, IncrementMoments(levels.levels.size())),
        noise_(n_cells_, 0),
        foretold_(n_cells_, 0),
        surprises_(n_cells_),
        dear_covered_(n_cells_, 0) {
    for (const std::size_t n : draws_of_levels(levels.draws, levels.levels.size()))
      counts_.push_back(static_cast<double>(n));
    std::vector<std::vector<Margins>> dear;
    for (const LevelDraw& draw : levels.draws)
      if (draw.from == 0) distances.read(draw, dear.emplace_back());
    expect(dear.size() >= least_draws, "enough draws at the dearest level");
    models_ = map_models(distances, dear, levels.spacings_m, cancel);
    std::size_t place = 0;
    for (const LevelDraw& draw : levels.draws) {
      if (draw.from == 0) {
        add_dear(dear[place], fold_of(place));
        ++place;
      } else {
        waiting_.emplace_back(draw.from, std::vector<Margins>());
        distances.read(draw, waiting_.back().second);
        if (waiting_.size() == most_waiting) add_waiting();
      }
    }
    add_waiting();
    for (double& n : noise_) n /= static_cast<double>(place);
  }

  const IncrementMoments& at(std::size_t cell) const { return sums_[cell]; }
  /// [n_draws of the dearest level][n_cells] indicator less prediction
  const std::vector<std::vector<float>>& residuals() const { return residuals_; }
  /// [n_draws of the dearest level][n_cells] what the same draws add to the estimate beside that
  const std::vector<std::vector<float>>& others() const { return others_; }
  /// Draws of the dearest level that cover it.
  std::uint32_t covering(std::size_t cell) const { return dear_covered_[cell]; }
  const Surprises& surprises(std::size_t cell) const { return surprises_[cell]; }
  /// The largest chance of a draw, as the levels that it has foretell it.
  double foretold(std::size_t cell) const { return foretold_[cell]; }
  /// Mean of g (1 - g): the variance of the residual as the model itself has it.
  double noise(std::size_t cell) const { return noise_[cell]; }

 private:
  void add_dear(const std::vector<Margins>& margins, std::size_t fold) {
    std::vector<float>& residual = residuals_.emplace_back(n_cells_, 0.0F);
    std::vector<float>& other = others_.emplace_back(n_cells_, 0.0F);
    const std::size_t n_levels = levels_.levels.size();
    tbb::parallel_for(std::size_t{0}, n_cells_, [&](std::size_t i) {
      std::array<double, most_levels> told{};
      told[0] = margins[i][0] > 0 ? 1 : 0;
      models_[i].probabilities(margins[i], 0, fold, std::span(told).subspan(1, n_levels - 1));
      sums_[i].add(0, std::span(told).first(n_levels));
      residual[i] = static_cast<float>(told[0] - told[1]);
      surprises_[i].add(told[0] - told[1]);
      foretold_[i] = std::max(foretold_[i], told[1]);
      double rest = 0;
      for (std::size_t l = 1; l < n_levels; ++l)
        rest += (told[l] - (l + 1 < n_levels ? told[l + 1] : 0)) / counts_[l];
      other[i] = static_cast<float>(rest);
      dear_covered_[i] += margins[i][0] > 0 ? 1 : 0;
      noise_[i] += told[1] * (1 - told[1]);
    });
  }

  /// Many draws in each cell's turn: threads meet seldom.
  void add_waiting() {
    const std::size_t n_levels = levels_.levels.size();
    tbb::parallel_for(std::size_t{0}, n_cells_, [&](std::size_t i) {
      std::array<double, most_levels> told{};
      for (const auto& [from, margins] : waiting_) {
        const std::span<double> of_draw = std::span(told).first(n_levels - from);
        models_[i].probabilities(margins[i], from, std::nullopt, of_draw);
        sums_[i].add(from, of_draw);
        foretold_[i] = std::max(foretold_[i], of_draw.front());
      }
    });
    waiting_.clear();
  }

  const MapLevels& levels_;
  std::size_t n_cells_;
  std::vector<FoldedModels> models_;
  std::vector<IncrementMoments> sums_;
  std::vector<std::vector<float>> residuals_, others_;
  std::vector<double> noise_, foretold_;
  std::vector<Surprises> surprises_;
  std::vector<std::uint32_t> dear_covered_;
  std::vector<double> counts_;                                         // [n_levels] draws
  std::vector<std::pair<std::size_t, std::vector<Margins>>> waiting_;  // draws of cheaper levels
};

/// Where all draws of all levels agree.
MultilevelMap blank(const DrawDistances& distances, double possible) {
  MultilevelMap map;
  map.extent = distances.extent();
  for (Raster<double>* r : {&map.probability, &map.low, &map.high})
    *r = Raster<double>(distances.grid(), 0);
  map.told = Raster<std::uint8_t>(distances.grid(), 0);
  for (std::size_t i = 0; i < map.probability.values.size(); ++i) {
    const bool always = distances.always(i);
    map.probability.values[i] = always ? 1 : 0;
    map.low.values[i] = always ? 1 - possible : 0;
    map.high.values[i] = always ? 1 : possible;
    map.told.values[i] = always ? 1 : 0;
  }
  return map;
}

/// The nearest falling row in the mean square.
void make_falling(std::span<double> row) {
  struct Block {
    double sum;
    std::size_t n;
    double mean() const { return sum / static_cast<double>(n); }
  };
  std::vector<Block> blocks;
  for (const double v : row) {
    blocks.push_back({v, 1});
    while (blocks.size() > 1 && blocks.back().mean() > blocks[blocks.size() - 2].mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().n += last.n;
    }
  }
  std::size_t at = 0;
  for (const Block& b : blocks)
    for (std::size_t k = 0; k < b.n; ++k) row[at++] = b.mean();
}

}  // namespace

MultilevelMap multilevel_map(const MapLevels& levels, const Exceedance& what, CancelFlag cancel) {
  const std::size_t n_levels = levels.levels.size();
  expect(n_levels >= 2 && n_levels <= most_levels, "a dear level and some cheaper ones");
  const DrawDistances distances(levels, what, cancel);
  const std::size_t n_dear = draws_of_levels(levels.draws, n_levels).front();
  MultilevelMap map = blank(distances, unseen_share(n_dear));
  map.variances.assign(n_levels, 0);
  const std::vector<std::size_t>& cells = distances.cells();
  if (cells.empty()) return map;
  require_memory(levels, cells.size(), n_dear);
  const CellSums sums(levels, distances, cancel);
  std::vector<std::uint8_t> doubtful;
  for (std::size_t i = 0; i < cells.size(); ++i) doubtful.push_back(is_doubtful(sums.at(i).mean()));
  const SmoothedCorrection correction = smoothed_correction(
      sums.residuals(), sums.others(), cells, distances.grid(), doubtful, widest_smoothing);
  map.smoothed_cells = correction.radius;
  map.smoothing_error = std::sqrt(correction.bias_squared);
  const double n = sums.at(0).draws(0);
  double squares = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const IncrementMoments& at = sums.at(i);
    double p = correction.mean[i];
    for (std::size_t l = 1; l < n_levels; ++l) p += at.increment(l);
    p = std::clamp(p, 0.0, 1.0);
    const bool told =
        sums.covering(i) > 0 || sums.foretold(i) >= least_foretold || p >= least_shown;
    map.told.values[cells[i]] = told ? 1 : 0;
    if (!told) p = 0;  // the tails of fits far out are no flow
    // Members that all come as foretold do not show how far they scatter.
    const double own = std::max(correction.variance[i], sums.noise(i) * correction.variance_ratio);
    const double parts = own / n + at.variance_of_mean(1);
    // The draws of the dearest level are among those of the others: of the covariance of a mean of
    // n of them with one of N the N-th part remains. No more than half is taken away by it.
    const double variance =
        std::max(parts + 2 * correction.covariance[i], parts / 2) + correction.bias_squared;
    map.probability.values[cells[i]] = p;
    const Interval bounds = share_bounds(p, std::sqrt(variance), n - 1, sums.surprises(i));
    map.low.values[cells[i]] = bounds.low;
    map.high.values[cells[i]] = bounds.high;
    if (!is_doubtful(p)) continue;
    ++map.doubtful;
    squares += variance;
    map.plain_variance += p * (1 - p);
    map.variances[0] += own;
    for (std::size_t l = 1; l < n_levels; ++l) map.variances[l] += at.variance(l);
  }
  if (map.doubtful > 0) map.rms_error = std::sqrt(squares / static_cast<double>(map.doubtful));
  return map;
}

void make_monotone(std::span<MultilevelMap> rising) {
  if (rising.empty()) return;
  for (std::size_t t = rising.size() - 1; t-- > 0;)
    for (std::size_t i = 0; i < rising[t].told.values.size(); ++i)
      rising[t].told.values[i] = std::max(rising[t].told.values[i], rising[t + 1].told.values[i]);
  std::vector<double> row(rising.size());
  for (Raster<double> MultilevelMap::*layer :
       {&MultilevelMap::probability, &MultilevelMap::low, &MultilevelMap::high})
    for (std::size_t i = 0; i < rising.front().probability.values.size(); ++i) {
      for (std::size_t t = 0; t < rising.size(); ++t) row[t] = (rising[t].*layer).values[i];
      make_falling(row);
      for (std::size_t t = 0; t < rising.size(); ++t) (rising[t].*layer).values[i] = row[t];
    }
}

}  // namespace sturz
