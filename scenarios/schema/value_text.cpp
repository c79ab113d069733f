// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/value_text.hpp"

#include "scenarios/schema/dam_fields.hpp"
#include "scenarios/schema/inflow_fields.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/zone_fields.hpp"

#include <algorithm>
#include <array>

namespace sturz {
namespace {

template <class List, class ToText>
std::string list_text(const List& list, ToText to_text) {
  std::string text = "[";
  for (const auto& item : list) text += (text.size() > 1 ? ", " : "") + to_text(item);
  return text + "]";
}
template <class List>
std::string numbers_text(const List& list) {
  return list_text(list, number_text);
}

/// Collects "name: value" pairs of a flow map.
class MapText {
 public:
  MapText& add(const std::string& name, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + name + ": " + value;
    return *this;
  }
  MapText& add(const std::string& name, double value) { return add(name, number_text(value)); }
  MapText& add(const std::string& name, const std::optional<double>& value) {
    return value ? add(name, *value) : *this;
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string single_entry(const std::string& name, const std::string& value) {
  return MapText().add(name, value).text();
}

std::string pair_text(const Distribution& d) {
  return numbers_text(std::array{d.min.value_or(0), d.max.value_or(0)});
}

std::string discrete_text(const Distribution& d) {
  MapText map;
  map.add("values", numbers_text(d.values));
  if (!d.weights.empty()) map.add("weights", numbers_text(d.weights));
  return map.text();
}

std::string uncertain_text(const Uncertain& v) {
  return v.distribution ? distribution_text(*v.distribution) : number_text(v.value);
}

std::string wall_text(const WallSpec& wall) {
  MapText map;
  map.add("point_m", numbers_text(wall.point_m)).add("normal", numbers_text(wall.normal));
  map.add("friction_coefficient", wall.friction_coefficient).add("remove_at_s", wall.remove_at_s);
  if (wall.liquid != WallSpec{}.liquid) map.add("liquid", std::string(to_string(wall.liquid)));
  return map.text();
}

std::string zone_text(const BasalZone& zone) {
  MapText map;
  map.add("polygon", quoted_text(zone.polygon));
  if (!zone.layer.empty()) map.add("layer", quoted_text(zone.layer));
  for (const auto& field : zone_fields)
    if (const auto& value = zone.*field.value) map.add(field.name, uncertain_text(*value));
  return map.text();
}

std::string dam_text(const DamSpec& dam) {
  MapText map;
  for (const DamText& text : dam_texts)
    if (!(dam.*text.value).empty()) map.add(text.name, quoted_text(dam.*text.value));
  if (!dam.points_m.empty())
    map.add("points_m", list_text(dam.points_m, [](const auto& c) { return numbers_text(c); }));
  for (const DamField& field : dam_fields)
    if (const auto& value = dam.*field.value) map.add(field.name, uncertain_text(*value));
  for (const DamNumber& number : dam_numbers) map.add(number.name, dam.*number.value);
  return map.text();
}

/// A point as a list, a single number without brackets.
std::string record_text(const NumberRecord& record) {
  MapText map;
  for (const auto& [name, numbers] : record)
    map.add(name, numbers.size() == 1 ? number_text(numbers.front()) : numbers_text(numbers));
  return map.text();
}

std::string corners_text(const std::vector<std::array<double, 2>>& corners) {
  return list_text(corners, [](const auto& c) { return numbers_text(c); });
}

std::string inflow_text(const InflowSpec& source) {
  MapText map;
  const auto text = [&map](const char* name, const std::string& value) {
    if (!value.empty()) map.add(name, quoted_text(value));
  };
  text("name", source.name), text("hydrograph", source.hydrograph);
  text("line", source.line), text("polygon", source.polygon);
  if (!source.line_m.empty()) map.add("line_m", corners_text(source.line_m));
  text("layer", source.layer), text("crs", source.crs);
  for (const auto& field : inflow_fields)
    if (const auto& value = source.*field.value) map.add(field.name, uncertain_text(*value));
  return map.text();
}

/// A point has one corner, a line more.
std::string gauge_text(const GaugeSpec& gauge) {
  MapText map;
  map.add("name", quoted_text(gauge.name));
  if (gauge.corners_m.size() == 1)
    map.add("at_m", numbers_text(gauge.corners_m.front()));
  else
    map.add("points_m", corners_text(gauge.corners_m));
  return map.text();
}

std::string synthetic_text(const SyntheticTerrain& terrain) {
  MapText own;
  own.add("cell_size_m", terrain.cell_size_m);
  for (const auto& [name, value] : terrain.parameters) own.add(quoted_text(name), value);
  return single_entry(quoted_text(terrain.shape), own.text());
}

struct ToText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double v) const { return number_text(v); }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(const std::string& v) const { return quoted_text(v); }
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(const Uncertain& v) const { return uncertain_text(v); }
  std::string operator()(const std::vector<double>& v) const { return numbers_text(v); }
  std::string operator()(const std::vector<std::string>& v) const {
    return list_text(v, quoted_text);
  }
  std::string operator()(const std::map<std::string, double>& v) const {
    MapText map;
    for (const auto& [name, value] : v) map.add(quoted_text(name), value);
    return map.text();
  }
  std::string operator()(const std::map<std::string, std::string>& v) const {
    std::string text;
    for (const auto& [name, file] : v)
      text += (text.empty() ? "{" : ", ") + quoted_text(name) + ": " + quoted_text(file);
    return text.empty() ? text : text + "}";
  }
  std::string operator()(const SyntheticTerrain& v) const { return synthetic_text(v); }
  std::string operator()(const std::vector<WallSpec>& v) const { return list_text(v, wall_text); }
  std::string operator()(const std::vector<DamSpec>& v) const { return list_text(v, dam_text); }
  std::string operator()(const std::vector<BasalZone>& v) const { return list_text(v, zone_text); }
  std::string operator()(const std::vector<NumberRecord>& v) const {
    return list_text(v, record_text);
  }
  std::string operator()(const std::vector<InflowSpec>& v) const {
    return list_text(v, inflow_text);
  }
  std::string operator()(const std::vector<GaugeSpec>& v) const { return list_text(v, gauge_text); }
};

/// Words that YAML readers take for something else than text.
bool is_special_word(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  constexpr std::array words = {"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
  return std::find(words.begin(), words.end(), text) != words.end();
}

bool is_plain(const std::string& text) {
  const auto letter = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto inner = [&](unsigned char c) {
    return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-';
  };
  return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), inner) &&
         !is_special_word(text);
}

}  // namespace

std::string quoted_text(const std::string& text) {
  if (is_plain(text)) return text;
  constexpr const char* hex = "0123456789abcdef";
  std::string quoted = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\')
      quoted += {'\\', static_cast<char>(c)};
    else if (c == '\n')
      quoted += "\\n";
    else if (c < 0x20 || c == 0x7f)
      quoted += {'\\', 'x', hex[c >> 4], hex[c & 15]};
    else
      quoted += static_cast<char>(c);
  }
  return quoted + "\"";
}

std::string distribution_text(const Distribution& d) {
  using enum Distribution::Kind;
  MapText map;
  switch (d.kind) {
    case uniform:
      return single_entry("uniform", pair_text(d));
    case log_uniform:
      return single_entry("log_uniform", pair_text(d));
    case normal:
      map.add("mean", d.mean).add("sd", d.sd).add("min", d.min).add("max", d.max);
      return single_entry("normal", map.text());
    case lognormal:
      map.add("median", d.median).add("sigma_ln", d.sigma_ln).add("min", d.min).add("max", d.max);
      return single_entry("lognormal", map.text());
    case triangular:
      return single_entry("triangular",
                          numbers_text(std::array{d.min.value_or(0), d.mode, d.max.value_or(0)}));
    case beta:
      map.add("alpha", d.alpha).add("beta", d.beta).add("min", d.min).add("max", d.max);
      return single_entry("beta", map.text());
    case discrete:
      return single_entry("discrete", discrete_text(d));
    case table:
      return single_entry("table", numbers_text(d.values));
  }
  return {};
}

std::string value_text(const KeyValue& value) { return std::visit(ToText{}, value); }

}  // namespace sturz
