// SPDX-License-Identifier: Apache-2.0
// Layers of grains and liquid that are told apart.
#include "engine/simulation/peak_maps.hpp"

namespace sturz {
namespace {

struct MaterialLayers {
  PeakLayer thickness, speed, energy, pressure, arrival;
};
/// [set]
constexpr std::array<MaterialLayers, 2> layers_of{{
    {PeakLayer::solid, PeakLayer::solid_speed, PeakLayer::solid_energy, PeakLayer::solid_pressure,
     PeakLayer::solid_arrival},
    {PeakLayer::liquid, PeakLayer::liquid_speed, PeakLayer::liquid_energy,
     PeakLayer::liquid_pressure, PeakLayer::liquid_arrival},
}};

}  // namespace

/// One cell of a tile into place k of the layers.
void PeakMaps::write_materials(const PeakTile& p, std::size_t cell, std::size_t k,
                               MemberResult& result) {
  for (std::size_t set = 0; set < layers_of.size(); ++set) {
    const CellPeaks& own = p.of_set[set];
    const MaterialLayers& to = layers_of[set];
    result.layer(to.thickness)[k] = own.thickness[cell];
    result.layer(to.speed)[k] = own.speed[cell];
    result.layer(to.energy)[k] = own.energy[cell];
    result.layer(to.pressure)[k] = own.pressure[cell];
    if (own.arrival[cell] < CellPeaks::never) result.layer(to.arrival)[k] = own.arrival[cell];
  }
  if (p.arrival[cell] < CellPeaks::never)
    result.layer(PeakLayer::liquid_fraction)[k] = p.liquid_fraction[cell];
}

}  // namespace sturz
