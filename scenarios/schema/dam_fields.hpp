// SPDX-License-Identifier: Apache-2.0
/// The numbers that a dam may give.
#pragma once

#include "scenarios/schema/schema.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

inline constexpr std::size_t most_dams = 100;
/// Corners of one inline line.
inline constexpr std::size_t most_dam_corners = 10000;

/// A number of a dam that may be uncertain.
struct DamField {
  const char* name;
  std::optional<Uncertain> DamSpec::*value;
  double min, max;
  bool above_min;
};
inline constexpr std::array<DamField, 2> dam_fields = {
    {{"height_m", &DamSpec::height_m, 0, 200, true},
     {"crest_elevation_m", &DamSpec::crest_elevation_m, -11000, 9000, false}}};

/// One that is fixed.
struct DamNumber {
  const char* name;
  double DamSpec::*value;
  const char* units;
  double min, max;
};
inline constexpr std::array<DamNumber, 2> dam_numbers = {
    {{"crest_width_m", &DamSpec::crest_width_m, "m", 0, 1000},
     {"side_slope", &DamSpec::side_slope, "1", 0, 10}}};

/// A text.
struct DamText {
  const char* name;
  std::string DamSpec::*value;
  bool is_path;
};
inline constexpr std::array<DamText, 3> dam_texts = {
    {{"line", &DamSpec::line, true},
     {"layer", &DamSpec::layer, false},
     {"height_attribute", &DamSpec::height_attribute, false}}};

inline std::vector<std::string> dam_names() {
  std::vector<std::string> names;
  for (const auto& text : dam_texts) names.emplace_back(text.name);
  names.emplace_back("points_m");
  for (const auto& field : dam_fields) names.emplace_back(field.name);
  for (const auto& number : dam_numbers) names.emplace_back(number.name);
  return names;
}
/// "terrain.dams[2]"
inline std::string dam_path(std::size_t dam) { return "terrain.dams[" + std::to_string(dam) + "]"; }
/// "terrain.dams[2].height_m"
inline std::string dam_path(std::size_t dam, const DamField& field) {
  return dam_path(dam) + "." + field.name;
}
/// The row of such a path, for reading and checking.
inline KeyInfo dam_key(std::size_t dam, const DamField& field) {
  KeyInfo key;
  key.path = dam_path(dam, field);
  key.kind = ValueKind::uncertain;
  key.units = "m";
  key.min = field.min, key.max = field.max, key.above_min = field.above_min;
  return key;
}

}  // namespace sturz
