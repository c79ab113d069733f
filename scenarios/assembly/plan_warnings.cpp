// SPDX-License-Identifier: Apache-2.0
// What a reader of the results has to know about the scene that was computed.
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/assembly/release_lip.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/assembly/scene_plan.hpp"
#include "scenarios/assembly/start_checks.hpp"
#include "scenarios/assembly/structures/structure_warnings.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

using Warnings = std::vector<std::string>;

/// Four layers or more on the whole, or a reader has to be told what is not resolved.
void warn_of_thin_flow(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  const FormulationChoice& f = plan.formulation;
  if (f.depth_averaged || f.discrete || f.layers >= resolved_layers) return;
  out.push_back(
      "thin flow: " + short_number(f.layers) + " layers of particles resolve the " +
      (f.release_layers <= f.deposit_layers ? "release" : "expected deposit") +
      " (fewer than 4). The way of the centre of mass may be wrong by 10 %, the footprint by "
      "15-100 %. Use " +
      (s.fluid ? "" : "formulation: auto or ") + "a spacing below " +
      short_number(s.numerics.spacing_m * f.layers / resolved_layers) + " m");
}

/// Two digits, never more than `v`.
std::string rounded_down(double v) {
  const double unit = std::pow(10, std::floor(std::log10(v)) - 1);
  return short_number(std::floor(v / unit + 1e-9) * unit);
}

/// A release of a few particles is a blot of their smoothing, whatever its outline was. Periods
/// repeat it, so that its sides are none.
void warn_of_coarse_spacing(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  const double dx = s.numerics.spacing_m, side = plan.release_narrow_side_m;
  if (!s.domain.periodic.empty() || !(side > 0) || side >= (1 - 1e-9) * resolved_across * dx)
    return;
  out.push_back("unresolved release: " + std::to_string(plan.release.x.size()) +
                (plan.formulation.depth_averaged ? " columns, "
                 : plan.discrete                 ? " grains, "
                                                 : " particles, ") +
                short_number(side / dx) + " spacings of " + short_number(dx) +
                " m across its narrow side of " + short_number(side) + " m" +
                (side < dx ? " (it is narrower than one)" : "") + " and " +
                short_number(plan.release.layers) +
                " spacings thick. With fewer than 10 across, areas are too large by tens of per "
                "cents to several times and thicknesses too small. Use " +
                (plan.discrete ? "smaller grains: grains.discrete.diameter_m"
                               : "a numerics.spacing_m of " + rounded_down(side / resolved_across) +
                                     " m or less"));
}

/// Ground in the way at the lower end of the release. Under a tenth of the drive it is no matter.
void warn_of_lip(const Scenario& s, const SceneInputs& in, const ScenePlan& plan, Warnings& out) {
  const bool dug_out = s.release.surface == ReleaseSurface::pre_failure;
  const double friction = typical_friction(with_typical_bed(s, in));
  const ReleaseLip lip =
      release_lip(*in.elevation, release_thickness(s.release, in), dug_out, friction);
  if (!s.domain.periodic.empty() || lip.share_of_drive < 0.1) return;
  const std::string cure =
      !dug_out ? "Look whether the terrain shows the slope before failure (release.surface)"
      : s.release.floor == ReleaseFloor::tapered
          ? "The release is too deep for its length: use less volume, a longer outline, or a "
            "thickness_raster whose floor comes out"
          : "Use release.floor: tapered, or a thickness_raster whose floor comes out";
  out.push_back(
      "a lip holds the release: along " + short_number(lip.length_m) +
      " m of its lower edge the ground stands " + short_number(lip.height_m) +
      " m above its floor (fall line " +
      short_number(std::atan(lip.slope) * 180 / std::numbers::pi) + " degrees, release " +
      short_number(plan.release.median_thickness_m) + " m thick). To push over it takes " +
      short_number(100 * lip.share_of_drive) +
      " % of what drives the release, and more where the grains are strong: it may stick where a "
      "slide whose floor comes out would run. " +
      cure);
}

/// Columns that know the bed only let a pile run out several times too far.
void warn_of_smooth_pile(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  if (!plan.formulation.depth_averaged || knows_internal_friction(plan.columns) ||
      pile_share(s, plan) <= 0)
    return;
  // A bed as rough as the grains gives them nothing to add.
  const bool isotropic = s.grains->earth_pressure == LateralPressure::isotropic;
  if (!isotropic && plan.columns.internal_friction > 0 && !s.mixture) return;
  out.push_back("a pile in columns without internal friction: the release is " +
                short_number(plan.release.median_thickness_m / plan.release_narrow_side_m) +
                " times as thick as it is wide, and only its bed holds it. On gentle ground it may "
                "run several times too far. " +
                (s.mixture   ? "A mixture knows no friction inside. Without `mixture`, "
                               "grains.earth_pressure: auto and basal.pore_pressure_ratio do"
                 : isotropic ? "Use grains.earth_pressure: auto, or formulation: full_stress"
                             : "Give grains.friction_angle_deg"));
}

/// The parabola decays with 3 c_v/h^2 where pi^2/4 is right; what is thick has time to show it.
void warn_of_parabola(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  constexpr double thick_m = 5;
  if (!s.mixture || s.mixture->pressure_profile == PressureProfile::resolved) return;
  const auto& thickness = plan.release.thickness;
  const double most = thickness.empty() ? 0 : *std::max_element(thickness.begin(), thickness.end());
  if (most <= thick_m) return;
  out.push_back(
      "a thick mixture drains too fast: the release is up to " + short_number(most) +
      " m thick (over 5 m), and the parabola of mixture.pressure_profile loses excess pore "
      "pressure 22 % too fast (factor 3 in place of pi^2/4). Use mixture.pressure_profile: "
      "resolved");
}

/// Fewer columns side by side than this are a blot of their smoothing, whatever the line was.
constexpr double least_columns_across = 4;

/// What enters through too narrow a gate, or too late.
void warn_of_inflow(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  const double dx = s.numerics.spacing_m, end = plan.end.end_time_s;
  if (!plan.inflow.empty() && plan.inflow.narrowest_m < least_columns_across * dx)
    out.push_back("unresolved inflow: " + short_number(plan.inflow.narrowest_m / dx) +
                  " spacings of " + short_number(dx) + " m across its width of " +
                  short_number(plan.inflow.narrowest_m) +
                  " m, fewer than 4: it spreads wider and thinner than it entered. Use a "
                  "numerics.spacing_m of " +
                  rounded_down(plan.inflow.narrowest_m / least_columns_across) + " m or less");
  double late = 0;
  for (const auto* waiting : {&plan.later, &plan.inflow.columns})
    for (const TimedArrival& c : *waiting)
      if (c.time_s >= end) late += c.arrival.mass / plan.bulk_density_kg_m3;
  if (late > 0)
    out.push_back("cut inflow: " + short_number(late) + " m3 start or enter after the end at " +
                  short_number(end) + " s. Use a larger numerics.end_time_s, or leave it out");
  if (!plan.later.empty() && s.release.surface == ReleaseSurface::pre_failure)
    out.emplace_back(
        "later releases are dug out of the ground from the start (release.surface: pre_failure): "
        "what comes over them before they start falls into their hole");
}

void warn_of_states(const Scenario& s, const ScenePlan& plan, Warnings& out) {
  if (!s.grains || !s.grains->states) return;
  if (plan.formulation.depth_averaged) {
    out.emplace_back(
        "grains.states is not used: columns have no states. Use formulation: full_stress "
        "where the grains may disperse");
    return;
  }
  const auto& dilute = s.grains->states->dilute;
  if (dilute && dilute->restitution.value < 0.7)
    out.push_back("grains.states.dilute.restitution = " + short_number(dilute->restitution.value) +
                  " lies under 0.7, where kinetic theory was not made for");
}

}  // namespace

Warnings plan_warnings(const Scenario& s, const ScenePlan& plan) {
  Warnings out;
  const double dx = s.numerics.spacing_m;
  warn_of_thin_flow(s, plan, out);
  warn_of_coarse_spacing(s, plan, out);
  if (s.grains && !plan.formulation.depth_averaged && !plan.discrete &&
      2 * plan.stress.smoothing_length < 4 * s.grains->diameter_m.value)
    out.push_back(
        "coarse grains: the smoothing length of " + short_number(plan.stress.smoothing_length) +
        " m is under two grain diameters of " + short_number(s.grains->diameter_m.value) +
        " m: the grains act as a parameter only" +
        (plan.coupling ? ", and their drag assumes a smoothing length of two of them" : ""));
  warn_of_inflow(s, plan, out);
  warn_of_states(s, plan, out);
  for (std::string& warning : liquid_warnings(s, plan)) out.push_back(std::move(warning));
  warn_of_smooth_pile(s, plan, out);
  warn_of_parabola(s, plan, out);
  if (plan.release.dropped_fraction > 0.01)
    out.push_back(
        "thin edge: " + short_number(100 * plan.release.dropped_fraction) +
        " % of the release lies where it is too thin for a particle and was given to the others");
  // Columns thin out continuously; particles do not.
  for (double threshold : s.hazard.thickness_m)
    if (!plan.formulation.depth_averaged && threshold < 0.5 * dx) {
      out.push_back("thickness thresholds under " + short_number(0.5 * dx) +
                    " m (half a spacing) are not resolved");
      break;
    }
  return out;
}

Warnings scene_warnings(const Scenario& s, const SceneInputs& in, const ScenePlan& plan) {
  Warnings out = plan_warnings(s, plan);
  warn_of_lip(s, in, plan, out);
  for (std::string& warning :
       structure_warnings(s, in, plan.bed.grid().cell_m, plan.formulation.depth_averaged))
    out.push_back(std::move(warning));
  return out;
}

}  // namespace sturz
