// SPDX-License-Identifier: Apache-2.0
// Dams and buildings: what each needs and what it may not be together with.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/dam_fields.hpp"

#include <string>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

void check_dam(const DamSpec& dam, const std::string& path, Problems& problems) {
  const auto add = [&](const std::string& why) {
    problems.push_back({"terrain.dams", path + why});
  };
  const bool file = !dam.line.empty(), inline_line = !dam.points_m.empty();
  if (!file && !inline_line)
    add(" (where is it?). Give line, a layer of lines, or points_m: [[x, y], [x, y], ..].");
  if (file && inline_line) add(" (line and points_m both say where). Keep one of them.");
  if (!dam.layer.empty() && !file) add(".layer (only a file has layers). Remove it or name line.");
  if (!dam.height_attribute.empty() && !file)
    add(".height_attribute (only a file has fields). Remove it or name line.");
  const int heights =
      dam.height_m.has_value() + dam.crest_elevation_m.has_value() + !dam.height_attribute.empty();
  if (heights == 0)
    add(" (how high is it?). Give height_m above the ground, height_attribute, or "
        "crest_elevation_m for a level crest.");
  if (heights > 1)
    add(" (more than one of height_m, height_attribute, crest_elevation_m says how high it is). "
        "Keep one of them.");
}

}  // namespace

void check_structures(const Scenario& s, Problems& problems) {
  const TerrainSpec& t = s.terrain;
  for (std::size_t i = 0; i < t.dams.size(); ++i) check_dam(t.dams[i], dam_path(i), problems);
  const bool periodic = !s.domain.periodic.empty();
  if (periodic && !t.dams.empty())
    problems.push_back({"terrain.dams",
                        "terrain.dams (domain.periodic is there too; a dam would not repeat). "
                        "Remove one of the two."});
  if (!t.buildings) return;
  if (periodic)
    problems.push_back({"terrain.buildings",
                        "terrain.buildings (domain.periodic is there too; a building would not "
                        "repeat). Remove one of the two."});
  if (t.buildings->polygon.empty())
    problems.push_back({"terrain.buildings",
                        "terrain.buildings (polygon is missing). Name the file that outlines "
                        "them."});
}

}  // namespace sturz
