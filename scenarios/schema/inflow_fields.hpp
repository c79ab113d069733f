// SPDX-License-Identifier: Apache-2.0
/// The numbers that an inflow may give.
#pragma once

#include "scenarios/schema/schema.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

inline constexpr std::size_t most_inflows = 100;
/// Corners of one inline line.
inline constexpr std::size_t most_corners = 10000;

struct InflowField {
  const char* name;
  std::optional<Uncertain> InflowSpec::*value;
  const char* units;
  double min, max;
  bool above_min;
};
inline constexpr std::array<InflowField, 4> inflow_fields = {
    {{"discharge_factor", &InflowSpec::discharge_factor, "1", 0, 1000, true},
     {"start_time_s", &InflowSpec::start_time_s, "s", 0, 1e5, false},
     {"speed_m_s", &InflowSpec::speed_m_s, "m s-1", 0, 100, false},
     {"direction_deg", &InflowSpec::direction_deg, "degree", -360, 360, false}}};

/// nullptr for any other name.
inline const InflowField* find_inflow_field(const std::string& name) {
  for (const auto& field : inflow_fields)
    if (field.name == name) return &field;
  return nullptr;
}
/// "inflow[2].discharge_factor"
inline std::string inflow_path(std::size_t source, const InflowField& field) {
  return "inflow[" + std::to_string(source) + "]." + field.name;
}
/// The row of such a path, for reading and checking.
inline KeyInfo inflow_key(std::size_t source, const InflowField& field) {
  KeyInfo key;
  key.path = inflow_path(source, field);
  key.kind = ValueKind::uncertain;
  key.units = field.units;
  key.min = field.min;
  key.max = field.max;
  key.above_min = field.above_min;
  return key;
}

}  // namespace sturz
