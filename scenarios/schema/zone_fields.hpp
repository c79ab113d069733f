// SPDX-License-Identifier: Apache-2.0
/// The numbers that a zone of the bed may give in the place of basal's own.
#pragma once

#include "scenarios/schema/schema.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// A raster of zones holds one byte per cell, and 0 means none.
inline constexpr std::size_t most_basal_zones = 255;

/// One of these numbers; its units and range are those of the key of the same name in basal.
struct ZoneField {
  const char* name;
  std::optional<Uncertain> BasalZone::*value;
};
inline constexpr std::array<ZoneField, 4> zone_fields = {
    {{"friction_coefficient", &BasalZone::friction_coefficient},
     {"pore_pressure_ratio", &BasalZone::pore_pressure_ratio},
     {"cohesion_pa", &BasalZone::cohesion_pa},
     {"turbulent_coefficient_m_s2", &BasalZone::turbulent_coefficient_m_s2}}};

/// nullptr for any other name.
inline const ZoneField* find_zone_field(const std::string& name) {
  for (const auto& field : zone_fields)
    if (field.name == name) return &field;
  return nullptr;
}
/// In the order of the table.
inline std::vector<std::string> zone_field_names() {
  std::vector<std::string> names;
  names.reserve(zone_fields.size());
  for (const auto& field : zone_fields) names.emplace_back(field.name);
  return names;
}
/// The row whose range and units the field shares.
inline const KeyInfo& basal_key(const ZoneField& field) {
  return *find_key(std::string("basal.") + field.name);
}
/// "basal.zones[2].friction_coefficient"
inline std::string zone_path(std::size_t zone, const ZoneField& field) {
  return "basal.zones[" + std::to_string(zone) + "]." + field.name;
}
/// The same row under the zone's own path, for reading and checking.
inline KeyInfo zone_key(std::size_t zone, const ZoneField& field) {
  KeyInfo key = basal_key(field);
  key.path = zone_path(zone, field);
  return key;
}

}  // namespace sturz
