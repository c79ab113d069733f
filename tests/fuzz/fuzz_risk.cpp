// SPDX-License-Identifier: Apache-2.0
// Any bytes as a risk file and as vulnerability curves: data or SetupError; what was accepted has
// rising periods and frequencies above 0, and curves that rise and give a damage everywhere.
#include "engine/core/error.hpp"
#include "io/risk/risk_file.hpp"
#include "io/site/assets/asset_files.hpp"

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool good) {
  if (!good) std::abort();
}

void check(const sturz::RiskSpec& spec) {
  require(!spec.scenarios.empty() && !spec.return_periods_years.empty());
  require(spec.probability_classes_years.size() == 3);
  require(spec.strong_thickness_m > 0 && spec.strong_speed_m_s > 0);
  for (const sturz::RiskScenario& s : spec.scenarios)
    require(!s.folder.empty() && s.frequency_per_year > 0 && s.frequency_per_year <= 100);
  double last = 0;
  for (const double period : spec.return_periods_years) {
    require(period > last);
    last = period;
  }
}

void check(const sturz::DamageCurve& curve) {
  require(!curve.points.empty());
  double last = 0;
  for (const double x : {0.0, 1e-9, 1.0, 1e3, 1e6, 1e12}) {
    const double damage = sturz::damage_at(curve, x);
    require(damage >= last && damage <= 1);
    last = damage;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    check(sturz::parse_risk(text, "fuzz.yaml"));
  } catch (const sturz::SetupError&) {
    // an answer, too
  }
  try {
    for (const sturz::DamageCurve& curve : sturz::parse_damage_curves(text, "fuzz.yaml"))
      check(curve);
  } catch (const sturz::SetupError&) {
    return 0;
  }
  return 0;
}
