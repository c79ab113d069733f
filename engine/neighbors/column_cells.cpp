// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/column_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz {
namespace {

/// Edge of a cell over the mean reach: sixteen columns then fill a strip that wastes few pairs.
constexpr double cell_per_reach = 0.6;

/// Groups are cut where the run of columns leaves its cell row, and where a gap as long as this
/// many cells would make one group search a wide, mostly foreign strip.
constexpr std::int32_t widest_gap = 2;

struct Extent {
  double min = 1e300, max = -1e300;
  void add(double v) { min = std::min(min, v), max = std::max(max, v); }
};

}  // namespace

void ColumnCells::build(const ParticleSet& set, const Domain& domain,
                        const std::vector<double>& reach) {
  const double longest = reach.empty() ? 0 : *std::max_element(reach.begin(), reach.end());
  const double mean = std::accumulate(reach.begin(), reach.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, reach.size()));
  choose_frame(set, longest, cell_per_reach * mean);
  collect(set, domain, longest);
  sort_items();
  place(set);
  make_groups(set, reach);
}

void ColumnCells::choose_frame(const ParticleSet& set, double reach, double cell) {
  Extent x, y, z;
  for (std::size_t i = 0; i < set.size(); ++i) x.add(set.x[i]), y.add(set.y[i]), z.add(set.z[i]);
  if (set.size() == 0) x = y = z = {0, 0};
  cell_ = cell > 0 ? cell : 1;
  west_ = x.min - reach, south_ = y.min - reach;
  origin_z_ = 0.5 * (z.min + z.max);
  auto count = [&](const Extent& e) { return (e.max - e.min + 2 * reach) / cell_ + 1; };
  // A few stray columns must not cost a table of empty cells.
  while (count(x) * count(y) > 16.0 * set.size() + 4096) cell_ *= 2;
  n_cols_ = static_cast<std::int32_t>(count(x)), n_rows_ = static_cast<std::int32_t>(count(y));
  // The finest power of two that keeps differences inside 31 bits.
  const double extent =
      std::max({x.max - x.min, y.max - y.min, z.max - z.min, cell_}) + 4 * reach + 4 * cell_;
  unit_ = std::exp2(std::ceil(std::log2(extent / 1.0e9)));
}

std::int32_t ColumnCells::col_of(double x) const {
  return std::clamp(static_cast<std::int32_t>((x - west_) / cell_), 0, n_cols_ - 1);
}

std::int32_t ColumnCells::row_of(double y) const {
  return std::clamp(static_cast<std::int32_t>((y - south_) / cell_), 0, n_rows_ - 1);
}

void ColumnCells::collect(const ParticleSet& set, const Domain& domain, double reach) {
  items_.clear();
  auto add = [&](std::size_t i, double dx, double dy, double dz) {
    const auto cell = static_cast<std::uint32_t>(row_of(set.y[i] + dy) * n_cols_ +
                                                 col_of(set.x[i] + dx));
    items_.push_back({static_cast<std::uint32_t>(i), cell, dx, dy, dz});
  };
  for (std::size_t i = 0; i < set.size(); ++i) add(i, 0, 0, 0);
  if (!domain.x.active && !domain.y.active) return;
  // Images stand within one reach of the period's edges, where the frame has room for them.
  auto shifts = [&](const Period& p, double position, double out[3]) {
    int n = 0;
    out[n++] = 0;
    if (!p.active) return n;
    if (position < p.min + reach) out[n++] = 1;
    if (position >= p.max - reach) out[n++] = -1;
    return n;
  };
  for (std::size_t i = 0; i < set.size(); ++i) {
    double sx[3], sy[3];
    const int nx = shifts(domain.x, set.x[i], sx), ny = shifts(domain.y, set.y[i], sy);
    for (int a = 0; a < nx; ++a)
      for (int b = 0; b < ny; ++b)
        if (sx[a] != 0 || sy[b] != 0)
          add(i, sx[a] * domain.x.length(), sy[b] * domain.y.length(),
              sx[a] * domain.x.rise + sy[b] * domain.y.rise);
  }
}

/// By counting, stable: the order within a cell is that of storage.
void ColumnCells::sort_items() {
  cell_begin_.assign(static_cast<std::size_t>(n_cols_) * n_rows_ + 1, 0);
  for (const Item& item : items_) ++cell_begin_[item.cell + 1];
  std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
  next_.assign(cell_begin_.begin(), cell_begin_.end() - 1);
  sorted_.resize(items_.size());
  for (const Item& item : items_) sorted_[next_[item.cell]++] = item;
}

void ColumnCells::place(const ParticleSet& set) {
  source_.resize(sorted_.size());
  is_image_.resize(sorted_.size());
  records_.resize(sorted_.size());
  const double per_unit = 1 / unit_;
  auto units = [&](double d) { return static_cast<std::int32_t>(std::lrint(d * per_unit)); };
  for (std::size_t k = 0; k < sorted_.size(); ++k) {
    const Item& item = sorted_[k];
    source_[k] = item.source;
    is_image_[k] = item.dx != 0 || item.dy != 0;
    records_[k].x = units(set.x[item.source] + item.dx - west_);
    records_[k].y = units(set.y[item.source] + item.dy - south_);
    records_[k].z = units(set.z[item.source] + item.dz - origin_z_);
  }
}

void ColumnCells::make_groups(const ParticleSet& set, const std::vector<double>& reach) {
  groups_.clear();
  std::uint32_t begin = 0;
  const auto n = static_cast<std::uint32_t>(sorted_.size());
  while (begin < n) {
    const std::int32_t row = static_cast<std::int32_t>(sorted_[begin].cell) / n_cols_;
    Extent x, y;
    double longest = 0;
    std::uint32_t end = begin;
    for (; end < n && end - begin < group_size; ++end) {
      const Item& item = sorted_[end];
      if (static_cast<std::int32_t>(item.cell) / n_cols_ != row) break;
      if (end > begin &&
          static_cast<std::int32_t>(item.cell - sorted_[end - 1].cell) > widest_gap)
        break;
      x.add(set.x[item.source] + item.dx), y.add(set.y[item.source] + item.dy);
      longest = std::max(longest, reach[item.source]);
    }
    groups_.push_back({begin, end, row_of(y.min - longest), row_of(y.max + longest),
                       col_of(x.min - longest), col_of(x.max + longest)});
    begin = end;
  }
}

ColumnView ColumnCells::view() const {
  return {records_.data(), groups_.data(), cell_begin_.data(), n_cols_, unit_};
}

std::size_t ColumnCells::bytes() const {
  return (items_.capacity() + sorted_.capacity()) * sizeof(Item) +
         (source_.capacity() + cell_begin_.capacity() + next_.capacity()) * sizeof(std::uint32_t) +
         is_image_.capacity() + records_.capacity() * sizeof(ColumnRecord) +
         groups_.capacity() * sizeof(ColumnGroup);
}

}  // namespace sturz
