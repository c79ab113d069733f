// SPDX-License-Identifier: Apache-2.0
/// Excess pressure inside the columns of a WetBlock, at nodes from the bed up. It takes the place
/// of the parabola: pressure at the base, and the water that is squeezed out, come from the nodes.
#pragma once

#include "engine/effects/columns/wet_block.hpp"
#include "engine/effects/fields.hpp"
#include "engine/laws/consolidation.hpp"

#include <cstddef>

namespace sturz {

struct WetProfile {
  using Row = WetBlock::Row;
  static constexpr int most_nodes = fields::most_pressure_nodes;

  ProfileMesh mesh;
  alignas(64) Row excess[most_nodes];  ///< by node [Pa]

  explicit WetProfile(const ProfileSettings& settings)
      : mesh{settings.nodes, settings.drained_bed} {}

  /// What the weight did to the pressure while no water could move; the block's own `load` went
  /// before. Under a column the whole load is taken up: (rho - rho_f) d(g_n h).
  void load(WetBlock&, const MixtureSettings&);
  /// Over the next part: pressure at the base, and thickness that is squeezed out.
  void look_ahead(WetBlock&, const MixtureLaw&);
  /// Takes over what was looked ahead to, within the bounds of every node.
  void settle(WetBlock&, const MixtureLaw&);
  void copy(std::size_t to, const WetProfile& from, std::size_t i) {
    for (int j = 0; j < mesh.nodes; ++j) excess[j][to] = from.excess[j][i];
  }
  /// Share of the volume that the pressure at the base stands for.
  double base_share() const { return mesh.drained_bed ? 0 : mesh.weight(0); }

 private:
  Row ahead_[most_nodes];  // at the end of the part

  // Columns are taken eight at a time, so that all nodes of a step stay close to the processor.
  static constexpr std::size_t width = 8;
  using Lane = double[width];
  struct Lanes {
    Lane m, permeability, per_thickness, room, speed, time;
  };
  Lanes lanes_of(const WetBlock&, std::size_t first) const;
  void step(const MixtureLaw&, const Lanes&, double part, const Lane* from, Lane* to) const;
};

}  // namespace sturz
