// SPDX-License-Identifier: Apache-2.0
/// Which isolated particles come near each other: by a grid, made anew once a particle has moved
/// enough.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"

#include <cstdint>
#include <vector>

namespace sturz {

/// An isolated particle as a contact sees it.
struct IsolatedSphere {
  Vec3 position{0, 0, 0};  ///< [m]
  Vec3 velocity{0, 0, 0};  ///< [m/s]
  double radius = 0;       ///< [m]
  std::uint32_t id = 0;    ///< of the particle
};

/// Two spheres by their index in the list; a has the smaller id.
struct NearPair {
  std::uint32_t a = 0, b = 0;
  Vec3 image{0, 0, 0};  ///< to add to b's position: periods between them [m]
};

class IsolatedSearch {
 public:
  /// All pairs whose surfaces are closer than `max_gap` > 0 [m], in the order of their ids, so that
  /// sums over them have the same order whatever the storage. In periodic directions the boxes must
  /// be longer than twice (three largest radii plus `max_gap`).
  const std::vector<NearPair>& find(const std::vector<IsolatedSphere>&, double max_gap,
                                    const Domain&);

  std::size_t n_grids() const { return n_grids_; }  ///< made so far
  std::size_t bytes() const;

 private:
  struct Entry {
    std::uint64_t cell = 0;
    std::uint32_t sphere = 0;
    bool own = true;  // false: an image beyond the box
    Vec3 position{0, 0, 0};
  };

  bool still_good(const std::vector<IsolatedSphere>&, double max_gap) const;
  void search(const std::vector<IsolatedSphere>&, double max_gap, const Domain&);
  void enter(const std::vector<IsolatedSphere>&, const Domain&, double margin);
  void add_images(const Period&, int axis, double margin);
  std::uint64_t cell_of(const Vec3& position, int dx, int dy, int dz) const;

  Vec3 origin_{0, 0, 0};
  double cell_ = 1;
  std::vector<Entry> entries_;
  std::vector<IsolatedSphere> searched_;  // as they were
  double searched_gap_ = 0;
  std::size_t n_grids_ = 0;
  std::vector<NearPair> within_;  // searched_gap_ of each other then
  std::vector<NearPair> pairs_;
};

/// Sets of particles that are linked by pairs, to step them together or not at all.
class IsolatedGroups {
 public:
  void start(std::size_t n);
  void join(std::uint32_t a, std::uint32_t b);
  void want(std::uint32_t a) { wanted_[root(a)] = 1; }
  bool wanted(std::uint32_t a) { return wanted_[root(a)] != 0; }

 private:
  std::uint32_t root(std::uint32_t a);
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> wanted_;
};

/// Whether two spheres on straight paths touch within dt, or do already.
/// \param image  to add to b's position [m]
bool may_touch(const IsolatedSphere& a, const IsolatedSphere& b, const Vec3& image, double dt);

}  // namespace sturz
