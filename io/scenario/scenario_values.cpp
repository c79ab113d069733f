// SPDX-License-Identifier: Apache-2.0
#include "io/scenario/scenario_values.hpp"

#include "io/scenario/dam_nodes.hpp"
#include "io/scenario/distribution_nodes.hpp"
#include "io/scenario/flow_nodes.hpp"
#include "io/scenario/node_texts.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/schema/value_text.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <algorithm>
#include <array>

namespace sturz {
namespace {

using Kind = YamlNode::Kind;

KeyValue read_text_value(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  const auto text =
      read_text(key.path, key.kind == ValueKind::path ? file_name : "text", node, problems);
  return text ? KeyValue{*text} : KeyValue{};
}

KeyValue read_flag(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  if (node.kind == Kind::scalar && !node.quoted) {
    if (node.text == "true") return true;
    if (node.text == "false") return false;
  }
  add_mismatch(key.path, node, "true or false", "", problems);
  return {};
}

/// A number in whose place no distribution may stand; `hint` says so.
std::optional<double> read_fixed_number(const std::string& path, const YamlNode& node,
                                        const char* hint, FileProblems& problems) {
  if (node.kind != Kind::map) return read_number(path, node, "a number", problems);
  add_mismatch(path, node, "a plain number", hint, problems);
  return std::nullopt;
}

KeyValue read_plain_number(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  const auto number = read_fixed_number(
      key.path, node,
      "Only numbers of release, inflow, grains, basal, mixture, fluid, coupling, erosion and dams "
      "can be uncertain.",
      problems);
  return number ? KeyValue{*number} : KeyValue{};
}

KeyValue read_texts(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  if (node.kind != Kind::list) {
    add_mismatch(key.path, node, "a list, [...]", "", problems);
    return {};
  }
  std::vector<std::string> words;
  for (const auto& item : node.items) {
    if (item.kind == Kind::scalar)
      words.push_back(item.text);
    else
      add_mismatch(key.path, item, "a list of words", "", problems);
  }
  return words;
}

KeyValue read_number_map(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  if (node.kind != Kind::map) {
    add_mismatch(key.path, node, "{key/key: number, ...}", "", problems);
    return {};
  }
  std::map<std::string, double> numbers;
  bool good = true;
  for (const auto& entry : node.entries) {
    const auto number = read_number(key.path + ": " + entry.key, entry.value, "a number", problems);
    good = good && number;
    if (number) numbers[entry.key] = *number;
  }
  return good ? KeyValue{numbers} : KeyValue{};
}

KeyValue read_path_map(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  if (node.kind != Kind::map) {
    add_mismatch(key.path, node, "{name: file, ...}", "", problems);
    return {};
  }
  std::map<std::string, std::string> files;
  for (const auto& entry : node.entries)
    if (entry.value.kind == Kind::scalar)
      files[entry.key] = entry.value.text;
    else
      add_mismatch(key.path + ": " + entry.key, entry.value, "a file name", "", problems);
  return files.size() == node.entries.size() ? KeyValue{files} : KeyValue{};
}

KeyValue read_synthetic(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  if (node.kind != Kind::map || node.entries.size() != 1 ||
      node.entries.front().value.kind != Kind::map) {
    add_mismatch(key.path, node, "one shape, {plane: {cell_size_m: 5}}", "", problems);
    return {};
  }
  SyntheticTerrain terrain;
  const auto& [shape, at, numbers] = node.entries.front();
  terrain.shape = shape;
  bool good = true, has_cell = false;
  for (const auto& entry : numbers.entries) {
    const bool cell = entry.key == "cell_size_m";
    has_cell = has_cell || cell;
    const auto number =
        read_number(key.path + "." + shape + "." + entry.key, entry.value, "a number", problems);
    good = good && number;
    if (number) (cell ? terrain.cell_size_m : terrain.parameters[entry.key]) = *number;
  }
  if (!has_cell) {
    problems.push_back({at, key.path + "." + shape +
                                " (cell_size_m is missing). Add the size of "
                                "the ground's cells."});
    good = false;
  }
  return good ? KeyValue{terrain} : KeyValue{};
}

bool read_triple(const std::string& path, const YamlNode& node, std::array<double, 3>& out,
                 FileProblems& problems) {
  const auto numbers = read_numbers(path, node, problems);
  if (!numbers) return false;
  if (numbers->size() != 3) {
    add_mismatch(path, node, "three numbers, [x, y, z]", "", problems);
    return false;
  }
  std::copy(numbers->begin(), numbers->end(), out.begin());
  return true;
}

bool read_wall_liquid(const std::string& path, const YamlNode& node, WallSpec& wall,
                      FileProblems& problems) {
  const auto word = node.kind == Kind::scalar ? from_word<WallLiquid>(node.text) : std::nullopt;
  if (!word) add_mismatch(path, node, "slips or sticks", "", problems);
  wall.liquid = word.value_or(wall.liquid);
  return word.has_value();
}

bool read_wall(const std::string& path, const YamlNode& node, WallSpec& wall,
               FileProblems& problems) {
  if (node.kind != Kind::map) {
    add_mismatch(path, node, "a wall, {point_m: [x, y, z], normal: [x, y, z]}", "", problems);
    return false;
  }
  bool good = true;
  for (const char* name : {"point_m", "normal"}) {
    if (node.find(name)) continue;
    problems.push_back({node.at, path + " (" + name + " is missing). Add [x, y, z]."});
    good = false;
  }
  for (const auto& [name, at, value] : node.entries) {
    const std::string inner = path + "." + name;
    if (name == "point_m") {
      good = read_triple(inner, value, wall.point_m, problems) && good;
    } else if (name == "normal") {
      good = read_triple(inner, value, wall.normal, problems) && good;
    } else if (name == "friction_coefficient" || name == "remove_at_s") {
      const auto number = read_number(inner, value, "a number", problems);
      good = good && number;
      if (number && name == "remove_at_s") wall.remove_at_s = *number;
      if (number && name != "remove_at_s") wall.friction_coefficient = *number;
    } else if (name == "liquid") {
      good = read_wall_liquid(inner, value, wall, problems) && good;
    } else {
      problems.push_back({at, unknown_text(path, name,
                                           {"point_m", "normal", "friction_coefficient",
                                            "remove_at_s", "liquid"})});
      good = false;
    }
  }
  return good;
}

bool read_zone(const std::string& path, const YamlNode& node, BasalZone& zone,
               FileProblems& problems) {
  if (node.kind != Kind::map) {
    add_mismatch(path, node, "a zone, {polygon: plate.gpkg, friction_coefficient: 0.3}", "",
                 problems);
    return false;
  }
  const std::size_t before = problems.size();
  for (const auto& [name, at, value] : node.entries) {
    const std::string inner = path + "." + name;
    if (name == "polygon") {
      zone.polygon = read_text(inner, file_name, value, problems).value_or("");
    } else if (name == "layer") {
      zone.layer = read_text(inner, "text", value, problems).value_or("");
    } else if (const ZoneField* field = find_zone_field(name)) {
      KeyInfo key = basal_key(*field);
      key.path = inner;
      const KeyValue number = read_uncertain(key, value, problems);
      if (const auto* read = std::get_if<Uncertain>(&number)) zone.*field->value = *read;
    } else {
      auto known = zone_field_names();
      known.insert(known.begin(), {"polygon", "layer"});
      problems.push_back({at, unknown_text(path, name, known)});
    }
  }
  return problems.size() == before;
}

/// "time_s, distance_m, point_m [x, y]"
std::vector<std::string> field_names(const KeyInfo& key) {
  std::vector<std::string> names;
  for (const RecordField& field : key.fields) names.emplace_back(field.name);
  return names;
}

bool read_field(const std::string& path, const RecordField& field, const YamlNode& node,
                NumberRecord& record, FileProblems& problems) {
  if (field.size == 1) {
    const auto number = read_fixed_number(
        path, node, "An observation is a number with its standard deviation.", problems);
    if (number) record[field.name] = {*number};
    return number.has_value();
  }
  const auto numbers = read_numbers(path, node, problems);
  if (!numbers) return false;
  if (numbers->size() != field.size) {
    add_mismatch(path, node, "two numbers, [x, y]", "", problems);
    return false;
  }
  record[field.name] = *numbers;
  return true;
}

bool read_record(const KeyInfo& key, const std::string& path, const YamlNode& node,
                 NumberRecord& record, FileProblems& problems) {
  const std::size_t before = problems.size();
  if (node.kind != Kind::map) {
    add_mismatch(path, node, "numbers by name: " + comma_separated(field_names(key)), "", problems);
    return false;
  }
  for (const RecordField& field : key.fields)
    if (field.required && !node.find(field.name))
      problems.push_back({node.at, path + " (" + field.name + " is missing). Add it."});
  for (const auto& [name, at, value] : node.entries) {
    const auto field =
        std::find_if(key.fields.begin(), key.fields.end(),
                     [&, &wanted = name](const auto& f) { return f.name == wanted; });
    if (field == key.fields.end())
      problems.push_back({at, unknown_text(path, name, field_names(key))});
    else
      read_field(path + "." + name, *field, value, record, problems);
  }
  return problems.size() == before;
}

/// A list of maps, each read by `read_item`.
template <class Item, class ReadItem>
KeyValue read_items(const KeyInfo& key, const YamlNode& node, const char* expected,
                    ReadItem read_item, FileProblems& problems) {
  if (node.kind != Kind::list) {
    add_mismatch(key.path, node, expected, "", problems);
    return {};
  }
  std::vector<Item> items;
  bool good = true;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    std::string path = key.path;
    path.append("[").append(std::to_string(i)).append("]");
    good = read_item(path, node.items[i], items.emplace_back(), problems) && good;
  }
  return good ? KeyValue{items} : KeyValue{};
}

}  // namespace

KeyValue read_uncertain(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  Uncertain value;
  if (node.kind == Kind::map) {
    value.distribution = read_distribution(key.path, node, problems);
    return value.distribution ? KeyValue{value} : KeyValue{};
  }
  const auto number = read_number(key.path, node, "a number or a distribution", problems);
  if (!number) return {};
  return Uncertain(*number);
}

KeyValue read_value(const KeyInfo& key, const YamlNode& node, FileProblems& problems) {
  switch (key.kind) {
    case ValueKind::number:
      return read_plain_number(key, node, problems);
    case ValueKind::integer: {
      const auto number = read_integer(key.path, node, problems);
      return number ? KeyValue{static_cast<std::int64_t>(*number)} : KeyValue{};
    }
    case ValueKind::text:
    case ValueKind::path:
    case ValueKind::choice:
      return read_text_value(key, node, problems);
    case ValueKind::flag:
      return read_flag(key, node, problems);
    case ValueKind::uncertain:
      return read_uncertain(key, node, problems);
    case ValueKind::number_list: {
      const auto numbers = read_numbers(key.path, node, problems);
      return numbers ? KeyValue{*numbers} : KeyValue{};
    }
    case ValueKind::text_list:
      return read_texts(key, node, problems);
    case ValueKind::number_map:
      return read_number_map(key, node, problems);
    case ValueKind::path_map:
      return read_path_map(key, node, problems);
    case ValueKind::synthetic:
      return read_synthetic(key, node, problems);
    case ValueKind::wall_list:
      return read_items<WallSpec>(key, node, "a list of walls, [{point_m: .., normal: ..}]",
                                  read_wall, problems);
    case ValueKind::dam_list:
      return read_items<DamSpec>(key, node, "a list of dams, [{line: .., height_m: ..}]", read_dam,
                                 problems);
    case ValueKind::zone_list:
      return read_items<BasalZone>(key, node,
                                   "a list of zones, [{polygon: .., friction_coefficient: ..}]",
                                   read_zone, problems);
    case ValueKind::record_list:
      return read_items<NumberRecord>(
          key, node, "a list of measurements, [{..}, {..}]",
          [&key](const std::string& path, const YamlNode& item, NumberRecord& record,
                 FileProblems& found) { return read_record(key, path, item, record, found); },
          problems);
    case ValueKind::inflow_list:
      return read_items<InflowSpec>(key, node, "a list of sources, [{hydrograph: .., line_m: ..}]",
                                    read_inflow, problems);
    case ValueKind::gauge_points:
      return read_items<GaugeSpec>(key, node, "a list of points, [{name: .., at_m: [x, y]}]",
                                   read_gauge_point, problems);
    case ValueKind::gauge_lines:
      return read_items<GaugeSpec>(key, node,
                                   "a list of lines, [{name: .., points_m: [[x, y], ..]}]",
                                   read_gauge_line, problems);
  }
  return {};
}

}  // namespace sturz
