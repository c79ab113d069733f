// SPDX-License-Identifier: Apache-2.0
/// What cheaper levels tell of a margin at the dearest one: how far a result lies above its
/// threshold, or a cell inside what a member covers.
#pragma once

#include "ensemble/fidelity/multilevel/increments.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sturz {

/// Margins of one draw: [l] at level l; only those from the dearest level that it has are read.
using Margins = std::array<double, most_levels>;

/// y = constant + sum over l >= first of slopes[l] x_l, and how far y scatters around it.
struct MarginModel {
  std::size_t first = 1, n_levels = 1;
  double constant = 0;
  std::array<double, most_levels> slopes{};
  double scale = 0;  ///< standard deviation of what remains

  double margin(const Margins&) const;
  /// That y > threshold, for a normal remainder: the indicator smoothed over the model's own error.
  double probability(const Margins&, double threshold = 0) const;
};

/// Weighted sums of products of 1, x_1 ... and y = x_0: all that a least-squares fit needs. Sums of
/// folds and of neighbouring cells add up.
class MarginSums {
 public:
  explicit MarginSums(std::size_t n_levels = 1) : n_levels_(n_levels) {}
  void add(const Margins&, double weight);
  MarginSums& operator+=(const MarginSums&);
  /// On the levels from `first` on. With `first` = n_levels() the mean alone.
  /// \param n_draws that the sums stand for, whatever their weight: of degrees of freedom
  /// \param least_scale below which no scale goes
  MarginModel fit(std::size_t first, double n_draws, double least_scale) const;
  std::size_t n_levels() const { return n_levels_; }

 private:
  std::size_t n_levels_;
  /// [i <= j] of (y, x_1, ..., x_{L-1}, 1), the last in place most_levels.
  std::array<std::array<double, most_levels + 1>, most_levels + 1> sum_{};
};

/// Draws of the dearest level are left out in so many turns when predictions are fitted, each by
/// its place among them.
inline constexpr std::size_t most_folds = 10;
inline std::size_t fold_of(std::size_t place) { return place % most_folds; }

/// Fits without each fold: [fold][level]; a level's is of the levels from it on, level 0's unused.
class FoldedModels {
 public:
  FoldedModels() = default;
  /// \param folds sums of each, [n_folds] \param counts draws of each
  FoldedModels(std::span<const MarginSums> folds, std::span<const double> counts,
               double least_scale);
  /// Predicted margins, or probabilities, of the levels from max(from, 1) on: of a draw of `fold`,
  /// or of one that is in none (the mean over the folds by their draws).
  /// \param told [n_levels - max(from, 1)]
  void margins(const Margins&, std::size_t from, std::optional<std::size_t> fold,
               std::span<double> told) const;
  void probabilities(const Margins&, std::size_t from, std::optional<std::size_t> fold,
                     std::span<double> told) const;
  /// That y <= t.
  void shares_below(double t, const Margins&, std::size_t from, std::optional<std::size_t> fold,
                    std::span<double> told) const;

 private:
  template <class Value>
  void tell(std::size_t from, std::optional<std::size_t> fold, std::span<double> told,
            Value value) const;

  std::size_t n_levels_ = 1;
  std::vector<double> shares_;       // of the draws
  std::vector<MarginModel> models_;  // [fold][level - 1]
};

}  // namespace sturz
