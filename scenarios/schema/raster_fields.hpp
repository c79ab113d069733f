// SPDX-License-Identifier: Apache-2.0
/// The numbers of `basal` that a raster may give, and how they are told apart.
#pragma once

#include "engine/effects/bed_rasters.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <array>
#include <string>

namespace sturz {

struct RasterField {
  BedNumber number;
  const char* name;  ///< of the key in `basal` whose units and range the values share
  BasalRaster BasalRasters::*raster;
  std::optional<Uncertain> BasalZone::*zone;  ///< which a zone may give itself
};
inline constexpr std::array<RasterField, n_bed_numbers> raster_fields = {
    {{BedNumber::friction, "friction_coefficient", &BasalRasters::friction_coefficient,
      &BasalZone::friction_coefficient},
     {BedNumber::pore_pressure, "pore_pressure_ratio", &BasalRasters::pore_pressure_ratio,
      &BasalZone::pore_pressure_ratio},
     {BedNumber::cohesion, "cohesion_pa", &BasalRasters::cohesion_pa, &BasalZone::cohesion_pa},
     {BedNumber::turbulence, "turbulent_coefficient_m_s2",
      &BasalRasters::turbulent_coefficient_m_s2, &BasalZone::turbulent_coefficient_m_s2}}};

/// "basal.rasters.friction_coefficient"
inline std::string raster_path(const RasterField& field) {
  return std::string("basal.rasters.") + field.name;
}
/// The row whose range and units its values share.
inline const KeyInfo& basal_key(const RasterField& field) {
  return *find_key(std::string("basal.") + field.name);
}
inline const BasalRaster& raster_of(const BasalSpec& basal, const RasterField& field) {
  return basal.rasters.*field.raster;
}
inline bool names_raster(const BasalSpec& basal, const RasterField& field) {
  return !raster_of(basal, field).path.empty();
}
inline bool names_any_raster(const BasalSpec& basal) {
  for (const RasterField& field : raster_fields)
    if (names_raster(basal, field)) return true;
  return false;
}

}  // namespace sturz
