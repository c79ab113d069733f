// SPDX-License-Identifier: Apache-2.0
/// Sorting particles into columns and listing, per group of 16, the neighbours they share.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"
#include "engine/neighbors/neighbor_records.hpp"
#include "engine/particles/particle_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// Finds those of the candidates that are near a group; see Sweeps::tight_list.
using TightList = std::size_t (*)(const NeighborRecord*, std::size_t first, int n_in_group,
                                  const std::uint32_t* candidates, std::size_t n_candidates,
                                  float radius_units, std::uint32_t* out);

/// An image: record `source` mirrored in up to two walls, then moved by a whole period.
struct RecordImage {
  std::uint32_t source = 0;
  double dx = 0, dy = 0, dz = 0;                ///< [m]
  const Wall* mirrors[2] = {nullptr, nullptr};  ///< of NeighborLists; null: none
  float share = 1;  ///< of the volume of its source, see NeighborLists::weigh_images [-]
};

/// Reusable neighbour lists with a skin: valid while no two particles moved more than `skin`
/// relative to each other since the last build.
class NeighborLists {
 public:
  /// \param support 2h [m]; \param skin extra radius [m]
  NeighborLists(double support, double skin, TightList tight);

  bool needs_rebuild() const { return stale_ || moved_ >= skin_; }
  void invalidate() { stale_ = true; }
  /// Tells that relative positions may have changed by up to `distance` [m].
  void add_relative_motion(double distance) { moved_ += distance; }

  /// Wraps periodic positions, sorts the set into column order (permuting it), makes images and
  /// lists. `records()` then has the right size, with positions filled.
  void rebuild(ParticleSet& set, const Domain& domain, int threads) {
    rebuild(set, domain, threads, set.size());
  }
  /// The same for the first `n_listed` particles; the others keep their positions behind them.
  void rebuild(ParticleSet&, const Domain&, int threads, std::size_t n_listed);
  /// Calls visit(record, r^2 [m^2]) for every listed particle or image within the support of a
  /// point, in a fixed order. An image's record stands for its source.
  template <class Visit>
  void for_each_near(double x, double y, double z, Visit&& visit) const;
  /// Mirrors records in those of the walls that stand at a time, from the next rebuild on: a
  /// particle's neighbours beyond a wall are the images of those before it, and of itself. Lists
  /// are out of date where other walls stand than before.
  void mirror_in(const std::vector<Wall>& walls, double time);
  bool mirrors() const { return !walls_.empty(); }
  /// Lets an image in a wall act as far as its source has neighbours along the wall's normal: n.M.n
  /// over 0.25 of those before the wall, at most 1. A particle by itself has no pressure field to
  /// be mirrored, and would bounce off its own image without loss. To be called after a rebuild.
  /// \param moment_factor  C dx^3 of the moment matrix M = Sum C dx^3 t^3 r (x) r [1/m^2]
  void weigh_images(double moment_factor);
  /// Turns a vector of an image's source as the walls of the image do.
  void turn(std::size_t image, float& x, float& y, float& z) const;
  /// Calls visit(record, source record) for every image.
  template <class Visit>
  void for_each_image(Visit&& visit) const {
    for (std::size_t k = 0; k < images_.size(); ++k) visit(padded_size() + k, images_[k].source);
  }
  /// Writes positions (fixed point) of all records; the caller fills the other values of records
  /// 0..n-1 and then calls copy_images().
  void gather_positions(const ParticleSet&, std::size_t begin, std::size_t end);
  void copy_images();

  NeighborRecord* records() { return records_.data(); }
  std::size_t n_groups() const { return n_groups_; }
  std::size_t padded_size() const { return n_groups_ * group_size; }
  /// Particles, padding and images, in whole groups.
  std::size_t n_records_rounded() const {
    return (records_.size() + group_size - 1) / group_size * group_size;
  }
  NeighborView view() const;
  /// Entries of all lists: the work of one sweep is 16 times as many pairs.
  std::size_t n_entries() const;
  std::size_t n_rebuilds() const { return n_rebuilds_; }
  std::size_t bytes() const;

 private:
  void rest();
  void choose_frame(const ParticleSet&, const Domain&);
  void make_images(const ParticleSet&, const Domain&);
  void mirror(RecordImage, const Vec3& at);
  void mirror_record(const Wall&, NeighborRecord&) const;
  double moment_along(const RecordImage&, const Vec3& normal, double enough) const;
  void sort_particles(ParticleSet&);
  void sort_records();
  void build_lists(int threads);
  std::size_t collect(std::size_t group, std::vector<std::uint32_t>& candidates,
                      std::vector<std::uint32_t>& out) const;
  std::uint32_t column_of(double x, double y) const;

  double support_, skin_;
  TightList tight_;
  bool stale_ = true;
  double moved_ = 0;
  std::size_t n_rebuilds_ = 0;

  double origin_[3] = {0, 0, 0};             // of the fixed-point frame [m]
  double unit_ = 1;                          // metres per position unit
  double west_ = 0, south_ = 0, width_ = 1;  // column grid
  std::uint32_t n_cols_ = 1, n_rows_ = 1;

  std::size_t n_particles_ = 0, n_groups_ = 0;
  std::vector<Wall> walls_;  // that mirror
  std::vector<RecordImage> images_;
  std::vector<NeighborRecord> records_;  // particles, padding to whole groups, images
  std::vector<std::uint64_t> keys_;      // column and height of what is being sorted
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> sorted_;  // record numbers in column order
  std::vector<std::uint32_t> column_begin_;
  std::vector<std::uint32_t> list_end_;  // see NeighborView
  std::vector<std::vector<std::uint32_t>> block_lists_;
  std::vector<const std::uint32_t*> blocks_;
};

template <class Visit>
void NeighborLists::for_each_near(double x, double y, double z, Visit&& visit) const {
  if (n_particles_ == 0) return;
  const auto index = [&](double v, double edge, std::uint32_t count) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((v - edge) / width_)), -1,
                                    count);
  };
  const auto last = [](std::int64_t i, std::uint32_t count) {
    return std::min<std::int64_t>(i, count - 1);
  };
  const auto row0 = std::max<std::int64_t>(0, index(y - support_, south_, n_rows_));
  const auto row1 = last(index(y + support_, south_, n_rows_), n_rows_);
  const auto col0 = std::max<std::int64_t>(0, index(x - support_, west_, n_cols_));
  const auto col1 = last(index(x + support_, west_, n_cols_), n_cols_);
  for (auto row = row0; row <= row1; ++row)
    for (auto col = col0; col <= col1; ++col) {
      const auto column =
          static_cast<std::size_t>(row * n_cols_ + (row % 2 ? n_cols_ - 1 - col : col));
      for (auto k = column_begin_[column]; k < column_begin_[column + 1]; ++k) {
        const NeighborRecord& r = records_[sorted_[k]];
        const double dx = origin_[0] + r.x * unit_ - x, dy = origin_[1] + r.y * unit_ - y;
        const double dz = origin_[2] + r.z * unit_ - z, r2 = dx * dx + dy * dy + dz * dz;
        if (r2 < support_ * support_) visit(std::size_t{sorted_[k]}, r2);
      }
    }
}

}  // namespace sturz
