// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/ground_words.hpp"

#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sturz {
namespace {

/// A release nearer to the end of the ground than so many spacings or cells spreads over it at
/// once.
constexpr double near_spacings = 5, near_cells = 3;

std::string size_text(int n_cols, int n_rows) {
  return std::to_string(n_cols) + " x " + std::to_string(n_rows);
}

std::string line_text(const Reach& reach) {
  return "the energy line of the least friction drawn (" + short_number(reach.friction) + ")";
}

/// Distance of the release from the nearest end of the raster, and which end it is.
struct Gap {
  double metres = 0;
  const char* end = "";
};

Gap gap_to_end(const SceneInputs& in) {
  const Grid& g = in.terrain_grid();
  const Window w = window_of(in.release->grid, g);
  int row0 = g.n_rows, row1 = -1, col0 = g.n_cols, col1 = -1;
  for (int r = 0; r < w.n_rows; ++r)
    for (int c = 0; c < w.n_cols; ++c)
      if (in.release->at(r, c) > 0) {
        row0 = std::min(row0, w.row0 + r), row1 = std::max(row1, w.row0 + r);
        col0 = std::min(col0, w.col0 + c), col1 = std::max(col1, w.col0 + c);
      }
  const std::pair<int, const char*> gaps[] = {{row0, "north"},
                                              {g.n_cols - 1 - col1, "east"},
                                              {g.n_rows - 1 - row1, "south"},
                                              {col0, "west"}};
  const auto least = std::min_element(std::begin(gaps), std::end(gaps));
  return {least->first * g.cell_m, least->second};
}

}  // namespace

std::string ground_line(const Scenario& s, const SceneInputs& in) {
  const Grid& g = in.terrain_grid();
  const Window held = in.held();
  const std::string all = size_text(g.n_cols, g.n_rows);
  if (!in.reach) return "ground: all " + all + " cells of the terrain";
  if (held == whole_of(g))
    return "ground: all " + all + " cells; " + line_text(*in.reach) + " reaches " +
           short_number(in.reach->length_m) + " m at most";
  std::string why = s.terrain.window ? "terrain.window" : line_text(*in.reach) + " with a margin";
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
  const Gap gap = gap_to_end(in);
  const double near =
      std::max(near_spacings * s.numerics.spacing_m, near_cells * in.terrain_grid().cell_m);
  if (gap.metres < near)
    out.push_back("edge of the terrain: the release lies " + short_number(gap.metres) +
                  " m from its " + gap.end + "ern end." + then + " Use a larger terrain.");
  if (reach.above_end_m > 0)
    out.push_back("edge of the terrain: " + line_text(reach) + " still stands " +
                  short_number(reach.above_end_m) + " m above the ground at its " + reach.end +
                  "ern end." + then + " Use a terrain that goes on there.");
  if (reach.above_unknown_m > 0)
    out.push_back("gaps in the terrain: " + line_text(reach) + " stands up to " +
                  short_number(reach.above_unknown_m) +
                  " m above the ground beside cells without elevation." + then +
                  " Fill the terrain there.");
  if (reach.cut)
    out.push_back("long way: " + line_text(reach) + " covers more than " +
                  short_number(most_reach_cells / 1e6) +
                  " million cells and was not followed farther; whether it meets the end of the "
                  "terrain is not known");
  return out;
}

}  // namespace sturz
