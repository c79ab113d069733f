// SPDX-License-Identifier: Apache-2.0
// Keys of what enters and what is followed over time: inflow, gauges.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto gauges = blocks::at<&Scenario::gauges>;

}  // namespace

void add_inflow_keys(std::vector<KeyInfo>& keys) {
  keys.push_back(key(blocks::scene, &Scenario::inflow,
                     {"inflow", ValueKind::inflow_list, "", -no_limit, no_limit,
                      "Mass that enters over time: a list of sources, each with a hydrograph and a "
                      "line or polygon; depth_averaged."}));
}

void add_gauge_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(key(gauges, &GaugesSpec::interval_s,
                     {"gauges.interval_s", number, "s", 0.01, 3600,
                      "Between two instants at which gauges are written."}));
  keys.push_back(key(gauges, &GaugesSpec::points,
                     {"gauges.points", gauge_points, "", -no_limit, no_limit,
                      "Named points, {name: bridge, at_m: [x, y]}: thickness, speed, momentum flux "
                      "over time."}));
  keys.push_back(key(gauges, &GaugesSpec::lines,
                     {"gauges.lines", gauge_lines, "", -no_limit, no_limit,
                      "Named lines, {name: road, points_m: [[x, y], [x, y]]}: discharge and volume "
                      "that passed over time."}));
  keys.push_back(text_key(gauges, &GaugesSpec::file, "gauges.file", path,
                          "Layer of points or lines, any format that OGR reads, instead of or "
                          "beside those in the file."));
  keys.push_back(text_key(gauges, &GaugesSpec::layer, "gauges.layer", text,
                          "Layer inside gauges.file; the first when absent."));
  keys.push_back(text_key(gauges, &GaugesSpec::name_attribute, "gauges.name_attribute", text,
                          "Field of gauges.file that holds the names."));
  keys.push_back(text_key(gauges, &GaugesSpec::crs, "gauges.crs", text,
                          "Coordinate system of gauges.file where it has none."));
}

void add_gauge_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(
      optional_block("gauges", "Points and lines where the flow is followed over time.", gauges));
}

}  // namespace sturz::schema_rows
