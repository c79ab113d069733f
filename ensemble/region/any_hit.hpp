// SPDX-License-Identifier: Apache-2.0
/// How probable it is that some source of a region reaches a cell if all release, and how sure that
/// is. Bounds are two-sided intervals of 90 %.
///
/// With values of its own for each source: P = 1 - prod(1 - p_i) and, with l_i and u_i the Wilson
/// bounds of p_i (ensemble/hazard/wilson.hpp),
///
///   lower = 1 - prod(1 - l_i),   upper = 1 - (1 - u_0) prod(1 - u_i)
///
/// over the sources that come in some member. log(1 - P) is a sum over sources, and the standard
/// deviation of a sum is at most the sum of the standard deviations, whatever goes together
/// (Minkowski's inequality). So the bounds hold where all sources share one table of values, which
/// makes their errors go together, and are wide where they do not.
/// Sources of which no member comes count together as one that came in none of the rows, u_0 being
/// the upper bound of 0 of the rows: for members that were drawn independently that is exact, since
/// no hit at all in n rows has the probability prod(1 - p_i)^n. Taken one by one, hundreds of far
/// sources would make every upper bound 1. What this cannot see: rare sources that come together.
/// Six of p = 0.05 with one table of 16 rows mostly leave no hit or six; where none is left, the
/// upper bound lies below P, and the interval holds it in half of the cases (tests).
///
/// With the same values for all: each row of the table is one trial that some source hits or none,
/// rows are independent, and the bounds are Wilson's of rows with a hit.
#pragma once

#include "ensemble/hazard/wilson.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Rows of the design in which some source reaches a cell; each counts once.
class RowCount {
 public:
  /// \param row_of_valid of each valid member \param n_rows of the design
  RowCount(std::span<const std::int64_t> row_of_valid, std::int64_t n_rows)
      : rows_(row_of_valid), seen_(static_cast<std::size_t>(n_rows), 0) {
    for (const std::int64_t row : rows_) {
      std::uint64_t& seen = seen_[static_cast<std::size_t>(row)];
      n_valid_ += seen == 0;
      seen = 1;
    }
  }
  void next_cell() {
    ++cell_;
    n_hit_ = 0;
  }
  void hit(std::uint32_t member) {
    std::uint64_t& seen = seen_[static_cast<std::size_t>(rows_[member])];
    n_hit_ += seen != cell_;
    seen = cell_;
  }
  /// NaN without rows.
  double share() const { return static_cast<double>(n_hit_) / static_cast<double>(n_valid_); }
  std::int64_t n_hit() const { return n_hit_; }
  /// Rows of which some source has a valid member.
  std::int64_t n_valid() const { return n_valid_; }
  ProbabilityBounds bounds() const { return wilson_interval(n_hit_, n_valid_, z_90); }

 private:
  std::span<const std::int64_t> rows_;
  std::vector<std::uint64_t> seen_;  // number of the last cell that the row hit
  std::uint64_t cell_ = 1;
  std::int64_t n_hit_ = 0, n_valid_ = 0;
};

/// Goes over the sources that come to a cell.
class AnyHit {
 public:
  /// \param n_sources with valid members \param n_rows of the table that they share
  AnyHit(std::size_t n_sources, std::int64_t n_rows)
      : n_sources_(n_sources), others_(wilson_interval(0, n_rows, z_90).upper) {}

  void next_cell() { none_ = not_lower_ = not_upper_ = 1, n_ = 0; }
  /// \param hits > 0, of so many members
  void add(std::int64_t hits, std::int64_t members) {
    const ProbabilityBounds b = wilson_interval(hits, members, z_90);
    none_ *= 1 - static_cast<double>(hits) / static_cast<double>(members);
    not_lower_ *= 1 - b.lower;
    not_upper_ *= 1 - b.upper;
    ++n_;
  }
  double probability() const { return 1 - none_; }
  ProbabilityBounds bounds() const {
    return {1 - not_lower_, 1 - not_upper_ * (n_ < n_sources_ ? 1 - others_ : 1)};
  }

 private:
  std::size_t n_sources_, n_ = 0;
  double others_;
  double none_ = 1, not_lower_ = 1, not_upper_ = 1;
};

}  // namespace sturz
