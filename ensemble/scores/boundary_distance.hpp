// SPDX-License-Identifier: Apache-2.0
/// How far two outlines lie apart.
#pragma once

#include "ensemble/scores/outline_segments.hpp"

#include <cstddef>
#include <vector>

namespace sturz {

/// Segments that can be asked for the nearest one.
class SegmentIndex {
 public:
  /// \param piece_m segments are kept in pieces of at most this length, and looked up in squares
  ///   about as wide; it changes the time of a search, not what is found
  SegmentIndex(std::vector<Segment> segments, double piece_m);

  bool empty() const { return segments_.empty(); }
  const std::vector<Segment>& segments() const { return segments_; }
  /// Distance to the nearest segment [m], exact; infinity when there is none.
  double distance(const Vec2& from) const;

 private:
  std::size_t bucket_of(int col, int row) const;
  double nearest_in(std::size_t bucket, const Vec2& from) const;  // squared

  std::vector<Segment> segments_, pieces_;
  Vec2 low_ = Vec2::Zero();
  double size_ = 1;
  int n_cols_ = 0, n_rows_ = 0;
  std::vector<std::size_t> begin_;  ///< of each bucket's pieces in `listed_`, and their end
  std::vector<std::size_t> listed_;
};

struct BoundaryDistance {
  /// Mean distance of the points of one outline to the other, both ways, and the mean of the two
  /// [m]; NaN when an outline is empty.
  double mean_m = nan_d;
  double hausdorff_m = nan_d;  ///< the largest of them: one cell thrown far ahead sets it
  double within = nan_d;       ///< share of both outlines' lengths that lies within a tolerance
};

/// \param step_m outlines are looked at in points at most this far apart (and at their corners):
///   the discrete Hausdorff distance, within half a step of the exact one
BoundaryDistance boundary_distance(const SegmentIndex& a, const SegmentIndex& b, double step_m,
                                   double tolerance_m);

}  // namespace sturz
