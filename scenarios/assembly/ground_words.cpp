// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/ground_words.hpp"

#include "scenarios/assembly/liquid/liquid_plan.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>

namespace sturz {
namespace {

std::string size_text(int n_cols, int n_rows) {
  return std::to_string(n_cols) + " x " + std::to_string(n_rows);
}

/// The line's friction is not a number of the file where pore pressure is taken off it.
bool knows_pore_pressure(const BasalSpec& basal) {
  const auto some = [](const Uncertain& u) { return drawn_range(u).second > 0; };
  return some(basal.pore_pressure_ratio) ||
         std::any_of(basal.zones.begin(), basal.zones.end(), [&](const BasalZone& zone) {
           return zone.pore_pressure_ratio && some(*zone.pore_pressure_ratio);
         });
}

std::string line_text(const Scenario& s, const Reach& reach) {
  const std::string friction = short_number(reach.friction);
  if (s.mixture) return "the energy line of a nearly liquefied mixture (friction " + friction + ")";
  if (s.fluid && s.grains)
    return "the energy line of the grains as the liquid carries them (friction " + friction +
           ", and liquid by itself may run farther)";
  if (s.fluid)
    return reach.friction > liquid_friction
               ? "the energy line of the yield stress under the thickest part (friction " +
                     friction + ")"
               : "the energy line of a liquid, which has no friction (" + friction +
                     " stands for what viscosity and yield stress take)";
  std::string text = "the energy line of the least friction drawn";
  if (knows_pore_pressure(s.basal)) text += ", less the most pore pressure";
  return text + " (" + friction + ")";
}

}  // namespace

std::string ground_line(const Scenario& s, const SceneInputs& in) {
  const Grid& g = in.terrain_grid();
  const Window held = in.held();
  const std::string all = size_text(g.n_cols, g.n_rows);
  if (!in.reach) return "ground: all " + all + " cells of the terrain";
  if (held == whole_of(g))
    return "ground: all " + all + " cells; " + line_text(s, *in.reach) + " reaches " +
           short_number(in.reach->length_m) + " m at most";
  std::string why =
      s.terrain.window ? "terrain.window" : line_text(s, *in.reach) + " with a margin";
  if (!s.terrain.window && in.reach->cut) why += ", not followed to its end";
  return "ground: " + size_text(held.n_cols, held.n_rows) + " of " + all + " cells (" + why +
         "); more is read where a member comes near their end";
}

std::vector<std::string> ground_warnings(const Scenario& s, const SceneInputs& in) {
  std::vector<std::string> out;
  if (!in.reach || s.terrain.nodata == TerrainEdge::wall) return out;
  const Reach& reach = *in.reach;
  const std::string then =
      " Mass that passes there is lost, and such members count as censored: their runout, deposit "
      "and area are lower bounds.";
  if (reach.above_end_m > 0)
    out.push_back(std::string(edge_warning) + line_text(s, reach) + " still stands " +
                  short_number(reach.above_end_m) + " m above the ground at its " + reach.end +
                  "ern end." + then + " Use a terrain that goes on there.");
  if (reach.above_unknown_m > 0)
    out.push_back("gaps in the terrain: " + line_text(s, reach) + " stands up to " +
                  short_number(reach.above_unknown_m) +
                  " m above the ground beside cells without elevation." + then +
                  " Fill the terrain there, or use one that goes on there.");
  if (reach.cut)
    out.push_back("long way: " + line_text(s, reach) + " covers more than " +
                  short_number(most_reach_cells / 1e6) +
                  " million cells and was not followed farther; whether it meets the end of the "
                  "terrain is not known");
  return out;
}

}  // namespace sturz
