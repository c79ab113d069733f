// SPDX-License-Identifier: Apache-2.0
// One terrain, one source, one way to say how thick it is.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <algorithm>
#include <utility>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

/// Results do not depend on the window; one that cannot be meant is refused all the same.
void check_window(const TerrainSpec& t, Problems& problems) {
  const TerrainWindow& w = *t.window;
  if (t.synthetic)
    problems.push_back(
        {"terrain.window", "terrain.window (a synthetic terrain is made whole). Remove it."});
  const bool box = w.x_m[1] > w.x_m[0] && w.y_m[1] > w.y_m[0];
  const bool none = w.x_m == std::array<double, 2>{} && w.y_m == std::array<double, 2>{};
  if (!w.polygon.empty() && !none)
    problems.push_back({"terrain.window",
                        "terrain.window (polygon and x_m, y_m both say where). Keep one of them."});
  if (w.polygon.empty() && !box)
    problems.push_back({"terrain.window",
                        "terrain.window (no area). Give x_m: [west, east] and y_m: [south, "
                        "north], the smaller number first, or a polygon."});
}

void check_terrain(const TerrainSpec& t, Problems& problems) {
  if (t.window) check_window(t, problems);
  const bool raster = !t.raster.empty();
  if (!raster && !t.synthetic)
    problems.push_back({"terrain",
                        "terrain (no ground given). Add terrain.raster or "
                        "terrain.synthetic."});
  if (raster && t.synthetic)
    problems.push_back({"terrain.synthetic",
                        "terrain.synthetic (terrain.raster is there too). "
                        "Keep one of them."});
  if (!t.synthetic || raster) return;
  if (t.cell_size_m)
    problems.push_back({"terrain.cell_size_m",
                        "terrain.cell_size_m (a synthetic terrain has its "
                        "own cell_size_m). Set that one."});
  if (!t.crs.empty())
    problems.push_back({"terrain.crs",
                        "terrain.crs (only a raster file can lack a coordinate "
                        "system). Remove it."});
}

std::vector<std::string> given_sources(const ReleaseSpec& r) {
  std::vector<std::string> given;
  if (!r.polygon.empty()) given.emplace_back("polygon");
  if (!r.thickness_raster.empty()) given.emplace_back("thickness_raster");
  if (r.box) given.emplace_back("box");
  if (r.paraboloid) given.emplace_back("paraboloid");
  if (r.cylinder) given.emplace_back("cylinder");
  return given;
}

bool has_own_source(const TerrainSpec& t) {
  return t.synthetic && brings_source(t.synthetic->shape);
}

/// Thickness and volume of a source that is only an outline.
void check_outline(const ReleaseSpec& r, const std::string& source, Problems& problems) {
  const bool attribute = !r.thickness_attribute.empty() || !r.volume_attribute.empty();
  if (!r.thickness_attribute.empty() && !r.volume_attribute.empty())
    problems.push_back({"release.volume_attribute",
                        "release.volume_attribute (release.thickness_attribute gives the thickness "
                        "too). Keep one of them."});
  if (attribute && r.thickness_m)
    problems.push_back(
        {"release.thickness_m",
         "release.thickness_m (" +
             std::string(r.thickness_attribute.empty() ? "release.volume_attribute"
                                                       : "release.thickness_attribute") +
             " gives the thickness too). Keep one of them."});
  if (r.thickness_m && r.volume_m3)
    problems.push_back({"release.volume_m3",
                        "release.volume_m3 (release.thickness_m fixes the "
                        "volume already). Keep one of them."});
  if (!r.thickness_m && !r.volume_m3 && !attribute)
    problems.push_back({"release", "release (how thick is the " + source +
                                       "?). Add "
                                       "release.thickness_m or release.volume_m3."});
}

void check_source(const Scenario& s, Problems& problems) {
  const auto& r = s.release;
  const auto given = given_sources(r);
  if (given.size() > 1) {
    problems.push_back({"release", "release (more than one source: " + comma_separated(given) +
                                       "). Keep one of them."});
    return;
  }
  const bool own = given.empty() && has_own_source(s.terrain);
  if (given.empty() && !own && !s.inflow.empty()) {
    for (const auto& [path, there] :
         {std::pair{"release.thickness_m", r.thickness_m.has_value()},
          std::pair{"release.volume_m3", r.volume_m3.has_value()},
          std::pair{"release.start_time_s", r.start_time_s.has_value()}})
      if (there)
        problems.push_back({path, std::string(path) +
                                      " (there is no source that it is for, only inflow). Remove "
                                      "it or name a source."});
    return;
  }
  if (given.empty() && !own) {
    problems.push_back({"release",
                        "release (no source given). Add one of polygon, "
                        "thickness_raster, box, paraboloid, cylinder, or an inflow."});
    return;
  }
  if (!own && given[0] != "thickness_raster") return check_outline(r, given[0], problems);
  if (r.thickness_m)
    problems.push_back({"release.thickness_m",
                        std::string("release.thickness_m (") +
                            (own ? "the synthetic terrain brings" : "release.thickness_raster is") +
                            " the thickness). Remove it; release.volume_m3 scales the source."});
  if (own && r.thickness == ThicknessDirection::normal)
    problems.push_back({"release.thickness",
                        "release.thickness = normal (the synthetic terrain brings vertical "
                        "thicknesses). Remove it."});
  if (own && r.surface == ReleaseSurface::pre_failure)
    problems.push_back({"release.surface",
                        "release.surface = pre_failure (the synthetic terrain "
                        "brings its bed and its source). Remove it."});
}

/// What only the features of a polygon layer can say.
void check_features(const ReleaseSpec& r, Problems& problems) {
  const bool polygon = !r.polygon.empty();
  const auto refuse = [&](const std::string& key, const std::string& why) {
    problems.push_back({key, key + " (" + why});
  };
  const char* const no_file =
      "only release.polygon has features). Remove it or name the polygon "
      "file.";
  if (!r.feature.empty() && !polygon) refuse("release.feature", no_file);
  if (r.each_feature && !polygon) refuse("release.each_feature", no_file);
  if (!r.volume_attribute.empty() && !polygon) refuse("release.volume_attribute", no_file);
  if (!r.volume_attribute.empty() && r.thickness == ThicknessDirection::normal)
    refuse("release.volume_attribute",
           "its thickness is the volume over the area in the map, so vertical). Remove "
           "release.thickness: normal.");
  if (!r.volume_attribute.empty() && r.volume_m3)
    refuse("release.volume_attribute",
           "release.volume_m3 scales all features to one volume). Keep one of them.");
  if (!r.feature.empty() && r.each_feature)
    refuse("release.each_feature", "release.feature names one of them). Keep one of the two.");
  if (!r.feature_key.empty() && r.feature.empty() && !r.each_feature)
    refuse("release.feature_key",
           "says by what release.feature is found, and no feature is named). Add release.feature "
           "or release.each_feature, or remove it.");
}

void check_companions(const ReleaseSpec& r, Problems& problems) {
  const bool polygon = !r.polygon.empty();
  if (!r.layer.empty() && !polygon)
    problems.push_back({"release.layer",
                        "release.layer (only release.polygon has layers). "
                        "Remove it or name the polygon file."});
  if (!r.thickness_attribute.empty() && !polygon)
    problems.push_back({"release.thickness_attribute",
                        "release.thickness_attribute (only release.polygon has fields). Remove "
                        "it or name the polygon file."});
  if (!r.crs.empty() && !polygon && r.thickness_raster.empty())
    problems.push_back({"release.crs",
                        "release.crs (only a release file can lack a coordinate "
                        "system). Remove it."});
  const auto rises = [&](const std::array<double, 2>& edges, const char* path) {
    if (!(edges[0] < edges[1]))
      problems.push_back({path, std::string(path) + " (the second edge must be above the first). "
                                                    "Give [smaller, larger]."});
  };
  if (r.box) {
    rises(r.box->x_m, "release.box.x_m");
    rises(r.box->y_m, "release.box.y_m");
  }
}

/// A floor of its own needs a release that is dug out and says no floor yet.
void check_floor(const Scenario& s, Problems& problems) {
  const auto& r = s.release;
  if (r.floor != ReleaseFloor::tapered) return;
  const auto refuse = [&](const std::string& why) {
    problems.push_back({"release.floor", "release.floor = tapered (" + why});
  };
  if (r.surface == ReleaseSurface::bed)
    refuse(
        "surface is bed: the terrain is the floor). Set release.surface: pre_failure, or remove "
        "it.");
  else if (!r.thickness_raster.empty())
    refuse("release.thickness_raster says the floor already). Remove it.");
  else if (r.paraboloid)
    refuse("a paraboloid tapers already). Remove it.");
}

}  // namespace

void check_terrain_and_release(const Scenario& s, Problems& problems) {
  check_terrain(s.terrain, problems);
  check_source(s, problems);
  check_companions(s.release, problems);
  check_features(s.release, problems);
  check_floor(s, problems);
}

}  // namespace sturz
