// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/flow_nodes.hpp"

#include "io/scenario/node_texts.hpp"
#include "io/scenario/scenario_values.hpp"
#include "scenarios/schema/inflow_fields.hpp"

#include <array>
#include <map>

namespace sturz {
namespace {

using Kind = YamlNode::Kind;
using Corners = std::vector<std::array<double, 2>>;

void read_pair(const std::string& path, const YamlNode& node, Corners& out,
               FileProblems& problems) {
  const auto numbers = read_numbers(path, node, problems);
  if (!numbers) return;
  if (numbers->size() != 2)
    add_mismatch(path, node, "two numbers, [x, y]", "", problems);
  else
    out.push_back({(*numbers)[0], (*numbers)[1]});
}

void read_corners(const std::string& path, const YamlNode& node, Corners& out,
                  FileProblems& problems) {
  if (node.kind != Kind::list)
    return add_mismatch(path, node, "a list of corners, [[x, y], [x, y]]", "", problems);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    read_pair(path + "[" + std::to_string(i) + "]", node.items[i], out, problems);
}

bool is_map(const std::string& path, const YamlNode& node, const char* expected,
            FileProblems& problems) {
  if (node.kind == Kind::map) return true;
  add_mismatch(path, node, expected, "", problems);
  return false;
}

bool read_gauge(const std::string& path, const YamlNode& node, const char* place, GaugeSpec& gauge,
                FileProblems& problems) {
  const std::size_t before = problems.size();
  for (const auto& [name, at, value] : node.entries) {
    const std::string inner = path + "." + name;
    if (name == "name")
      gauge.name = read_text(inner, "text", value, problems).value_or("");
    else if (name != place)
      problems.push_back({at, unknown_text(path, name, {"name", place})});
    else if (name == "at_m")
      read_pair(inner, value, gauge.corners_m, problems);
    else
      read_corners(inner, value, gauge.corners_m, problems);
  }
  return problems.size() == before;
}

}  // namespace

bool read_inflow(const std::string& path, const YamlNode& node, InflowSpec& source,
                 FileProblems& problems) {
  if (!is_map(path, node, "a source, {hydrograph: flood.csv, line_m: [[x, y], [x, y]]}", problems))
    return false;
  static const std::map<std::string, std::string InflowSpec::*> texts{
      {"name", &InflowSpec::name},   {"hydrograph", &InflowSpec::hydrograph},
      {"line", &InflowSpec::line},   {"polygon", &InflowSpec::polygon},
      {"layer", &InflowSpec::layer}, {"crs", &InflowSpec::crs}};
  const std::size_t before = problems.size();
  for (const auto& [name, at, value] : node.entries) {
    const std::string inner = path + "." + name;
    if (const auto text = texts.find(name); text != texts.end()) {
      const bool file = name == "hydrograph" || name == "line" || name == "polygon";
      source.*text->second =
          read_text(inner, file ? file_name : "text", value, problems).value_or("");
    } else if (name == "line_m") {
      read_corners(inner, value, source.line_m, problems);
    } else if (const InflowField* field = find_inflow_field(name)) {
      KeyInfo key = inflow_key(0, *field);
      key.path = inner;
      const KeyValue number = read_uncertain(key, value, problems);
      if (const auto* read = std::get_if<Uncertain>(&number)) source.*field->value = *read;
    } else {
      std::vector<std::string> known{"hydrograph", "line_m", "line", "polygon",
                                     "layer",      "crs",    "name"};
      for (const auto& each : inflow_fields) known.emplace_back(each.name);
      problems.push_back({at, unknown_text(path, name, known)});
    }
  }
  return problems.size() == before;
}

bool read_gauge_point(const std::string& path, const YamlNode& node, GaugeSpec& gauge,
                      FileProblems& problems) {
  return is_map(path, node, "a point, {name: bridge, at_m: [x, y]}", problems) &&
         read_gauge(path, node, "at_m", gauge, problems);
}

bool read_gauge_line(const std::string& path, const YamlNode& node, GaugeSpec& gauge,
                     FileProblems& problems) {
  return is_map(path, node, "a line, {name: road, points_m: [[x, y], [x, y]]}", problems) &&
         read_gauge(path, node, "points_m", gauge, problems);
}

}  // namespace sturz
