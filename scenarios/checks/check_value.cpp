// SPDX-License-Identifier: Apache-2.0
// Checks of one value by itself.
#include "scenarios/checks/distribution_check.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/inflow_fields.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/schema/unit_hint.hpp"
#include "scenarios/schema/value_text.hpp"
#include "scenarios/schema/zone_fields.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sturz {
namespace {

std::string sentence(const std::string& text) { return text.empty() ? "" : " " + text; }

bool in_range(const KeyInfo& key, double v) {
  return std::isfinite(v) && (key.above_min ? v > key.min : v >= key.min) && v <= key.max;
}

std::string must_be(const KeyInfo& key) {
  const std::string range = range_text(key);
  return range.empty() ? "must be finite" : "must be " + range;
}

/// A scalar of any numeric kind.
struct Checker {
  const KeyInfo& key;
  std::vector<Problem>& problems;

  void add(const std::string& message) const { problems.push_back({key.path, message}); }
  void out_of_range(const std::string& shown, double v) const {
    add(key.path + " = " + shown + " (" + must_be(key) + ")." + sentence(unit_hint(key, v)));
  }

  void operator()(std::monostate) const {}
  void operator()(bool) const {}
  void operator()(double v) const {
    if (!in_range(key, v)) out_of_range(number_text(v), v);
  }
  void operator()(std::int64_t v) const {
    if (!in_range(key, static_cast<double>(v)))
      out_of_range(std::to_string(v), static_cast<double>(v));
  }
  void operator()(const Uncertain& v) const {
    if (!v.distribution) return (*this)(v.value);
    const std::string shown = key.path + " = " + distribution_text(*v.distribution) + " (";
    const auto wrong = parameter_problems(*v.distribution);
    for (const auto& clause : wrong) add(shown + clause + ").");
    if (wrong.empty()) check_support(*v.distribution, shown);
  }
  void operator()(const std::vector<double>& v) const {
    for (const double number : v)
      if (!in_range(key, number)) return out_of_range(value_text(v), number);
    if (key.list_size != 0 && static_cast<int>(v.size()) != key.list_size)
      add(key.path + " = " + value_text(v) + " (must hold " + std::to_string(key.list_size) +
          " numbers).");
  }
  void operator()(const std::string& v) const {
    if (key.kind == ValueKind::choice) check_word(v);
  }
  void operator()(const std::vector<std::string>& v) const {
    std::set<std::string> seen;
    for (const auto& word : v) {
      check_word(word);
      if (!seen.insert(word).second)
        add(key.path + " = " + value_text(v) + " (" + word + " stands there twice).");
    }
  }
  void operator()(const std::map<std::string, double>& v) const {
    for (const auto& [name, number] : v)
      if (!in_range(key, number))
        add(key.path + ": " + name + " = " + number_text(number) + " (" + must_be(key) + ").");
  }
  void operator()(const std::map<std::string, std::string>& v) const {
    for (const auto& [name, file] : v)
      if (name.empty() || file.empty())
        add(key.path + " (every entry needs a name and a file: {Roads: roads.gpkg}).");
  }
  void operator()(const SyntheticTerrain& v) const;
  void operator()(const std::vector<WallSpec>& v) const;
  void operator()(const std::vector<DamSpec>& v) const;
  void operator()(const std::vector<BasalZone>& v) const;
  void operator()(const std::vector<NumberRecord>& v) const;
  void operator()(const std::vector<InflowSpec>& v) const;
  void operator()(const std::vector<GaugeSpec>& v) const;
  void corners(const std::string& path, const std::vector<std::array<double, 2>>& v) const;

  void check_support(const Distribution& d, const std::string& shown) const;
  void check_word(const std::string& word) const;
};

/// Some kinds have no min and max of their own to cut them with.
bool can_truncate(const Distribution& d) {
  return d.kind == Distribution::Kind::normal || d.kind == Distribution::Kind::lognormal;
}

void Checker::check_support(const Distribution& d, const std::string& shown) const {
  const auto [low, high] = support(d);
  // A density that only touches an excluded end (lognormal at 0) never draws it.
  const bool touches = can_truncate(d) && low == key.min;
  const bool low_good = touches || (std::isinf(low) ? std::isinf(key.min) : in_range(key, low));
  const bool high_good = std::isinf(high) ? std::isinf(key.max) : in_range(key, high);
  if (low_good && high_good) return;
  std::string range = "its values reach from " + number_text(low) + " to " + number_text(high) +
                      " but " + must_be(key) + ").";
  if (can_truncate(d)) {
    range += " Truncate it:";
    if (!low_good) range += " min: " + number_text(key.min);
    if (!high_good) range += std::string(low_good ? "" : ",") + " max: " + number_text(key.max);
    range += ".";
  } else {
    range += sentence(unit_hint(key, low_good ? high : low));
  }
  add(shown + range);
}

void Checker::check_word(const std::string& word) const {
  const auto has = [&](const std::vector<std::string>& words) {
    for (const auto& w : words)
      if (w == word) return true;
    return false;
  };
  if (has(key.choices)) return;
  const std::string shown = key.path + " = " + quoted_text(word) + " (";
  if (has(key.later_choices))
    return add(shown +
               "not available in this version). Available: " + comma_separated(key.choices) + ".");
  const auto renamed = key.renamed_choices.find(word);
  if (renamed != key.renamed_choices.end())
    return add(shown + "has a new name in this version). Write " + renamed->second + ".");
  const std::string near = nearest_name(word, key.choices);
  add(shown + "must be one of " + comma_separated(key.choices) + ")." +
      sentence(near.empty() ? "" : "Did you mean " + near + "?"));
}

KeyInfo part(const KeyInfo& whole, const std::string& name, const std::string& units, double min,
             double max) {
  KeyInfo info;
  info.path = whole.path + "." + name;
  info.units = units;
  info.min = min;
  info.max = max;
  return info;
}

std::string units_of(const std::string& name) {
  const auto ends = [&](const char* tail) { return name.ends_with(tail); };
  return ends("_deg") ? "degree" : ends("_m3") ? "m3" : ends("_m") ? "m" : "1";
}

void Checker::operator()(const SyntheticTerrain& v) const {
  const auto shapes = synthetic_shapes();
  if (std::find(shapes.begin(), shapes.end(), v.shape) == shapes.end()) {
    const std::string near = nearest_name(v.shape, shapes);
    return add(key.path + " = " + quoted_text(v.shape) + " (must be one of " +
               comma_separated(shapes) + ")." +
               sentence(near.empty() ? "" : "Did you mean " + near + "?"));
  }
  const auto cell =
      part(key, v.shape + ".cell_size_m", "m", min_synthetic_cell_m, max_synthetic_cell_m);
  Checker{cell, problems}(v.cell_size_m);
  const auto known = shape_parameters(v.shape);
  std::vector<std::string> names{"cell_size_m"};
  for (const auto& p : known) names.emplace_back(p.name);
  for (const auto& [name, number] : v.parameters) {
    const auto found =
        std::find_if(known.begin(), known.end(),
                     [&, &wanted = name](const ShapeParameter& p) { return p.name == wanted; });
    if (found == known.end()) {
      const std::string near = nearest_name(name, names);
      add(key.path + "." + v.shape + "." + name + " (unknown key). " +
          (near.empty() ? "Known here: " + comma_separated(names) + "."
                        : "Did you mean " + near + "?"));
      continue;
    }
    const auto own = part(key, v.shape + "." + name, units_of(name), found->min, found->max);
    Checker{own, problems}(number);
  }
}

std::string item_path(const KeyInfo& list, std::size_t i) {
  return list.path + "[" + std::to_string(i) + "]";
}

void Checker::operator()(const std::vector<WallSpec>& v) const {
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto& wall = v[i];
    KeyInfo whole = key;
    whole.path = item_path(key, i);
    const auto point = part(whole, "point_m", "m", -1e8, 1e8);
    for (const double x : wall.point_m) Checker{point, problems}(x);
    double length = 0;
    for (const double n : wall.normal) length += n * n;
    if (!(length > 0) || !std::isfinite(length))
      add(whole.path +
          ".normal = " + value_text(std::vector<double>(wall.normal.begin(), wall.normal.end())) +
          " (must not be zero). It points into the free side of the wall.");
    const auto friction = part(whole, "friction_coefficient", "1", 0, 2);
    Checker{friction, problems}(wall.friction_coefficient);
    const auto removal = part(whole, "remove_at_s", "s", 0, 1e5);
    if (wall.remove_at_s) Checker{removal, problems}(*wall.remove_at_s);
  }
}

void Checker::operator()(const std::vector<DamSpec>& v) const {
  if (v.size() > most_dams)
    add(key.path + " = " + std::to_string(v.size()) + " dams (must be at most " +
        std::to_string(most_dams) + "). Put lines of equal shape into one layer.");
  for (std::size_t i = 0; i < v.size(); ++i) {
    KeyInfo whole = key;
    whole.path = item_path(key, i);
    for (const DamField& field : dam_fields) {
      const KeyInfo limits = dam_key(i, field);
      if (const auto& number = v[i].*field.value) Checker{limits, problems}(*number);
    }
    for (const DamNumber& number : dam_numbers) {
      const auto limits = part(whole, number.name, number.units, number.min, number.max);
      Checker{limits, problems}(v[i].*number.value);
    }
    const auto corner = part(whole, "points_m", "m", -1e8, 1e8);
    for (const auto& [x, y] : v[i].points_m)
      Checker{corner, problems}(x), Checker{corner, problems}(y);
    if (v[i].points_m.size() == 1)
      add(corner.path + " (a line has two corners or more). Give [[x, y], [x, y]].");
    if (v[i].points_m.size() > most_dam_corners)
      add(corner.path + " = " + std::to_string(v[i].points_m.size()) +
          " corners (must be at most " + std::to_string(most_dam_corners) +
          "). Put it into a file.");
  }
}

void Checker::operator()(const std::vector<NumberRecord>& v) const {
  for (std::size_t i = 0; i < v.size(); ++i)
    for (const RecordField& field : key.fields) {
      KeyInfo whole = key;
      whole.path = item_path(key, i);
      const auto own = part(whole, field.name, field.units, field.min, field.max);
      const auto found = v[i].find(field.name);
      if (found == v[i].end()) continue;
      for (const double number : found->second) Checker{own, problems}(number);
    }
}

void Checker::operator()(const std::vector<BasalZone>& v) const {
  if (v.size() > most_basal_zones)
    add(key.path + " = " + std::to_string(v.size()) + " zones (must be at most " +
        std::to_string(most_basal_zones) + "). Put polygons with equal values into one layer.");
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string path = item_path(key, i);
    bool gives_any = false;
    for (const auto& field : zone_fields) {
      const auto& number = v[i].*field.value;
      if (!number) continue;
      gives_any = true;
      const KeyInfo limits = zone_key(i, field);
      Checker{limits, problems}(*number);
    }
    if (v[i].polygon.empty())
      add(path + " (polygon is missing). Name the file that outlines the zone.");
    if (!gives_any)
      add(path + " (gives no value). Give it some of " + comma_separated(zone_field_names()) + ".");
  }
}

/// Of a line in map coordinates.
void Checker::corners(const std::string& path, const std::vector<std::array<double, 2>>& v) const {
  KeyInfo limits = key;
  limits.path = path;
  limits.units = "m", limits.min = -1e8, limits.max = 1e8;
  double length = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    Checker{limits, problems}(v[i][0]);
    Checker{limits, problems}(v[i][1]);
    if (i > 0) length += std::hypot(v[i][0] - v[i - 1][0], v[i][1] - v[i - 1][1]);
  }
  if (v.size() > most_corners)
    add(path + " = " + std::to_string(v.size()) + " corners (must be at most " +
        std::to_string(most_corners) + "). Put it into a file.");
  if (v.size() > 1 && !(length > 0))
    add(path + " (has no length: its corners are one place). Give two different ones.");
}

void Checker::operator()(const std::vector<InflowSpec>& v) const {
  if (v.size() > most_inflows)
    add(key.path + " = " + std::to_string(v.size()) + " sources (must be at most " +
        std::to_string(most_inflows) + "). Put lines with one hydrograph into one layer.");
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string path = item_path(key, i);
    for (const auto& field : inflow_fields)
      if (const auto& number = v[i].*field.value) {
        const KeyInfo limits = inflow_key(i, field);
        Checker{limits, problems}(*number);
      }
    if (v[i].hydrograph.empty())
      add(path + " (hydrograph is missing). Name a CSV with the columns time_s, discharge_m3_s.");
    const int places = !v[i].line.empty() + !v[i].polygon.empty() + !v[i].line_m.empty();
    if (places != 1)
      add(path + (places == 0
                      ? " (where does it enter?). Give one of line_m, line, polygon."
                      : " (more than one place: line_m, line, polygon). Keep one of them."));
    if (v[i].line_m.size() == 1)
      add(path + ".line_m (one corner is no line). Give two or more, [[x, y], [x, y]].");
    corners(path + ".line_m", v[i].line_m);
    const bool file = !v[i].line.empty() || !v[i].polygon.empty();
    if (!file && !v[i].layer.empty())
      add(path + ".layer (there is no file with layers). Remove it or name line or polygon.");
    if (!file && !v[i].crs.empty())
      add(path + ".crs (there is no file that it is for). Remove it.");
  }
}

void Checker::operator()(const std::vector<GaugeSpec>& v) const {
  const bool lines = key.kind == ValueKind::gauge_lines;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string path = item_path(key, i);
    if (v[i].name.empty()) add(path + " (name is missing). It names the gauge in tables.");
    if (lines && v[i].corners_m.size() < 2)
      add(path + ".points_m (a line has two corners or more). Give [[x, y], [x, y]].");
    if (!lines && v[i].corners_m.size() != 1)
      add(path + " (at_m is missing). Give [x, y] in map coordinates.");
    corners(path + (lines ? ".points_m" : ".at_m"), v[i].corners_m);
  }
}

}  // namespace

std::vector<Problem> check_value(const KeyInfo& key, const KeyValue& value) {
  std::vector<Problem> problems;
  std::visit(Checker{key, problems}, value);
  // Inner parts (a wall's normal, a shape's slope) belong to the key that holds them.
  for (auto& problem : problems) problem.path = key.path;
  return problems;
}

}  // namespace sturz
