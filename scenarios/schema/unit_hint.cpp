// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/unit_hint.hpp"

#include "scenarios/schema/number_text.hpp"

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

std::string tangent_hint(double degrees) {
  const double tangent = std::tan(degrees * std::numbers::pi / 180);
  return "Was it an angle in degrees? tan " + number_text(degrees) +
         " deg = " + number_text(std::round(tangent * 1000) / 1000) + ".";
}

}  // namespace

std::string unit_hint(const KeyInfo& key, double value) {
  if (std::isnan(value)) return {};
  const bool friction = key.path.find("friction") != std::string::npos && key.units == "1";
  if (friction && value > 2 && value < 85) return tangent_hint(value);
  if (value < key.min && value < 0) return {};
  if (key.units == "1" && key.kind != ValueKind::integer && key.max <= 1 && value > 1 &&
      value <= 100)
    return "Was it a percentage? " + number_text(value) + " % = " + number_text(value / 100) + ".";
  if (key.units == "kg m-3" && value > 0 && value < 20)
    return "Was it in g/cm3? " + number_text(value) +
           " g/cm3 = " + number_text(std::round(value * 1000)) + " kg/m3.";
  if (key.units.empty() || key.units == "1") return {};
  return "Was it in another unit?";
}

}  // namespace sturz
