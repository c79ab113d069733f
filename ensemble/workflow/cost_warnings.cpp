// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cost_warnings.hpp"

#include "ensemble/workflow/readable.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/start_checks.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

constexpr double long_time_s = 600;

/// The coarsest spacing that still resolves the scene [m].
double coarsest(const SceneDescription& d, bool columns) {
  const double across = d.narrow_side_m / resolved_across;
  return columns ? across : std::min(across, d.spacing_m * d.layers / resolved_layers);
}

/// For the members: what they would take instead of `members_s`, with what is left to do besides.
std::vector<std::string> cheaper_members(const SceneDescription& d, double members_s,
                                         double besides_s) {
  const bool columns = d.formulation == to_string(Formulation::depth_averaged);
  const double power = columns ? 3 : 4;
  std::vector<std::string> cheaper;
  const bool grains = d.formulation == to_string(Formulation::discrete);
  const double wanted = d.spacing_m * std::pow(members_s / long_time_s, 1 / power);
  const double spacing = std::min(wanted, coarsest(d, columns));
  if (grains) return {"larger grains (grains.discrete.diameter_m), formulation: depth_averaged"};
  if (spacing > 1.1 * d.spacing_m)
    cheaper.push_back(
        fmt::format("numerics.spacing_m: {} ({}{})", short_number(spacing),
                    duration_text(besides_s + members_s * std::pow(d.spacing_m / spacing, power)),
                    spacing < wanted ? ", the coarsest that resolves the release" : ""));
  if (d.other_formulation_cost > 0 && d.other_formulation_cost < 0.5)
    cheaper.push_back(
        fmt::format("formulation: {} (about {})",
                    to_string(columns ? Formulation::full_stress : Formulation::depth_averaged),
                    duration_text(besides_s + members_s * d.other_formulation_cost)));
  return cheaper;
}

/// Twice the cell, or as much more as brings the maps under the long time.
std::string cheaper_maps(double cell_m, double maps_s, double besides_s) {
  const double larger = std::max(2.0, std::sqrt(maps_s / long_time_s));
  return fmt::format("hazard.cell_size_m: {} ({})", short_number(cell_m * larger),
                     duration_text(besides_s + maps_s / (larger * larger)));
}

}  // namespace

std::vector<std::string> cost_warnings(const Scene& scene, std::int64_t members, int cores,
                                       double maps_s) {
  const SceneDescription& d = scene.description;
  const double members_s = d.predicted_seconds * static_cast<double>(members) /
                           static_cast<double>(std::min<std::int64_t>(std::max(cores, 1), members));
  const double seconds = members_s + maps_s;
  if (!(seconds > long_time_s)) return {};
  std::vector<std::string> cheaper;
  if (members_s > maps_s / 2) cheaper = cheaper_members(d, members_s, maps_s);
  if (maps_s > members_s / 2)
    cheaper.push_back(cheaper_maps(scene.inputs.hazard_grid.cell_m, maps_s, members_s));
  std::string what =
      members > 1 ? fmt::format("{} members on {} cores", members, cores) : "this member";
  if (maps_s > 0.1 * seconds) what += fmt::format(" and {} of maps", duration_text(maps_s));
  return {fmt::format("{} may take {}, more than ten minutes. {}", what, duration_text(seconds),
                      cheaper.empty() ? "Nothing cheaper resolves the release."
                                      : "Cheaper: " + comma_separated(cheaper) + ".")};
}

}  // namespace sturz::workflow
