// SPDX-License-Identifier: Apache-2.0
/// Pairs of grains that may touch, with what they remember of each other.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/effects/discrete/touch.hpp"
#include "engine/effects/moving_set.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sturz {

struct GrainPair {
  std::uint32_t a = 0, b = 0;  ///< storage indices; the id of a is the smaller
  Vec3 image{0, 0, 0};         ///< to add to b's position [m]
  TouchMemory memory;
};

/// Every pair whose surfaces are nearer than a skin, listed anew when grains have moved by half of
/// that beside the mean of all. In the order of storage, which is that of ids: so the bits of a sum
/// over a grain's pairs do not depend on when lists were made or by how many threads.
class GrainPairs {
 public:
  /// \param skin  [m]
  explicit GrainPairs(double skin) : skin_(skin) {}

  /// Lists anew where that is needed; positions are brought back into the periodic box then.
  /// \param radius  by storage index [m]
  /// \return elastic energy of contacts whose grains have left [J]
  double update(const Domain&, MovingSet&, std::span<const double> radius, int threads);

  std::vector<GrainPair>& pairs() { return pairs_; }
  /// Calls visit(pair, first) for all pairs of grain i; `first` where it is the pair's a.
  template <class Visit>
  void for_each_of(std::size_t i, Visit&& visit) const {
    for (std::uint32_t k = begin_[i]; k < begin_[i + 1]; ++k)
      visit(of_grain_[k] >> 1, (of_grain_[k] & 1) == 0);
  }

  std::size_t n_lists() const { return n_lists_; }
  std::size_t bytes() const;

 private:
  /// A grain or one of its periodic images.
  struct Source {
    Vec3 position{0, 0, 0};
    Vec3 image{0, 0, 0};  ///< that has been added to the grain's position
    std::uint32_t grain = 0;
  };
  struct Found {
    std::uint32_t b = 0;
    Vec3 image{0, 0, 0};
  };
  static constexpr std::size_t block = 1024;  ///< grains whose findings are kept together

  bool still_good(const MovingSet&, int threads) const;
  void enter(const Domain&, const MovingSet&);
  void add_images(const Period&, int axis);
  void sort_into_cells();
  std::uint32_t cell_of(const Vec3&) const;
  void find(const MovingSet&, std::span<const double> radius, int threads);
  void find_near(std::size_t i, std::span<const double> radius, std::vector<Found>& out) const;
  double join(const MovingSet&, std::span<const double> radius);
  void index_grains(std::size_t n);

  double skin_, width_ = 1;
  double west_ = 0, south_ = 0;
  std::uint32_t n_cols_ = 1, n_rows_ = 1;
  bool any_ = false;
  std::size_t n_lists_ = 0;
  std::vector<Vec3> listed_at_;  ///< positions when the lists were made
  std::vector<Source> sources_, sorted_;
  std::vector<std::uint32_t> cell_begin_, cell_;
  std::vector<std::vector<Found>> found_;  ///< by block of grains
  std::vector<std::uint32_t> n_found_;     ///< by grain
  std::vector<GrainPair> pairs_, old_;
  std::vector<std::uint32_t> id_, new_of_id_;  ///< ids of the listed; their index, by id
  std::vector<std::uint32_t> begin_, of_grain_, fill_;
};

}  // namespace sturz
