// SPDX-License-Identifier: Apache-2.0
/// Places where grains and liquid meet: nodes of a lattice in the map over which each column
/// spreads its mass and momentum with the weights of a quadratic B-spline, and from which it takes
/// what the node's drag does, with the same weights.
///
/// Weights of a column add up to one, so a node's impulse goes back to the columns that made its
/// momentum: the sum over both sets stays to round-off, and the kinetic energy of an impulse that
/// takes energy at each node never grows (the mean of shares is at most as fast as they are).
/// Averages of both phases are taken with the same weights: where both have one velocity field
/// there is no slip, however curved it is. Impulses from column to column smooth such a field in
/// every step instead (docs/physics.md I8).
#pragma once

#include "engine/core/domain.hpp"
#include "engine/core/vec.hpp"
#include "engine/particles/particle_set.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sturz {

/// What one column brings to its nodes, and the sums there, each but the mass times mass.
struct NodeSums {
  /// Mass [kg], velocity at the start and without drag at the end of the step [m/s], and of grains
  /// what the bed could hold more [m/s], of liquid G h [m2/s2].
  Eigen::Array<double, 8, 1> values = Eigen::Array<double, 8, 1>::Zero();

  double mass() const { return values[0]; }
  Vec3 before() const { return {values[1], values[2], values[3]}; }
  Vec3 after() const { return {values[4], values[5], values[6]}; }
  double other() const { return values[7]; }
};

class DragNodes {
 public:
  /// Forgets all nodes and makes room for those around two sets. \param distance  of nodes [m]; in
  /// a periodic direction as near to it as whole numbers of nodes let it
  void clear(const ParticleSet&, const ParticleSet&, const Domain&, double distance);
  /// Adds a column of a set at (x, y) as the next of its set. \param column  mass and what goes
  /// with it, not yet times mass
  void add(std::size_t set, double x, double y, const NodeSums& column);

  std::size_t size() const { return sums_[0].size(); }
  const NodeSums& sums(std::size_t set, std::size_t node) const { return sums_[set][node]; }
  /// Change of velocity at a node, x y z and nothing [m/s]; to be set before `change_of`.
  std::array<std::vector<Eigen::Array<double, 4, 1>>, 2> change;
  /// What the n-th column added of a set takes from its nodes [m/s].
  Vec3 change_of(std::size_t set, std::size_t n) const;

  std::size_t bytes() const;
  static std::size_t bytes_per_column() { return sizeof(Seat) * 2 + 4 * sizeof(NodeSums); }

 private:
  /// Along one direction: the nodes, and those that are the same by a period.
  struct Axis {
    double distance = 1, origin = 0;
    std::int64_t first = 0, n = 1;
    bool periodic = false;
    std::int64_t at(std::int64_t index) const {
      if (!periodic) return index - first;
      while (index < 0) index += n;
      while (index >= n) index -= n;
      return index;
    }
  };
  /// A column on its nodes: three by three, rows from the south.
  struct Seat {
    std::array<std::uint32_t, 9> node;
    std::array<double, 3> across, up;
  };
  static constexpr std::int64_t edge = 8;  ///< nodes of a tile, per direction
  static Axis axis_of(const Period&, double low, double high, double distance);
  std::uint32_t node_at(std::int64_t col, std::int64_t row);

  Axis x_, y_;
  std::int64_t tile_cols_ = 1;
  std::vector<std::int32_t> tiles_;  ///< number of each tile, -1 where there is none
  std::array<std::vector<NodeSums>, 2> sums_;
  std::array<std::vector<Seat>, 2> seats_;
};

}  // namespace sturz
