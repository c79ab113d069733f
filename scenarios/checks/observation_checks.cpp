// SPDX-License-Identifier: Apache-2.0
// What was observed says how well it is known, and is only compared with what is like it.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/number_text.hpp"

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

/// Collects problems of keys of the block.
struct Check {
  Problems& problems;
  void add(const std::string& name, const std::string& rest) const {
    problems.push_back({"observation." + name, "observation." + name + " " + rest});
  }
  /// A quantity and its standard deviation need each other.
  void pair(bool has_quantity, const std::string& quantity, bool has_sd,
            const std::string& sd) const {
    if (has_quantity && !has_sd)
      add(quantity, "(without a standard deviation it cannot be weighed). Add " + sd + ".");
    if (has_sd && !has_quantity)
      add(sd, "(there is no " + quantity + " that it could belong to). Remove it.");
  }
  void pair(const std::optional<MeasuredSpec>& m, const std::string& name) const {
    if (!m) return;
    if (m->value && !m->sd)
      add(name, "(without a standard deviation it cannot be weighed). Add sd.");
    if (!m->value) add(name, "(value is missing). Add it.");
  }
  void companion(bool given, const std::string& name, bool has_owner,
                 const std::string& owner) const {
    if (given && !has_owner)
      add(name, "(there is no " + owner + "). Remove it or add " + owner + ".");
  }
};

void check_thickness(const Scenario& s, const Check& check) {
  const ObservationSpec& o = *s.observation;
  const bool raster = !o.deposit_thickness.empty();
  const bool difference = o.thickness_sign != ThicknessSign::thickness;
  check.pair(raster, "deposit_thickness", o.thickness_sd_m.has_value(), "thickness_sd_m");
  check.companion(difference, "thickness_sign", raster, "deposit_thickness");
  check.companion(!o.mask_erosion, "mask_erosion", raster, "deposit_thickness");
  if (!raster || o.mask_erosion) return;
  if (!difference)
    check.add("mask_erosion",
              "= false (deposit_thickness holds thicknesses: nothing in it can be below zero). "
              "Remove it, or say with thickness_sign which way an elevation difference counts.");
  else if (!s.erosion)
    check.add("mask_erosion",
              "= false (the scene has no erosion, so no member lowers the ground: cells where it "
              "fell would count against all of them). Remove it, or add erosion.");
}

void check_fronts(const ObservationSpec& o, const Check& check) {
  for (std::size_t i = 0; i < o.fronts.size(); ++i) {
    const NumberRecord& front = o.fronts[i];
    const auto refuse = [&](const std::string& rest) {
      check.problems.push_back(
          {"observation.fronts", "observation.fronts[" + std::to_string(i) + "] " + rest});
    };
    if (front.contains("distance_m") == front.contains("point_m"))
      refuse("(must say where the front was, once). Give one of distance_m, point_m.");
    if (front.contains("sd_m") == front.contains("sd_s"))
      refuse(
          "(must say how well that is known, once). Give sd_m to compare places at the time, "
          "or sd_s to compare times at the place.");
  }
}

/// A travel angle of 63 degrees: no ground that a slide runs out on is steeper.
constexpr double steepest_travel = 2;

void check_ratio(const ObservationSpec& o, const Check& check) {
  if (!o.h_over_l || !o.h_over_l->value || !(*o.h_over_l->value > steepest_travel)) return;
  const double value = *o.h_over_l->value;
  std::string rest = "= " + number_text(value) +
                     " (fall over length is the tangent of the travel angle: above 2 that is "
                     "steeper than 63 degrees).";
  if (value <= 90)
    rest += " If it is the angle in degrees, its tangent is " +
            short_number(std::tan(value * std::numbers::pi / 180)) + ".";
  check.add("h_over_l.value", rest);
}

bool has_file(const ObservationSpec& o) {
  return !o.outline.empty() || !o.deposit.empty() || !o.deposit_thickness.empty() ||
         !o.farthest_point.empty() || !o.thalweg.empty();
}

bool has_quantity(const ObservationSpec& o) {
  return !o.outline.empty() || !o.deposit.empty() || !o.deposit_thickness.empty() ||
         !o.farthest_point.empty() || o.farthest_point_m || o.runout_m || o.h_over_l ||
         o.com_travel_m || o.volume_m3 || o.area_m2 || !o.fronts.empty() || !o.speeds.empty();
}

}  // namespace

void check_observation(const Scenario& s, Problems& problems) {
  if (!s.observation) return;
  const ObservationSpec& o = *s.observation;
  const Check check{problems};
  if (!has_quantity(o))
    problems.push_back({"observation",
                        "observation (nothing is compared). Add an outline, a deposit, a length "
                        "or another quantity with its standard deviation."});
  check.pair(!o.outline.empty(), "outline", o.outline_sd_m.has_value(), "outline_sd_m");
  check.pair(!o.deposit.empty(), "deposit", o.deposit_sd_m.has_value(), "deposit_sd_m");
  check.companion(!o.outline_layer.empty(), "outline_layer", !o.outline.empty(), "outline");
  check.companion(!o.deposit_layer.empty(), "deposit_layer", !o.deposit.empty(), "deposit");
  check_thickness(s, check);
  const bool layer = !o.farthest_point.empty(), inline_point = o.farthest_point_m.has_value();
  if (layer && inline_point)
    check.add("farthest_point_m", "(farthest_point names the point too). Keep one of them.");
  check.pair(layer || inline_point, inline_point && !layer ? "farthest_point_m" : "farthest_point",
             o.farthest_point_sd_m.has_value(), "farthest_point_sd_m");
  check.pair(o.runout_m, "runout_m");
  check.pair(o.h_over_l, "h_over_l");
  check_ratio(o, check);
  check.pair(o.com_travel_m, "com_travel_m");
  check.pair(o.volume_m3, "volume_m3");
  check.pair(o.area_m2, "area_m2");
  check_fronts(o, check);
  check.companion(!o.crs.empty(), "crs", has_file(o), "file");
}

}  // namespace sturz
