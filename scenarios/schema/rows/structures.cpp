// SPDX-License-Identifier: Apache-2.0
// Keys of what is built on the ground: terrain.dams, terrain.buildings.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto terrain = blocks::at<&Scenario::terrain>;
constexpr auto buildings = blocks::at<&Scenario::terrain, &TerrainSpec::buildings>;

}  // namespace

void add_structure_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(key(terrain, &TerrainSpec::dams,
                     {"terrain.dams", dam_list, "", -no_limit, no_limit,
                      "Dams and deflecting walls, raised on the ground before the run: a line, how "
                      "high its crest is, how wide, how steep the sides."}));
  keys.push_back(text_key(buildings, &BuildingsSpec::polygon, "terrain.buildings.polygon", path,
                          "Polygon layer of buildings; cells whose centre they hold stand above "
                          "the ground, so that the flow goes around them."));
  keys.push_back(text_key(buildings, &BuildingsSpec::layer, "terrain.buildings.layer", text,
                          "Layer inside terrain.buildings.polygon; the first when absent."));
  keys.push_back(above_min(key(buildings, &BuildingsSpec::height_m,
                               {"terrain.buildings.height_m", number, "m", 0, 1000,
                                "Height of the roofs above the ground."})));
  keys.push_back(text_key(buildings, &BuildingsSpec::height_attribute,
                          "terrain.buildings.height_attribute", text,
                          "Field of terrain.buildings.polygon that holds it, in metres."));
}

void add_structure_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(
      optional_block("terrain.buildings", "Buildings that stand in the way.", buildings));
}

}  // namespace sturz::schema_rows
