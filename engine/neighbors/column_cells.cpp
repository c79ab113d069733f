// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/column_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz {
namespace {

/// Cells are flat rows cut finely: sixteen columns in a row of half a support radius fill a patch
/// about twice as long as high, and a run of neighbours ends near the circle around it.
constexpr double height_per_radius = 0.5, width_per_radius = 0.125;

/// A group ends at the end of its row, and at a gap of this many cells, beyond which it would
/// search a long strip between strangers.
constexpr std::int32_t widest_gap = 8;

struct Extent {
  double min = 1e300, max = -1e300;
  void add(double v) { min = std::min(min, v), max = std::max(max, v); }
};

}  // namespace

void ColumnCells::build(const ParticleSet& set, const Domain& domain,
                        const std::vector<double>& support_radius) {
  const double longest =
      support_radius.empty() ? 0 : *std::max_element(support_radius.begin(), support_radius.end());
  const double mean = std::accumulate(support_radius.begin(), support_radius.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, support_radius.size()));
  choose_frame(set, longest, mean);
  collect(set, domain, longest);
  sort_items();
  place(set);
  make_groups(set, support_radius);
}

void ColumnCells::choose_frame(const ParticleSet& set, double longest, double mean) {
  Extent x, y, z;
  for (std::size_t i = 0; i < set.size(); ++i) x.add(set.x[i]), y.add(set.y[i]), z.add(set.z[i]);
  if (set.size() == 0) x = y = z = {0, 0};
  width_ = mean > 0 ? width_per_radius * mean : 1;
  height_ = mean > 0 ? height_per_radius * mean : 1;
  // Room for periodic images around the columns.
  west_ = x.min - longest, south_ = y.min - longest;
  origin_z_ = 0.5 * (z.min + z.max);
  auto count = [&](const Extent& e, double edge) {
    return (e.max - e.min + 2 * longest) / edge + 1;
  };
  // A few stray columns must not cost a table of empty cells.
  while (count(x, width_) * count(y, height_) > 16.0 * set.size() + 4096) width_ *= 2, height_ *= 2;
  n_cols_ = static_cast<std::int32_t>(count(x, width_));
  n_rows_ = static_cast<std::int32_t>(count(y, height_));
  // The finest power of two that keeps differences inside 31 bits.
  const double extent =
      std::max({x.max - x.min, y.max - y.min, z.max - z.min, height_}) + 4 * longest + 4 * height_;
  unit_ = std::exp2(std::ceil(std::log2(extent / 1.0e9)));
}

std::int32_t ColumnCells::col_of(double x) const {
  return std::clamp(static_cast<std::int32_t>((x - west_) / width_), 0, n_cols_ - 1);
}

std::int32_t ColumnCells::row_of(double y) const {
  return std::clamp(static_cast<std::int32_t>((y - south_) / height_), 0, n_rows_ - 1);
}

void ColumnCells::collect(const ParticleSet& set, const Domain& domain, double support_radius) {
  items_.clear();
  auto add = [&](std::size_t i, double dx, double dy, double dz) {
    const auto cell =
        static_cast<std::uint32_t>(row_of(set.y[i] + dy) * n_cols_ + col_of(set.x[i] + dx));
    items_.push_back({static_cast<std::uint32_t>(i), cell, dx, dy, dz});
  };
  for (std::size_t i = 0; i < set.size(); ++i) add(i, 0, 0, 0);
  if (!domain.x.active && !domain.y.active) return;
  // Images stand within one support radius of the period's edges; where the period is shorter than
  // the support radius, several of them do. Those beyond the frame are neighbours of no column and
  // would not fit into the records' positions.
  const double east = west_ + n_cols_ * width_, north = south_ + n_rows_ * height_;
  auto for_each_turn = [&](const Period& p, double position, auto&& visit) {
    visit(0);
    if (!p.active) return;
    for (int k = 1; position + (k - 1) * p.length() < p.min + support_radius; ++k) visit(k);
    for (int k = 1; position - (k - 1) * p.length() >= p.max - support_radius; ++k) visit(-k);
  };
  for (std::size_t i = 0; i < set.size(); ++i)
    for_each_turn(domain.x, set.x[i], [&](int a) {
      for_each_turn(domain.y, set.y[i], [&](int b) {
        const double dx = a * domain.x.length(), dy = b * domain.y.length();
        const double x = set.x[i] + dx, y = set.y[i] + dy;
        if ((a != 0 || b != 0) && x >= west_ && x <= east && y >= south_ && y <= north)
          add(i, dx, dy, a * domain.x.rise + b * domain.y.rise);
      });
    });
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

struct ColumnCells::Box {
  Extent x, y;
};

void ColumnCells::make_groups(const ParticleSet& set, const std::vector<double>& support_radius) {
  groups_.clear();
  runs_.clear();
  std::uint32_t begin = 0;
  const auto n = static_cast<std::uint32_t>(sorted_.size());
  while (begin < n) {
    const std::uint32_t row = sorted_[begin].cell / static_cast<std::uint32_t>(n_cols_);
    const std::uint32_t row_end = cell_begin_[(row + 1) * static_cast<std::uint32_t>(n_cols_)];
    Box box;
    double longest = 0;
    std::uint32_t end = begin;
    for (; end < row_end && end - begin < group_size; ++end) {
      const Item& item = sorted_[end];
      if (end > begin && static_cast<std::int32_t>(item.cell - sorted_[end - 1].cell) > widest_gap)
        break;
      box.x.add(set.x[item.source] + item.dx), box.y.add(set.y[item.source] + item.dy);
      longest = std::max(longest, support_radius[item.source]);
    }
    const auto first_run = static_cast<std::uint32_t>(runs_.size());
    add_runs(box, longest);
    groups_.push_back({begin, end, first_run, static_cast<std::uint32_t>(runs_.size())});
    begin = end;
  }
}

/// In each row what lies within `support_radius` of the box, no farther along than the row's
/// distance leaves.
void ColumnCells::add_runs(const Box& box, double support_radius) {
  for (std::int32_t row = row_of(box.y.min - support_radius);
       row <= row_of(box.y.max + support_radius); ++row) {
    const double south = south_ + row * height_, north = south + height_;
    // A hair wider than the circle: cells are found with rounding.
    const double off =
        std::max({0.0, box.y.min - north, south - box.y.max}) - 1e-9 * support_radius;
    const double along = off > 0
                             ? std::sqrt(std::max(0.0, support_radius * support_radius - off * off))
                             : support_radius;
    const std::uint32_t* cells = cell_begin_.data() + std::ptrdiff_t{row} * n_cols_;
    const std::uint32_t begin = cells[col_of(box.x.min - along)];
    const std::uint32_t end = cells[col_of(box.x.max + along) + 1];
    if (begin < end) runs_.push_back({begin, end});
  }
}

ColumnView ColumnCells::view() const {
  return {records_.data(), groups_.data(), runs_.data(), unit_};
}

std::size_t ColumnCells::bytes() const {
  return (items_.capacity() + sorted_.capacity()) * sizeof(Item) +
         (source_.capacity() + cell_begin_.capacity() + next_.capacity()) * sizeof(std::uint32_t) +
         is_image_.capacity() + records_.capacity() * sizeof(ColumnRecord) +
         groups_.capacity() * sizeof(ColumnGroup) + runs_.capacity() * sizeof(ColumnRun);
}

}  // namespace sturz
