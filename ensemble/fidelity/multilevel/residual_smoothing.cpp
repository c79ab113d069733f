// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/residual_smoothing.hpp"

#include <algorithm>
#include <limits>

namespace sturz {
namespace {

/// Mean over a square of cells, those of the grid alone, by sums over rectangles.
class BoxMean {
 public:
  BoxMean(const Grid& grid, const std::vector<std::size_t>& places)
      : rows_(grid.n_rows),
        cols_(grid.n_cols),
        places_(places),
        sums_(static_cast<std::size_t>(rows_ + 1) * (cols_ + 1)) {}

  void take(const std::vector<float>& values) {
    std::fill(sums_.begin(), sums_.end(), 0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto row = places_[i] / cols_, col = places_[i] % cols_;
      sums_[(row + 1) * (cols_ + 1) + col + 1] = values[i];
    }
    for (int r = 1; r <= rows_; ++r)
      for (int c = 1; c <= cols_; ++c) at(r, c) += at(r - 1, c) + at(r, c - 1) - at(r - 1, c - 1);
  }

  double around(std::size_t place, int radius) {
    const int row = static_cast<int>(place) / cols_, col = static_cast<int>(place) % cols_;
    const int r0 = std::max(0, row - radius), r1 = std::min(rows_, row + radius + 1);
    const int c0 = std::max(0, col - radius), c1 = std::min(cols_, col + radius + 1);
    return (at(r1, c1) - at(r0, c1) - at(r1, c0) + at(r0, c0)) / ((r1 - r0) * (c1 - c0));
  }

 private:
  double& at(int r, int c) { return sums_[static_cast<std::size_t>(r) * (cols_ + 1) + c]; }

  int rows_, cols_;
  const std::vector<std::size_t>& places_;
  std::vector<double> sums_;
};

/// Mean and variance of one member's values, cell by cell.
struct Spread {
  std::vector<double> sum, squares;
  explicit Spread(std::size_t n) : sum(n, 0), squares(n, 0) {}
  void add(std::size_t i, double v) { sum[i] += v, squares[i] += v * v; }
  double mean(std::size_t i, double n) const { return sum[i] / n; }
  double variance(std::size_t i, double n) const {
    return std::max(0.0, (squares[i] - sum[i] * sum[i] / n) / (n - 1));
  }
};

}  // namespace

SmoothedCorrection smoothed_correction(const std::vector<std::vector<float>>& residuals,
                                       const std::vector<std::vector<float>>& others,
                                       const std::vector<std::size_t>& places, const Grid& grid,
                                       const std::vector<std::uint8_t>& counts, int most) {
  const std::size_t n_cells = places.size();
  const auto n = static_cast<double>(residuals.size());
  BoxMean box(grid, places);
  SmoothedCorrection best;
  double least = std::numeric_limits<double>::infinity(), plain_variance = 0;
  for (int radius = 0; radius <= most; ++radius) {
    Spread smooth(n_cells), shift(n_cells);
    std::vector<double> products(n_cells, 0), other_sum(n_cells, 0);
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      const std::vector<float>& member = residuals[k];
      box.take(member);
      for (std::size_t i = 0; i < n_cells; ++i) {
        const double s = radius == 0 ? member[i] : box.around(places[i], radius);
        smooth.add(i, s);
        shift.add(i, s - member[i]);
        if (others.empty()) continue;
        products[i] += s * others[k][i];
        other_sum[i] += others[k][i];
      }
    }
    double risk = 0, bias = 0, variance = 0, cells = 0;
    for (std::size_t i = 0; i < n_cells; ++i) {
      if (counts[i] == 0) continue;
      const double d = shift.mean(i, n);
      bias += d * d - shift.variance(i, n) / n;
      variance += smooth.variance(i, n);
      cells += 1;
    }
    risk = bias + variance / n;
    if (radius == 0) plain_variance = variance;
    if (!(risk < least)) continue;
    least = risk;
    best.radius = radius;
    best.mean.assign(n_cells, 0);
    best.variance.assign(n_cells, 0);
    best.covariance.assign(n_cells, 0);
    for (std::size_t i = 0; i < n_cells; ++i) {
      best.mean[i] = smooth.mean(i, n);
      best.variance[i] = smooth.variance(i, n);
      best.covariance[i] = (products[i] - smooth.sum[i] * other_sum[i] / n) / (n - 1);
    }
    best.bias_squared = cells > 0 ? std::max(0.0, bias / cells) : 0;
    best.variance_ratio = plain_variance > 0 ? variance / plain_variance : 1;
  }
  return best;
}

}  // namespace sturz
