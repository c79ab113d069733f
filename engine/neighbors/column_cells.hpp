// SPDX-License-Identifier: Apache-2.0
/// Columns sorted into plan-view cells, so that those near a group lie in a few contiguous runs.
///
/// Rebuilt every step by counting: a depth-averaged step is long, and a list with a skin would be
/// worn out after a step or two. Nothing is stored per pair.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/neighbors/column_records.hpp"
#include "engine/particles/particle_set.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

class ColumnCells {
 public:
  /// Sorts the columns and their periodic images by cell and fills the records' positions; within
  /// a cell they keep their storage order. Positions must lie inside the domain's periods.
  /// \param support_radius  of each column [m], [n]; its largest bounds what images
  /// exist
  void build(const ParticleSet&, const Domain&, const std::vector<double>& support_radius);

  /// Records and images, in order of their cells.
  std::size_t size() const { return source_.size(); }
  std::size_t n_groups() const { return groups_.size(); }
  /// The column that record k is, or is an image of.
  std::uint32_t source(std::size_t k) const { return source_[k]; }
  bool is_image(std::size_t k) const { return is_image_[k]; }
  ColumnRecord* records() { return records_.data(); }
  ColumnView view() const;
  std::size_t bytes() const;

 private:
  struct Item {
    std::uint32_t source, cell;
    double dx, dy, dz;  ///< of a periodic image [m]
  };
  void choose_frame(const ParticleSet&, double longest, double mean);
  void collect(const ParticleSet&, const Domain&, double support_radius);
  void sort_items();
  void place(const ParticleSet&);
  void make_groups(const ParticleSet&, const std::vector<double>& support_radius);
  struct Box;
  void add_runs(const Box&, double support_radius);
  std::int32_t col_of(double x) const;
  std::int32_t row_of(double y) const;

  double width_ = 1, height_ = 1, west_ = 0, south_ = 0, origin_z_ = 0, unit_ = 1;
  std::int32_t n_cols_ = 1, n_rows_ = 1;
  std::vector<Item> items_, sorted_;
  std::vector<std::uint32_t> source_, cell_begin_, next_;
  std::vector<std::uint8_t> is_image_;
  std::vector<ColumnRecord> records_;
  std::vector<ColumnGroup> groups_;
  std::vector<ColumnRun> runs_;
};

}  // namespace sturz
