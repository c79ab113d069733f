// SPDX-License-Identifier: Apache-2.0
/// Items of the lists `inflow`, `gauges.points`, `gauges.lines` out of YAML nodes.
#pragma once

#include "io/scenario/number_nodes.hpp"
#include "scenarios/scenario.hpp"

#include <string>

namespace sturz {

/// \return false where something is wrong, which is in `problems` then
bool read_inflow(const std::string& path, const YamlNode&, InflowSpec&, FileProblems&);
bool read_gauge_point(const std::string& path, const YamlNode&, GaugeSpec&, FileProblems&);
bool read_gauge_line(const std::string& path, const YamlNode&, GaugeSpec&, FileProblems&);

}  // namespace sturz
