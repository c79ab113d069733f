// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/time_cap.hpp"

#include "engine/core/constants.hpp"
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Of a slow flow: gentler slopes hold nearly every mass.
constexpr double gentle_slope = 0.05;
/// Of the way at the characteristic speed: masses start and stop slowly.
constexpr double margin = 4;
constexpr double repeating_s = 120, least_s = 1, most_s = 1e5;

double rounded_up(double seconds) {
  const double digit = std::pow(10.0, std::floor(std::log10(seconds)) - 1);
  return std::ceil(seconds / digit * (1 - 1e-12)) * digit;
}

double slowest_speed(const Scenario& s, const SceneInputs& in, double thickness, double density) {
  double speed = std::sqrt(standard_gravity * thickness);
  const BasalSpec& bed = s.basal;
  const double xi = drawn_bed_range(s, in, BedNumber::turbulence).first;
  if (std::isfinite(xi)) speed = std::min(speed, std::sqrt(xi * thickness * gentle_slope));
  const double viscosity = bed.viscosity_pa_s   ? bed.viscosity_pa_s->value
                           : is_liquid_alone(s) ? plain_viscosity(*s.fluid)
                                                : 0;
  if (viscosity > 0)
    speed = std::min(
        speed, density * standard_gravity * gentle_slope * thickness * thickness / (3 * viscosity));
  return speed;
}

/// Where the ground was not looked at: its diagonal.
double longest_way(const SceneInputs& in) {
  if (in.reach) return in.reach->length_m;
  const Grid& g = in.terrain_grid();
  return std::hypot(g.n_cols, g.n_rows) * g.cell_m;
}

}  // namespace

TimeCap time_cap(const Scenario& s, const SceneInputs& in, double thickness, double density) {
  if (s.numerics.end_time_s) return {*s.numerics.end_time_s, "numerics.end_time_s"};
  if (!s.domain.periodic.empty())
    return {repeating_s,
            "the ground repeats itself and no way ends on it; numerics.end_time_s "
            "sets another"};
  const double way = longest_way(in), speed = slowest_speed(s, in, thickness, density);
  const double seconds = speed > 0 ? std::clamp(margin * way / speed, least_s, most_s) : most_s;
  std::string reason = "four times the longest way of the energy line, " +
                       short_number(std::round(way)) + " m, at " + short_number(speed) +
                       " m/s, the slowest speed of such a flow";
  return {std::min(most_s, rounded_up(seconds)), std::move(reason)};
}

}  // namespace sturz
