// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/boundary_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz {
namespace {

double squared_distance(const Vec2& p, const Segment& s) {
  const Vec2 along = s.b - s.a, to = p - s.a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(to.dot(along) / length2, 0.0, 1.0) : 0;
  return (to - t * along).squaredNorm();
}

/// More buckets than this along an axis help no more.
constexpr double most_buckets = 512;

}  // namespace

SegmentIndex::SegmentIndex(std::vector<Segment> segments, double piece_m)
    : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  Vec2 low = segments_.front().a, high = low;
  for (const Segment& s : segments_) {
    low = low.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  low_ = low;
  size_ = std::max(piece_m, (high - low).maxCoeff() / most_buckets);
  n_cols_ = static_cast<int>((high - low).x() / size_) + 1;
  n_rows_ = static_cast<int>((high - low).y() / size_) + 1;
  for (const Segment& s : segments_) {
    const int n = std::max(1, static_cast<int>(std::ceil(s.length() / size_)));
    for (int k = 0; k < n; ++k)
      pieces_.push_back({s.a + (s.b - s.a) * k / n, s.a + (s.b - s.a) * (k + 1) / n});
  }
  const auto at = [&](double v, double from, int n) {
    return std::clamp(static_cast<int>((v - from) / size_), 0, n - 1);
  };
  // Twice over the pieces: first how many lie in each bucket, then which.
  begin_.assign(static_cast<std::size_t>(n_cols_) * n_rows_ + 1, 0);
  const auto for_each = [&](auto call) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Vec2 l = pieces_[i].a.cwiseMin(pieces_[i].b), h = pieces_[i].a.cwiseMax(pieces_[i].b);
      for (int row = at(l.y(), low_.y(), n_rows_); row <= at(h.y(), low_.y(), n_rows_); ++row)
        for (int col = at(l.x(), low_.x(), n_cols_); col <= at(h.x(), low_.x(), n_cols_); ++col)
          call(bucket_of(col, row), i);
    }
  };
  for_each([&](std::size_t bucket, std::size_t) { ++begin_[bucket + 1]; });
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  listed_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each([&](std::size_t bucket, std::size_t i) { listed_[next[bucket]++] = i; });
}

std::size_t SegmentIndex::bucket_of(int col, int row) const {
  return static_cast<std::size_t>(row) * n_cols_ + col;
}

double SegmentIndex::nearest_in(std::size_t bucket, const Vec2& from) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = begin_[bucket]; k < begin_[bucket + 1]; ++k)
    nearest = std::min(nearest, squared_distance(from, pieces_[listed_[k]]));
  return nearest;
}

// Rings of buckets around that of the point, or of the nearest place among the buckets: what lies
// r + 1 rings out is at least r bucket widths away.
double SegmentIndex::distance(const Vec2& from) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (empty()) return nearest;
  const auto at = [&](double v, double low, int n) {
    return static_cast<int>(std::clamp(std::floor((v - low) / size_), 0.0, n - 1.0));
  };
  const int col0 = at(from.x(), low_.x(), n_cols_), row0 = at(from.y(), low_.y(), n_rows_);
  const int last = std::max(n_cols_, n_rows_);
  for (int ring = 0; ring <= last; ++ring) {
    const double beyond = std::max(0, ring - 1) * size_;
    if (nearest <= beyond * beyond) break;
    for (int row = std::max(0, row0 - ring); row <= std::min(n_rows_ - 1, row0 + ring); ++row) {
      const bool whole = row == row0 - ring || row == row0 + ring;
      for (int col = col0 - ring; col <= col0 + ring; col += whole || ring == 0 ? 1 : 2 * ring)
        if (col >= 0 && col < n_cols_)
          nearest = std::min(nearest, nearest_in(bucket_of(col, row), from));
    }
  }
  return std::sqrt(nearest);
}

namespace {

/// One way.
struct Way {
  double sum = 0, length = 0, within = 0, largest = 0;
};

Way one_way(const SegmentIndex& from, const SegmentIndex& to, double step_m, double tolerance_m) {
  Way way;
  for (const Segment& s : from.segments()) {
    const int n = std::max(1, static_cast<int>(std::ceil(s.length() / step_m)));
    const double length = s.length() / n;
    way.largest = std::max(way.largest, to.distance(s.a));
    for (int k = 0; k < n; ++k) {
      const double middle = to.distance(s.a + (s.b - s.a) * (k + 0.5) / n);
      const double end = to.distance(s.a + (s.b - s.a) * (k + 1.0) / n);
      way.sum += length * middle;
      way.length += length;
      if (middle <= tolerance_m) way.within += length;
      way.largest = std::max({way.largest, middle, end});
    }
  }
  return way;
}

}  // namespace

BoundaryDistance boundary_distance(const SegmentIndex& a, const SegmentIndex& b, double step_m,
                                   double tolerance_m) {
  BoundaryDistance d;
  if (a.empty() || b.empty()) return d;
  const Way there = one_way(a, b, step_m, tolerance_m), back = one_way(b, a, step_m, tolerance_m);
  d.mean_m = (there.sum / there.length + back.sum / back.length) / 2;
  d.hausdorff_m = std::max(there.largest, back.largest);
  d.within = (there.within + back.within) / (there.length + back.length);
  return d;
}

}  // namespace sturz
