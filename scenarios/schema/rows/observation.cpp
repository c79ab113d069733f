// SPDX-License-Identifier: Apache-2.0
// Keys of what was observed: observation.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto observation = blocks::at<&Scenario::observation>;

/// A file, or a word on it.
void add_text(std::vector<KeyInfo>& keys, std::string ObservationSpec::*member, const char* path,
              ValueKind kind, const char* help) {
  keys.push_back(text_key(observation, member, path, kind, help));
}

/// A standard deviation, or another length above 0.
void add_length(std::vector<KeyInfo>& keys, std::optional<double> ObservationSpec::*member,
                const char* path, double max, const char* help) {
  keys.push_back(above_min(key(observation, member, {path, ValueKind::number, "m", 0, max, help})));
}

struct MeasuredRow {
  const char *value_path, *sd_path, *units;
  const char *help, *sd_help;
};

/// A number and its standard deviation, two keys of one inner block.
template <auto member>
void add_measured(std::vector<KeyInfo>& keys, const MeasuredRow& row) {
  constexpr auto inner = blocks::at<&Scenario::observation, member>;
  keys.push_back(
      above_min(key(inner, &MeasuredSpec::value,
                    {row.value_path, ValueKind::number, row.units, 0, no_limit, row.help})));
  keys.push_back(
      above_min(key(inner, &MeasuredSpec::sd,
                    {row.sd_path, ValueKind::number, row.units, 0, no_limit, row.sd_help})));
}

void add_outlines(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using O = ObservationSpec;
  add_text(keys, &O::outline, "observation.outline", path,
           "Polygon layer of what the event passed over, source included; compared with the cells "
           "that a member reached at any time, and drawn over the maps.");
  add_text(keys, &O::outline_layer, "observation.outline_layer", text,
           "Layer inside the file of outline; the first when absent.");
  add_length(keys, &O::outline_sd_m, "observation.outline_sd_m", 1e5,
             "Standard deviation of where outline was drawn, across it.");
  add_text(keys, &O::deposit, "observation.deposit", path,
           "Polygon layer of what lay there at the end; compared with a member's mass at rest.");
  add_text(keys, &O::deposit_layer, "observation.deposit_layer", text,
           "Layer inside the file of deposit; the first when absent.");
  add_length(keys, &O::deposit_sd_m, "observation.deposit_sd_m", 1e5,
             "Standard deviation of where deposit was drawn, across it.");
}

void add_thickness(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using O = ObservationSpec;
  add_text(
      keys, &O::deposit_thickness, "observation.deposit_thickness", path,
      "Raster of the deposit's vertical thickness, or an elevation difference (thickness_sign); "
      "nodata was not measured. Compared with a member's mass at rest.");
  keys.push_back(choice_key(
      observation, &O::thickness_sign, "observation.thickness_sign",
      "What deposit_thickness holds: thickness; or the ground's rise (after - before) or fall "
      "(before - after), a net change that is not compared where the source was."));
  keys.push_back(
      key(observation, &O::mask_erosion,
          {"observation.mask_erosion", flag, "", -no_limit, no_limit,
           "Leave out cells of an elevation difference where the ground fell; false needs "
           "a scene with erosion, whose net change is then compared."}));
  add_length(keys, &O::thickness_sd_m, "observation.thickness_sd_m", 1e3,
             "Standard deviation of deposit_thickness.");
}

void add_numbers(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using O = ObservationSpec;
  add_text(keys, &O::farthest_point, "observation.farthest_point", path,
           "Layer with one point: the farthest that the event reached.");
  keys.push_back(with_size(key(observation, &O::farthest_point_m,
                               {"observation.farthest_point_m", number_list, "m", -1e8, 1e8,
                                "The same point as map coordinates of the terrain, [x, y]."}),
                           2));
  add_length(keys, &O::farthest_point_sd_m, "observation.farthest_point_sd_m", 1e5,
             "Standard deviation of the farthest point along the path.");
  add_measured<&O::runout_m>(keys,
                             {"observation.runout_m.value", "observation.runout_m.sd", "m",
                              "Horizontal length from the crown to the toe of the deposit, L.",
                              "Its standard deviation."});
  add_measured<&O::h_over_l>(
      keys, {"observation.h_over_l.value", "observation.h_over_l.sd", "1",
             "Fall from crown to toe over that length, H/L.", "Its standard deviation."});
  add_measured<&O::com_travel_m>(
      keys, {"observation.com_travel_m.value", "observation.com_travel_m.sd", "m",
             "Horizontal travel of the centre of mass.", "Its standard deviation."});
  add_measured<&O::volume_m3>(
      keys, {"observation.volume_m3.value", "observation.volume_m3.sd", "m3",
             "Volume of the deposit on the known ground, that in the source included.",
             "Its standard deviation."});
  add_measured<&O::area_m2>(
      keys, {"observation.area_m2.value", "observation.area_m2.sd", "m2",
             "Area that was passed over, that of the source included.", "Its standard deviation."});
}

/// Widest coordinates that a map has.
constexpr double anywhere = 1e8;

void add_lists(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using O = ObservationSpec;
  KeyInfo fronts =
      key(observation, &O::fronts,
          {"observation.fronts", record_list, "", -no_limit, no_limit,
           "Where the front was when: time_s, with distance_m (along thalweg, else straight from "
           "the source's centre) or point_m [x, y], and sd_m of the place or sd_s of the time."});
  fronts.fields = {{"time_s", "s", 0, 1e7, 1, true},
                   {"distance_m", "m", 0, 1e7},
                   {"point_m", "m", -anywhere, anywhere, 2},
                   {"sd_m", "m", 1e-6, 1e5},
                   {"sd_s", "s", 1e-6, 1e6}};
  keys.push_back(std::move(fronts));
  KeyInfo speeds = key(observation, &O::speeds,
                       {"observation.speeds", record_list, "", -no_limit, no_limit,
                        "Largest speed at points, say from superelevation: point_m [x, y], "
                        "speed_m_s, sd_m_s."});
  speeds.fields = {{"point_m", "m", -anywhere, anywhere, 2, true},
                   {"speed_m_s", "m s-1", 0, 500, 1, true},
                   {"sd_m_s", "m s-1", 1e-6, 500, 1, true}};
  keys.push_back(std::move(speeds));
}

void add_reading(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using O = ObservationSpec;
  add_length(keys, &O::threshold_m, "observation.threshold_m", 100,
             "Thickness from which on a cell of a member counts as covered. When absent 0.1, "
             "and at least a tenth of the spacing in full_stress.");
  add_text(keys, &O::thalweg, "observation.thalweg", path,
           "Layer with one line down the path, source first: distances are then along it, and "
           "profiles along it are scored.");
  add_text(keys, &O::crs, "observation.crs", text,
           "Coordinate system of those files of observation that have none.");
}

}  // namespace

void add_observation_keys(std::vector<KeyInfo>& keys) {
  add_outlines(keys);
  add_thickness(keys);
  add_numbers(keys);
  add_lists(keys);
  add_reading(keys);
}

void add_observation_blocks(std::vector<BlockInfo>& blocks) {
  using O = ObservationSpec;
  blocks.push_back(optional_block("observation",
                                  "What was observed of the event: members are scored against it.",
                                  observation));
  const auto measured = [&blocks](const char* path, const auto& block) {
    blocks.push_back(optional_block(path, "A number and its standard deviation.", block));
  };
  measured("observation.runout_m", sturz::blocks::at<&Scenario::observation, &O::runout_m>);
  measured("observation.h_over_l", sturz::blocks::at<&Scenario::observation, &O::h_over_l>);
  measured("observation.com_travel_m", sturz::blocks::at<&Scenario::observation, &O::com_travel_m>);
  measured("observation.volume_m3", sturz::blocks::at<&Scenario::observation, &O::volume_m3>);
  measured("observation.area_m2", sturz::blocks::at<&Scenario::observation, &O::area_m2>);
}

}  // namespace sturz::schema_rows
