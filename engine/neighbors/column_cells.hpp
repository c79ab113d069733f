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

/// Where cells lie and how fine positions are told apart; sets that share one find each other's
/// columns.
struct ColumnFrame {
  double width = 1, height = 1;   ///< of a cell [m]
  double west = 0, south = 0;     ///< [m]
  double origin_z = 0, unit = 1;  ///< [m]; metres per position unit
  std::int32_t n_cols = 1, n_rows = 1;
};

class ColumnCells {
 public:
  /// Sorts the columns and their periodic images by cell and fills the records' positions; within
  /// a cell they keep their storage order. Positions must lie inside the domain's periods.
  /// \param support_radius  of each column [m], [n]; its largest bounds what images
  /// exist
  void build(const ParticleSet&, const Domain&, const std::vector<double>& support_radius);
  /// The same in a frame that holds the columns of more sets, \see frame_of.
  void build(const ParticleSet&, const Domain&, const std::vector<double>& support_radius,
             const ColumnFrame&);

  /// A frame around the columns of two sets. \param support_radius  of each set's columns [m]
  static ColumnFrame frame_of(const ParticleSet&, const ParticleSet&,
                              const std::vector<double>& support_radius,
                              const std::vector<double>& other_support_radius);
  /// The groups of `others`, which has the same frame, with runs of records of these cells.
  void list_across(const ColumnCells& others, const ParticleSet& other_set,
                   const std::vector<double>& other_support_radius,
                   std::vector<ColumnGroup>& groups, std::vector<ColumnRun>& runs) const;

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
  void collect(const ParticleSet&, const Domain&, double support_radius);
  void sort_items();
  void place(const ParticleSet&);
  void make_groups(const ParticleSet&, const std::vector<double>& support_radius);
  struct Box;
  void add_runs(const Box&, double support_radius, std::vector<ColumnRun>&) const;
  Box box_of(const ParticleSet&, std::uint32_t begin, std::uint32_t end) const;
  std::int32_t col_of(double x) const;
  std::int32_t row_of(double y) const;

  ColumnFrame frame_;
  std::vector<Item> items_, sorted_;
  std::vector<std::uint32_t> source_, cell_begin_, next_;
  std::vector<std::uint8_t> is_image_;
  std::vector<ColumnRecord> records_;
  std::vector<ColumnGroup> groups_;
  std::vector<ColumnRun> runs_;
};

}  // namespace sturz
