// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/structures/structure_warnings.hpp"

#include "scenarios/assembly/structures/column_ground.hpp"
#include "scenarios/assembly/structures/dams.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sturz {
namespace {

/// Of its height: less is within what a crest is surveyed to.
constexpr double lack_that_counts = 0.05;

/// Something of the release lies there.
bool on_release(const SceneInputs& in, double x, double y) {
  const Grid& g = in.release->grid;
  const int row = g.row_of(y), col = g.col_of(x);
  return g.contains(row, col) && in.release->at(row, col) > 0;
}

/// Mass that starts on a dam or a roof falls off it at once, and what stands there holds or parts
/// the slide before it has moved: mostly an outline or a line is out of place.
void warn_of_release(const SceneInputs& in, std::vector<std::string>& out) {
  if (in.release == nullptr) return;
  for (const DamLine& line : in.structures.dams) {
    const auto n = std::count_if(line.points.begin(), line.points.end(),
                                 [&](const Vec2& p) { return on_release(in, p.x(), p.y()); });
    if (n == 0) continue;
    const auto n_steps = static_cast<double>(std::max<std::size_t>(line.points.size(), 2) - 1);
    const double length = std::min(1.0, static_cast<double>(n) / n_steps) * line.length_m;
    out.push_back(line.name + ": about " + short_number(length) +
                  " m of it stand on the release, which then starts on the dam and behind it. Move "
                  "the dam or the outline of the release if that is not meant");
  }
  std::set<int> houses;
  const Grid& g = in.elevation->grid;
  for (const RaisedCell& cell : in.structures.buildings) {
    const auto at = static_cast<int>(cell.cell);
    if (on_release(in, g.x_center(at % g.n_cols), g.y_center(at / g.n_cols)))
      houses.insert(cell.building);
  }
  if (!houses.empty())
    out.push_back("terrain.buildings: " + std::to_string(houses.size()) +
                  (houses.size() == 1 ? " building stands" : " buildings stand") +
                  " on the release, which then starts on the roof. Leave them out of the layer, or "
                  "correct the outline of the release, if that is not meant");
}

}  // namespace

std::vector<std::string> structure_warnings(const Scenario& s, const SceneInputs& in, double cell_m,
                                            bool columns) {
  std::vector<std::string> out;
  if (!in.structures.any()) return out;
  warn_of_release(in, out);
  const std::string finer =
      columns ? "Use a finer numerics.spacing_m and terrain" : "Use a finer terrain";
  for (std::size_t i = 0; i < s.terrain.dams.size(); ++i) {
    const DamSpec& dam = s.terrain.dams[i];
    const double width = standing_width(dam, cell_m);
    if (width <= dam.crest_width_m) continue;
    out.push_back(dam_path(i) + ": its crest is " + short_number(dam.crest_width_m) +
                  " m wide, the cells of the ground " + short_number(cell_m) +
                  " m: so that nothing leaks through it stands " + short_number(width) +
                  " m wide there, and takes that much more room. " + finer);
  }
  const int factor = static_cast<int>(std::lround(cell_m / in.terrain_grid().cell_m));
  if (!columns) return out;
  const CrestLack lack = crest_lack(s, in, factor);
  if (lack.share > lack_that_counts)
    out.push_back(
        lack.name + ": the ground that columns feel lies up to " + short_number(100 * lack.share) +
        " % of the dam's height under its crest, so it is overtopped too easily. " + finer);
  if (const int lost = lost_buildings(in, factor); lost > 0)
    out.push_back("terrain.buildings: " + std::to_string(lost) +
                  " buildings cover no half of any cell of " + short_number(cell_m) +
                  " m that columns feel and are not there. " + finer);
  return out;
}

}  // namespace sturz
