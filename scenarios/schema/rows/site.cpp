// SPDX-License-Identifier: Apache-2.0
// Keys that say where: title, terrain, release.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto scene = blocks::scene;
constexpr auto terrain = blocks::at<&Scenario::terrain>;
constexpr auto terrain_window = blocks::at<&Scenario::terrain, &TerrainSpec::window>;
constexpr auto release = blocks::at<&Scenario::release>;
constexpr auto release_box = blocks::at<&Scenario::release, &ReleaseSpec::box>;
constexpr auto release_paraboloid = blocks::at<&Scenario::release, &ReleaseSpec::paraboloid>;
constexpr auto release_cylinder = blocks::at<&Scenario::release, &ReleaseSpec::cylinder>;

constexpr double map_limit = 1e8;  // metres; no projected coordinate is larger

void add_window(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(with_size(key(terrain_window, &TerrainWindow::x_m,
                               {"terrain.window.x_m", number_list, "m", -map_limit, map_limit,
                                "West and east edge of what is read first of the raster."}),
                           2));
  keys.push_back(with_size(key(terrain_window, &TerrainWindow::y_m,
                               {"terrain.window.y_m", number_list, "m", -map_limit, map_limit,
                                "South and north edge of it."}),
                           2));
  keys.push_back(text_key(terrain_window, &TerrainWindow::polygon, "terrain.window.polygon", path,
                          "Polygon layer whose extent is read first, instead of x_m and y_m."));
}

void add_terrain(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(text_key(terrain, &TerrainSpec::raster, "terrain.raster", path,
                          "Elevation raster in any format that GDAL reads."));
  keys.push_back(key(terrain, &TerrainSpec::synthetic,
                     {"terrain.synthetic", synthetic, "", -no_limit, no_limit,
                      "Ground written as a formula: one shape with its own numbers."}));
  keys.push_back(text_key(terrain, &TerrainSpec::crs, "terrain.crs", text,
                          "Coordinate system of the raster, e.g. EPSG:32648, where the file has "
                          "none or a wrong one; local: metres that lie nowhere on the map."));
  keys.push_back(key(terrain, &TerrainSpec::cell_size_m,
                     {"terrain.cell_size_m", number, "m", 1e-3, 1e4,
                      "Cell of the working grid; the raster's own when absent."}));
  keys.push_back(
      choice_key(terrain, &TerrainSpec::nodata, "terrain.nodata",
                 "What the edge of the known ground does to the mass: lets it out or holds it."));
  add_window(keys);
  add_structure_keys(keys);
}

void add_shapes(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(with_size(key(release_box, &ReleaseBox::x_m,
                               {"release.box.x_m", number_list, "m", -map_limit, map_limit,
                                "West and east edge of a rectangular source."}),
                           2));
  keys.push_back(with_size(key(release_box, &ReleaseBox::y_m,
                               {"release.box.y_m", number_list, "m", -map_limit, map_limit,
                                "South and north edge of a rectangular source."}),
                           2));
  keys.push_back(with_size(key(release_paraboloid, &ReleaseParaboloid::center_m,
                               {"release.paraboloid.center_m", number_list, "m", -map_limit,
                                map_limit, "Map x and y of the thickest point of a cap."}),
                           2));
  keys.push_back(above_min(with_size(key(release_paraboloid, &ReleaseParaboloid::semi_axes_m,
                                         {"release.paraboloid.semi_axes_m", number_list, "m", 0,
                                          map_limit, "Half lengths of the cap along x and y."}),
                                     2)));
  keys.push_back(with_size(key(release_cylinder, &ReleaseCylinder::center_m,
                               {"release.cylinder.center_m", number_list, "m", -map_limit,
                                map_limit, "Map x and y of the axis of a round source."}),
                           2));
  keys.push_back(above_min(
      key(release_cylinder, &ReleaseCylinder::radius_m,
          {"release.cylinder.radius_m", number, "m", 0, map_limit, "Radius of a round source."})));
}

void add_release(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(text_key(release, &ReleaseSpec::polygon, "release.polygon", path,
                          "Polygon layer that outlines the source, any format that OGR reads."));
  keys.push_back(text_key(release, &ReleaseSpec::layer, "release.layer", text,
                          "Layer inside release.polygon; the first when absent."));
  keys.push_back(text_key(release, &ReleaseSpec::feature, "release.feature", text,
                          "The one feature of release.polygon that is the source, by its value of "
                          "feature_key or its FID; all of them when absent."));
  keys.push_back(text_key(release, &ReleaseSpec::feature_key, "release.feature_key", text,
                          "Field of release.polygon that names its features, each by a value of "
                          "its own; the FID (feature number) of the file when absent."));
  keys.push_back(key(release, &ReleaseSpec::each_feature,
                     {"release.each_feature", flag, "", -no_limit, no_limit,
                      "Whether each feature of release.polygon is a source of its own: a region, "
                      "one ensemble for each and maps of all together."}));
  keys.push_back(text_key(release, &ReleaseSpec::thickness_attribute, "release.thickness_attribute",
                          text,
                          "Field of release.polygon that holds each polygon's thickness in "
                          "metres."));
  keys.push_back(text_key(release, &ReleaseSpec::volume_attribute, "release.volume_attribute", text,
                          "Field of release.polygon that holds each polygon's bulk volume in m3; "
                          "its vertical thickness is that over its area."));
  keys.push_back(text_key(release, &ReleaseSpec::thickness_raster, "release.thickness_raster", path,
                          "Raster of the source thickness in metres; nodata means zero."));
  keys.push_back(key(release, &ReleaseSpec::thickness_factor,
                     {"release.thickness_factor", number, "1", -1000, 1000,
                      "Multiplies the values of thickness_raster: -1 where depths count "
                      "downward."}));
  keys.push_back(text_key(release, &ReleaseSpec::crs, "release.crs", text,
                          "Coordinate system of the release file where it has none."));
  add_shapes(keys);
  keys.push_back(above_min(key(release, &ReleaseSpec::thickness_m,
                               {"release.thickness_m", uncertain, "m", 0, 2000,
                                "Thickness of a polygon, box, cylinder, or of the cap's thickest "
                                "point."})));
  keys.push_back(above_min(key(release, &ReleaseSpec::volume_m3,
                               {"release.volume_m3", uncertain, "m3", 0, no_limit,
                                "Bulk volume of the source; scales its thickness."})));
  keys.push_back(
      choice_key(release, &ReleaseSpec::surface, "release.surface",
                 "What the terrain shows: the bed under the source, or the surface before failure "
                 "from which the source is dug."));
  keys.push_back(
      choice_key(release, &ReleaseSpec::thickness, "release.thickness",
                 "How thicknesses were measured: vertical, or normal to the slope as snow and many "
                 "landslide surveys do; then each is divided by the cosine of the slope."));
  keys.push_back(choice_key(
      release, &ReleaseSpec::floor, "release.floor",
      "Floor of a pre_failure source: at the depth of its thickness everywhere, or "
      "tapered so that it comes out at the lower edge and the flanks; the volume stays."));
  keys.push_back(with_size(key(release, &ReleaseSpec::velocity_m_s,
                               {"release.velocity_m_s", number_list, "m s-1", -500, 500,
                                "Velocity of the source at the start: east, north, up. Columns "
                                "take what points along the slope."}),
                           3));
  keys.push_back(key(release, &ReleaseSpec::start_time_s,
                     {"release.start_time_s", uncertain, "s", 0, 1e5,
                      "When the release starts; 0 when absent. Until then it lies still; "
                      "depth_averaged."}));
  keys.push_back(text_key(release, &ReleaseSpec::start_time_attribute,
                          "release.start_time_attribute", text,
                          "Field of release.polygon that holds when each polygon starts, in "
                          "seconds; release.start_time_s is added to it."));
}

}  // namespace

void add_site_keys(std::vector<KeyInfo>& keys) {
  keys.push_back(text_key(scene, &Scenario::title, "title", ValueKind::text,
                          "One line that names the scene in reports."));
  add_terrain(keys);
  add_release(keys);
}

void add_site_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block(
      "terrain.window", "The part of a large raster that is read first.", terrain_window));
  blocks.push_back(optional_block("release.box", "A rectangular source.", release_box));
  blocks.push_back(
      optional_block("release.paraboloid", "A cap-shaped source.", release_paraboloid));
  blocks.push_back(
      optional_block("release.cylinder", "A round source of even thickness.", release_cylinder));
}

}  // namespace sturz::schema_rows
