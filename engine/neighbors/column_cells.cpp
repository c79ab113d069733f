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

double longest_of(const std::vector<double>& radius) {
  return radius.empty() ? 0 : *std::max_element(radius.begin(), radius.end());
}

/// Extents, number and support radii of all columns that a frame is for.
struct Columns {
  Extent x, y, z;
  std::size_t n = 0;
  double longest = 0, sum = 0;

  void add(const ParticleSet& set, const std::vector<double>& support_radius) {
    for (std::size_t i = 0; i < set.size(); ++i) x.add(set.x[i]), y.add(set.y[i]), z.add(set.z[i]);
    n += set.size();
    longest = std::max(longest, longest_of(support_radius));
    sum = std::accumulate(support_radius.begin(), support_radius.end(), sum);
  }
};

ColumnFrame frame_around(Columns c) {
  ColumnFrame f;
  const double mean = c.sum / static_cast<double>(std::max<std::size_t>(1, c.n));
  if (c.n == 0) c.x = c.y = c.z = {0, 0};
  f.width = mean > 0 ? width_per_radius * mean : 1;
  f.height = mean > 0 ? height_per_radius * mean : 1;
  // Room for periodic images around the columns.
  f.west = c.x.min - c.longest, f.south = c.y.min - c.longest;
  f.origin_z = 0.5 * (c.z.min + c.z.max);
  auto count = [&](const Extent& e, double edge) {
    return (e.max - e.min + 2 * c.longest) / edge + 1;
  };
  // A few stray columns must not cost a table of empty cells.
  while (count(c.x, f.width) * count(c.y, f.height) > 16.0 * c.n + 4096)
    f.width *= 2, f.height *= 2;
  f.n_cols = static_cast<std::int32_t>(count(c.x, f.width));
  f.n_rows = static_cast<std::int32_t>(count(c.y, f.height));
  // The finest power of two that keeps differences inside 31 bits.
  const double extent =
      std::max({c.x.max - c.x.min, c.y.max - c.y.min, c.z.max - c.z.min, f.height}) +
      4 * c.longest + 4 * f.height;
  f.unit = std::exp2(std::ceil(std::log2(extent / 1.0e9)));
  return f;
}

}  // namespace

void ColumnCells::build(const ParticleSet& set, const Domain& domain,
                        const std::vector<double>& support_radius) {
  Columns all;
  all.add(set, support_radius);
  build(set, domain, support_radius, frame_around(all));
}

void ColumnCells::build(const ParticleSet& set, const Domain& domain,
                        const std::vector<double>& support_radius, const ColumnFrame& frame) {
  frame_ = frame;
  collect(set, domain, longest_of(support_radius));
  sort_items();
  place(set);
  make_groups(set, support_radius);
}

ColumnFrame ColumnCells::frame_of(const ParticleSet& set, const ParticleSet& other,
                                  const std::vector<double>& support_radius,
                                  const std::vector<double>& other_support_radius) {
  Columns all;
  all.add(set, support_radius);
  all.add(other, other_support_radius);
  return frame_around(all);
}

std::int32_t ColumnCells::col_of(double x) const {
  return std::clamp(static_cast<std::int32_t>((x - frame_.west) / frame_.width), 0,
                    frame_.n_cols - 1);
}

std::int32_t ColumnCells::row_of(double y) const {
  return std::clamp(static_cast<std::int32_t>((y - frame_.south) / frame_.height), 0,
                    frame_.n_rows - 1);
}

void ColumnCells::collect(const ParticleSet& set, const Domain& domain, double support_radius) {
  items_.clear();
  auto add = [&](std::size_t i, double dx, double dy, double dz) {
    const auto cell =
        static_cast<std::uint32_t>(row_of(set.y[i] + dy) * frame_.n_cols + col_of(set.x[i] + dx));
    items_.push_back({static_cast<std::uint32_t>(i), cell, dx, dy, dz});
  };
  for (std::size_t i = 0; i < set.size(); ++i) add(i, 0, 0, 0);
  if (!domain.x.active && !domain.y.active) return;
  // Images stand within one support radius of the period's edges; where the period is shorter than
  // the support radius, several of them do. Those beyond the frame are neighbours of no column and
  // would not fit into the records' positions.
  const double east = frame_.west + frame_.n_cols * frame_.width,
               north = frame_.south + frame_.n_rows * frame_.height;
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
        if ((a != 0 || b != 0) && x >= frame_.west && x <= east && y >= frame_.south && y <= north)
          add(i, dx, dy, a * domain.x.rise + b * domain.y.rise);
      });
    });
}

/// By counting, stable: the order within a cell is that of storage.
void ColumnCells::sort_items() {
  cell_begin_.assign(static_cast<std::size_t>(frame_.n_cols) * frame_.n_rows + 1, 0);
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
  const double per_unit = 1 / frame_.unit;
  auto units = [&](double d) { return static_cast<std::int32_t>(std::lrint(d * per_unit)); };
  for (std::size_t k = 0; k < sorted_.size(); ++k) {
    const Item& item = sorted_[k];
    source_[k] = item.source;
    is_image_[k] = item.dx != 0 || item.dy != 0;
    records_[k].x = units(set.x[item.source] + item.dx - frame_.west);
    records_[k].y = units(set.y[item.source] + item.dy - frame_.south);
    records_[k].z = units(set.z[item.source] + item.dz - frame_.origin_z);
  }
}

struct ColumnCells::Box {
  Extent x, y;
};

ColumnCells::Box ColumnCells::box_of(const ParticleSet& set, std::uint32_t begin,
                                     std::uint32_t end) const {
  Box box;
  for (std::uint32_t k = begin; k < end; ++k) {
    const Item& item = sorted_[k];
    box.x.add(set.x[item.source] + item.dx), box.y.add(set.y[item.source] + item.dy);
  }
  return box;
}

void ColumnCells::make_groups(const ParticleSet& set, const std::vector<double>& support_radius) {
  groups_.clear();
  runs_.clear();
  std::uint32_t begin = 0;
  const auto n = static_cast<std::uint32_t>(sorted_.size());
  while (begin < n) {
    const std::uint32_t row = sorted_[begin].cell / static_cast<std::uint32_t>(frame_.n_cols);
    const std::uint32_t row_end =
        cell_begin_[(row + 1) * static_cast<std::uint32_t>(frame_.n_cols)];
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
    add_runs(box, longest, runs_);
    groups_.push_back({begin, end, first_run, static_cast<std::uint32_t>(runs_.size())});
    begin = end;
  }
}

void ColumnCells::list_across(const ColumnCells& others, const ParticleSet& other_set,
                              const std::vector<double>& other_support_radius,
                              std::vector<ColumnGroup>& groups,
                              std::vector<ColumnRun>& runs) const {
  groups.clear();
  runs.clear();
  for (const ColumnGroup& group : others.groups_) {
    double longest = 0;
    for (std::uint32_t k = group.begin; k < group.end; ++k)
      longest = std::max(longest, other_support_radius[others.source_[k]]);
    const auto first_run = static_cast<std::uint32_t>(runs.size());
    add_runs(others.box_of(other_set, group.begin, group.end), longest, runs);
    groups.push_back({group.begin, group.end, first_run, static_cast<std::uint32_t>(runs.size())});
  }
}

/// In each row what lies within `support_radius` of the box, no farther along than the row's
/// distance leaves.
void ColumnCells::add_runs(const Box& box, double support_radius,
                           std::vector<ColumnRun>& runs) const {
  for (std::int32_t row = row_of(box.y.min - support_radius);
       row <= row_of(box.y.max + support_radius); ++row) {
    const double south = frame_.south + row * frame_.height, north = south + frame_.height;
    // A hair wider than the circle: cells are found with rounding.
    const double off =
        std::max({0.0, box.y.min - north, south - box.y.max}) - 1e-9 * support_radius;
    const double along = off > 0
                             ? std::sqrt(std::max(0.0, support_radius * support_radius - off * off))
                             : support_radius;
    const std::uint32_t* cells = cell_begin_.data() + std::ptrdiff_t{row} * frame_.n_cols;
    const std::uint32_t begin = cells[col_of(box.x.min - along)];
    const std::uint32_t end = cells[col_of(box.x.max + along) + 1];
    if (begin < end) runs.push_back({begin, end});
  }
}

ColumnView ColumnCells::view() const {
  return {records_.data(), groups_.data(), runs_.data(), frame_.unit};
}

std::size_t ColumnCells::bytes() const {
  return (items_.capacity() + sorted_.capacity()) * sizeof(Item) +
         (source_.capacity() + cell_begin_.capacity() + next_.capacity()) * sizeof(std::uint32_t) +
         is_image_.capacity() + records_.capacity() * sizeof(ColumnRecord) +
         groups_.capacity() * sizeof(ColumnGroup) + runs_.capacity() * sizeof(ColumnRun);
}

}  // namespace sturz
