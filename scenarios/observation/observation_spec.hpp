// SPDX-License-Identifier: Apache-2.0
/// What was seen or measured of the event that a scene is about: plain data of the block
/// `observation`. Members are scored against it; none depends on it.
#pragma once

#include "scenarios/choices.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// One number with its standard deviation, both in the unit of the key.
struct MeasuredSpec {
  std::optional<double> value, sd;
  bool operator==(const MeasuredSpec&) const = default;
};

/// One entry of a list of measurements: numbers by name, points as two numbers.
using NumberRecord = std::map<std::string, std::vector<double>>;

struct ObservationSpec {
  std::string outline;  ///< polygons of what was passed over, any OGR layer
  std::string outline_layer;
  std::optional<double> outline_sd_m;
  std::string deposit;  ///< polygons of what lies there at the end
  std::string deposit_layer;
  std::optional<double> deposit_sd_m;
  std::string deposit_thickness;  ///< raster, read as `thickness_sign` says
  ThicknessSign thickness_sign = ThicknessSign::thickness;
  bool mask_erosion = true;  ///< of an elevation difference: cells below zero are not compared
  std::optional<double> thickness_sd_m;
  std::string farthest_point;                             ///< layer of one point ...
  std::optional<std::array<double, 2>> farthest_point_m;  ///< ... or its map coordinates
  std::optional<double> farthest_point_sd_m;
  std::optional<MeasuredSpec> runout_m;      ///< crown to toe, horizontal
  std::optional<MeasuredSpec> h_over_l;      ///< tangent of the travel angle, crown to toe
  std::optional<MeasuredSpec> com_travel_m;  ///< horizontal, of the centre of mass
  std::optional<MeasuredSpec> volume_m3;     ///< of the deposit
  std::optional<MeasuredSpec> area_m2;       ///< passed over
  std::vector<NumberRecord> fronts;          ///< time_s, distance_m | point_m, sd_m | sd_s
  std::vector<NumberRecord> speeds;          ///< point_m, speed_m_s, sd_m_s
  std::optional<double> threshold_m;         ///< thickness from which on a cell counts as covered
  std::string thalweg;                       ///< layer of one line down the path
  std::string crs;                           ///< of those of these files that have none
  bool operator==(const ObservationSpec&) const = default;
};

}  // namespace sturz
