// SPDX-License-Identifier: Apache-2.0
/// The one table of scenario keys: reader, writer, validator, JSON Schema, sampling and `describe`
/// all walk it, so a key is added in one place.
#pragma once

#include "scenarios/scenario.hpp"

#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace sturz {

/// How a key's value is written.
enum class ValueKind {
  number,  ///< double
  integer,
  text,
  path,         ///< text, relative to the scenario file
  choice,       ///< text out of KeyInfo::choices
  flag,         ///< true | false
  uncertain,    ///< number, or a distribution in its place
  number_list,  ///< [a, b, ...]
  text_list,
  number_map,    ///< {text: number, ...}
  path_map,      ///< {text: file, ...}, relative to the scenario file
  synthetic,     ///< {shape: {cell_size_m: .., own numbers ..}}
  wall_list,     ///< [{point_m: .., normal: .., ...}, ...]
  dam_list,      ///< [{line: .., height_m: .., ...}, ...]
  zone_list,     ///< [{polygon: .., friction_coefficient: .., ...}, ...]
  inflow_list,   ///< [{hydrograph: .., line_m: [[x, y], ..], ...}, ...]
  gauge_points,  ///< [{name: .., at_m: [x, y]}, ...]
  gauge_lines,   ///< [{name: .., points_m: [[x, y], ..]}, ...]
  record_list,   ///< [{name: number or [x, y], ...}, ...], names out of KeyInfo::fields
};

/// Typed value of a key; which alternative is used follows from the kind.
using KeyValue =
    std::variant<std::monostate, double, std::int64_t, std::string, bool, Uncertain,
                 std::vector<double>, std::vector<std::string>, std::map<std::string, double>,
                 std::map<std::string, std::string>, SyntheticTerrain, std::vector<WallSpec>,
                 std::vector<DamSpec>, std::vector<BasalZone>, std::vector<InflowSpec>,
                 std::vector<GaugeSpec>, std::vector<NumberRecord>>;

/// One name that an entry of a record_list may hold.
struct RecordField {
  const char* name;
  const char* units;
  double min, max;
  std::size_t size = 1;  ///< numbers: 1, or 2 for a point
  bool required = false;
};

struct KeyInfo {
  std::string path;  ///< dotted, e.g. "basal.friction_coefficient"
  ValueKind kind = ValueKind::number;
  std::string units;                                      ///< "m", "kg m-3", "1", "" for text
  double min = -std::numeric_limits<double>::infinity();  ///< inclusive, every number of the value
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices;              ///< choice, text_list: the words that are known
  int list_size = 0;                             ///< number_list: exact length, 0 = any
  std::string help;                              ///< one sentence
  std::function<KeyValue(const Scenario&)> get;  ///< monostate: absent
  std::function<void(Scenario&, const KeyValue&)> set;
  bool above_min = false;                  ///< min itself is outside
  bool required = false;                   ///< must stand in every file
  std::vector<std::string> later_choices;  ///< words that a later version will know
  /// Words of earlier versions and what they are called now.
  std::map<std::string, std::string> renamed_choices = {};
  std::vector<RecordField> fields = {};  ///< record_list
};

/// All keys in file order.
std::span<const KeyInfo> schema();
/// nullptr for an unknown path.
const KeyInfo* find_key(const std::string& path);

/// A group of keys whose mere presence says something, e.g. "grains".
struct BlockInfo {
  std::string path;
  std::string help;
  std::function<bool(const Scenario&)> present;
  std::function<void(Scenario&)> make;  ///< puts the block there with its defaults
};
/// The optional blocks, in file order. Every other group of keys is always there.
std::span<const BlockInfo> optional_blocks();
/// True for "grains", "grains.friction", "numerics", ...: some key lies below it.
bool is_block(const std::string& path);
/// Names one level below a block ("" = top level), in file order, each once.
std::vector<std::string> names_in_block(const std::string& block);

/// A key or block that design and documents know and this version cannot do yet.
struct LaterKey {
  std::string path;
  std::string what;  ///< "the pore fluid as a particle set of its own"
};
std::span<const LaterKey> later_keys();

/// Calls `visit` with every file name that a value holds: that of a path, those of zones.
void for_each_path(const KeyInfo&, KeyValue&, const std::function<void(std::string&)>& visit);

/// "in 0..60", "> 0", ">= 0", or empty when any number will do.
std::string range_text(const KeyInfo&);

/// The row of a path that a design may name: a key, or a number of a zone of the bed or an inflow.
std::optional<KeyInfo> key_of_number(const std::string& path);

/// One uncertain value of a scenario.
struct UncertainKey {
  std::string path;
  std::string units;
  Distribution distribution;
};
/// Every key whose value is a distribution, in schema order: the columns of an ensemble's design.
std::vector<UncertainKey> uncertain_keys(const Scenario&);
/// The same scene with `value` in place of the number or distribution at `path` (kind uncertain
/// or number, or "basal.zones[2].friction_coefficient"). Throws SetupError on an unknown path.
Scenario with_value(Scenario, const std::string& path, double value);

}  // namespace sturz
