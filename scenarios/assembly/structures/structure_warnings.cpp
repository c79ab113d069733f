// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assembly/structures/structure_warnings.hpp"

#include "scenarios/assembly/structures/column_ground.hpp"
#include "scenarios/assembly/structures/dams.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/number_text.hpp"

#include <cmath>

namespace sturz {
namespace {

/// Of its height: less is within what a crest is surveyed to.
constexpr double lack_that_counts = 0.05;

}  // namespace

std::vector<std::string> structure_warnings(const Scenario& s, const SceneInputs& in, double cell_m,
                                            bool columns) {
  std::vector<std::string> out;
  if (!in.structures.any()) return out;
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
