// SPDX-License-Identifier: Apache-2.0
/// Neighbours in another particle set: grains near a liquid particle, coarse grains near fine ones.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"
#include "engine/particles/particle_set.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

/// Lists, per particle of set `from`, the particles of set `to` and their periodic images within a
/// support radius. Lists hold a skin more than that and stay valid until particles of the two sets
/// have moved by more than the skin relative to each other, or either set was reordered.
///
/// A pair is found once from each side: `from` and `to` the other way round see the same pairs.
class CrossLists {
 public:
  /// \param support [m]; \param skin extra distance [m], >= 0
  CrossLists(double support, double skin);

  bool needs_rebuild() const { return stale_ || moved_ >= skin_; }
  /// One of the sets was reordered, or its particles changed.
  void invalidate() { stale_ = true; }
  /// Tells that relative positions may have changed by up to `distance` [m].
  void add_relative_motion(double distance) { moved_ += distance; }

  /// Positions of both sets must lie in the periodic box (motion/wrapping.hpp).
  void rebuild(const ParticleSet& from, const ParticleSet& to, const Domain&, int threads);

  /// Calls visit(j, r) for every particle j of `to` that is within the support of particle i:
  /// r = x_i - x_j [m], with the periods between them. In the order of the ids of `to` within a
  /// cell, so that sums have the same bits whatever the storage order.
  template <class Visit>
  void for_each(std::size_t i, const ParticleSet& from, const ParticleSet& to, Visit&& visit) const;

  std::size_t n_rebuilds() const { return n_rebuilds_; }
  std::size_t n_entries() const;
  std::size_t bytes() const;

 private:
  /// A particle of `to`, or one of its periodic images.
  struct Source {
    std::uint64_t cell = 0;
    std::uint32_t index = 0, id = 0;
    double dx = 0, dy = 0, dz = 0;  ///< periods to add to its position [m]
  };
  struct Run {
    std::uint32_t begin = 0, end = 0;  ///< in entries_ of the particle's block
  };
  static constexpr std::size_t block =
      1024;  ///< particles of `from` whose entries are kept together

  void enter(const ParticleSet& to, const Domain&);
  void add_images(const ParticleSet& to, const Period&, bool along_x);
  std::uint64_t cell_of(double x, double y, double z, int dx, int dy, int dz) const;
  void list(const ParticleSet& from, const ParticleSet& to, std::size_t i,
            std::vector<std::uint32_t>& out) const;

  double support_, skin_;
  bool stale_ = true;
  double moved_ = 0;
  std::size_t n_rebuilds_ = 0;
  double origin_[3] = {0, 0, 0};                     ///< of the cells [m]
  std::vector<Source> sources_;                      ///< by cell
  std::vector<Run> runs_;                            ///< [from]
  std::vector<std::vector<std::uint32_t>> entries_;  ///< [block] indices into sources_
};

template <class Visit>
void CrossLists::for_each(std::size_t i, const ParticleSet& from, const ParticleSet& to,
                          Visit&& visit) const {
  const std::vector<std::uint32_t>& entries = entries_[i / block];
  for (std::uint32_t k = runs_[i].begin; k < runs_[i].end; ++k) {
    const Source& s = sources_[entries[k]];
    const Vec3 r(from.x[i] - to.x[s.index] - s.dx, from.y[i] - to.y[s.index] - s.dy,
                 from.z[i] - to.z[s.index] - s.dz);
    if (r.squaredNorm() < support_ * support_) visit(std::size_t{s.index}, r);
  }
}

}  // namespace sturz
