// SPDX-License-Identifier: Apache-2.0
// What dams do to the ground, found before anything is computed.
#include "io/site/structures/structure_inputs.hpp"
#include "scenarios/assembly/structures/dams.hpp"
#include "scenarios/schema/dam_fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

/// A dam at the least and the greatest height of any member.
std::pair<DamSpec, DamSpec> ends_of(const DamSpec& spec) {
  std::pair<DamSpec, DamSpec> ends(spec, spec);
  for (const DamField& field : dam_fields)
    if (const auto& number = spec.*field.value) {
      const auto [low, high] = drawn_range(*number);
      ends.first.*field.value = Uncertain(low), ends.second.*field.value = Uncertain(high);
    }
  return ends;
}

bool is_uncertain(const DamSpec& spec) {
  return std::any_of(dam_fields.begin(), dam_fields.end(), [&](const DamField& field) {
    const auto& number = spec.*field.value;
    return number && number->distribution;
  });
}

std::string between(double low, double high, const char* unit) {
  const std::string a = fmt::format("{:.4g}", low), b = fmt::format("{:.4g}", high);
  return a == b ? fmt::format("{} {}", a, unit) : fmt::format("{} to {} {}", a, b, unit);
}

/// Raises one line on a copy of the ground around it.
DamFacts tried(const DamLine& line, const DamSpec& spec, Raster<double> site) {
  return raise_dam(line, spec, standing_width(spec, site.grid.cell_m), site);
}

void tell(const DamLine& line, const DamSpec& spec, const Raster<double>& site, SceneInputs& in) {
  const auto [low, high] = ends_of(spec);
  const DamFacts least = tried(line, low, site), most = tried(line, high, site);
  const bool by_member = is_uncertain(spec);
  in.notes.push_back(fmt::format(
      "{}: {:.4g} m long, crest {:g} m wide at {}, sides 1 in {:g}{}; {} cells raised by up to {}, "
      "fill {}",
      line.name, line.length_m, spec.crest_width_m,
      between(least.lowest_crest_m, most.highest_crest_m, "m"), spec.side_slope,
      by_member ? ", its height drawn for each member" : "",
      least.cells == most.cells ? std::to_string(most.cells)
                                : fmt::format("{} to {}", least.cells, most.cells),
      between(least.highest_m, most.highest_m, "m"), between(least.fill_m3, most.fill_m3, "m3")));
  const auto warn = [&](const std::string& text) {
    in.warnings.push_back(line.name + ": " + text);
  };
  if (most.cut)
    warn(
        fmt::format("on a slope nearly as steep as its sides (1 in {:g}) the fill meets no ground "
                    "within {:g} times its height and ends in a step there. Give it steeper sides",
                    spec.side_slope, farthest_foot * spec.side_slope));
  const std::vector<double> crest = crest_of(line, low);
  std::size_t below = 0;
  for (std::size_t i = 0; i < crest.size(); ++i) below += crest[i] <= line.ground_m[i];
  if (below > 0)
    warn(
        fmt::format("along {:.3g} % of its line the ground lies as high as its crest: there is no "
                    "dam there",
                    100.0 * static_cast<double>(below) / static_cast<double>(crest.size())));
}

}  // namespace

void survey_dams(const Scenario& scenario, const Grid& terrain, const ReadGround& read,
                 double cell_m, SceneInputs& in) {
  GroundStructures& structures = in.structures;
  structures.by_member.clear();
  for (const DamSpec& spec : scenario.terrain.dams)
    structures.by_member.push_back(is_uncertain(spec));
  Window site;
  for (DamLine& line : structures.dams) {
    const DamSpec high = ends_of(scenario.terrain.dams[line.dam]).second;
    line.foot_heights = farthest_foot;
    // Averaged ground has fewer cells, and some of them lie half beyond the window.
    const double margin = farthest_side(line, high, standing_width(high, cell_m)) + 4 * cell_m;
    const Window own = window_around(line.points, margin, terrain);
    const Raster<double> ground = read(own);
    line.foot_heights = near_foot;
    const auto [least, most] = ends_of(scenario.terrain.dams[line.dam]);
    if (tried(line, least, ground).cut || tried(line, most, ground).cut)
      line.foot_heights = farthest_foot;
    tell(line, scenario.terrain.dams[line.dam], ground, in);
    site = joined(site, own);
  }
  if (site.n_cells() > 0) structures.site = read(site);
}

std::vector<DamSpec> at_middle_height(std::vector<DamSpec> dams) {
  for (DamSpec& dam : dams)
    for (const DamField& field : dam_fields)
      if (auto& number = dam.*field.value) {
        const auto [low, high] = drawn_range(*number);
        number = Uncertain(0.5 * (low + high));
      }
  return dams;
}

void stand_on(const Scenario& scenario, const GroundStructures& structures,
              const std::vector<RaisedCell>& cells, Raster<double>& ground) {
  raise_dams(structures, scenario.terrain.dams, WhichDams::fixed, ground);
  for (const RaisedCell& cell : cells) ground.values[cell.cell] += cell.by_m;
}

}  // namespace sturz
