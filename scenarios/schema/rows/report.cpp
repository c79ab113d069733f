// SPDX-License-Identifier: Apache-2.0
// Keys of the page: report.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {

void add_report_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using R = ReportSpec;
  constexpr auto report = blocks::at<&Scenario::report>;
  keys.push_back(text_key(report, &R::language, "report.language", text,
                          "Language of the page: en or de. Numbers follow it; file names do not."));
  keys.push_back(key(report, &R::overlays,
                     {"report.overlays", path_map, "", -no_limit, no_limit,
                      "Layers of points, lines or polygons that the page draws over its maps, each "
                      "under its name: {Roads: roads.gpkg, Houses: houses.geojson}."}));
  keys.push_back(key(report, &R::animation,
                     {"report.animation", flag, "", -no_limit, no_limit,
                      "Keep the flow thickness over time of a run, or of the ensemble's member of "
                      "middle runout, which is computed once more; the page plays it in 3-D."}));
  keys.push_back(text_key(report, &R::orthophoto, "report.orthophoto", path,
                          "Raster of red, green and blue that the page can draw below its maps."));
}

}  // namespace sturz::schema_rows
