// SPDX-License-Identifier: Apache-2.0
/// How deep the flow is where a particle is, from the particles alone.
#pragma once

#include "engine/core/domain.hpp"
#include "engine/effects/moving_set.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// The volume of the particles is dealt out to the nodes of a grid of two spacings on the map,
/// bilinearly, and read back the same way: a layer on a lattice of one spacing gives the same depth
/// wherever its particles lie in the grid, and a margin is blurred by two spacings. Only nodes with
/// something on them are kept, in a hash table. Work and memory are of the order of the particles;
/// one thread adds, in storage order.
class FlowDepth {
 public:
  /// \param spacing  of the particles [m] \param near  beside the ground a particle is within [m]
  FlowDepth(double spacing, double near) : spacing_(spacing), near_(near) {}

  /// To be called when particles have been sorted anew; in between they move a fraction of a
  /// spacing. Liquid among grains fills more than its own volume (fields::grain_share).
  /// \param density  own volume is mass over it [kg/m^3]
  void measure(const Domain&, const MovingSet&, double density);
  /// Volume over map area: vertical, of all particles [m]
  double depth(std::size_t i) const { return depth_[i]; }
  /// The same of those beside the ground, at most depth(i) [m]
  double beside_ground(std::size_t i) const { return beside_[i]; }
  std::size_t bytes() const;

 private:
  struct Node {
    std::uint64_t key = 0;  ///< 0: free
    double volume = 0, beside = 0;
  };
  struct Corner {
    std::uint64_t key;
    double weight;
  };
  void lay_grid(const Domain&, const MovingSet&);
  void corners_of(const MovingSet&, std::size_t i, Corner out[4]) const;
  Node& find(std::uint64_t key);

  double spacing_, near_;
  double pitch_x_ = 1, pitch_y_ = 1, west_ = 0, south_ = 0;
  std::int64_t columns_ = 0, rows_ = 0;  ///< of a period; 0: it does not repeat
  std::vector<Node> nodes_;
  std::vector<double> depth_, beside_;
};

}  // namespace sturz
