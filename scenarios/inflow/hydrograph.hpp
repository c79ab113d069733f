// SPDX-License-Identifier: Apache-2.0
/// A discharge over time: linear between its rows, nothing before the first and after the last.
#pragma once

#include "engine/core/vec.hpp"

#include <string>
#include <vector>

namespace sturz {

struct Hydrograph {
  std::vector<double> time_s;          ///< rises strictly; two or more
  std::vector<double> discharge_m3_s;  ///< bulk, none negative
  std::vector<double> solid_fraction;  ///< of a mixture; empty: that of the scene
  bool operator==(const Hydrograph&) const = default;

  double end_s() const { return time_s.back(); }
  double peak_m3_s() const;
  double total_m3() const;
  double discharge(double time_s) const;
  /// NaN without that column.
  double solids(double time_s) const;
};

/// Its integral, to be asked both ways.
class HydrographVolume {
 public:
  explicit HydrographVolume(const Hydrograph&);
  double total_m3() const { return volume_.back(); }
  double until(double time_s) const;
  /// First time at which so much has passed; the last row's for more than all.
  double time_of(double volume_m3) const;

 private:
  const Hydrograph& hydrograph_;
  std::vector<double> volume_;  ///< up to each row [m^3]
};

/// Where and what one inflow is, from its files; in the order of the scenario's list.
struct InflowSource {
  std::string label;  ///< for messages: "inflow[0] (north gully)"
  Hydrograph hydrograph;
  std::vector<std::vector<Vec2>> lines;  ///< parts of a line in map coordinates; or
  std::vector<std::vector<Vec2>> rings;  ///< of a polygon, holes too
};

}  // namespace sturz
