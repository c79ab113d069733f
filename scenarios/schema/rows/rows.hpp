// SPDX-License-Identifier: Apache-2.0
/// Tools to write rows of the key table: a block (blocks.hpp), a member, the limits, one sentence.
/// For the files of this folder and schema.cpp.
#pragma once

#include "engine/core/error.hpp"
#include "scenarios/schema/blocks.hpp"
#include "scenarios/schema/schema.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sturz::schema_rows {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

// Absent values (empty text, no list) are monostate, so that the writer leaves them out.
inline KeyValue to_value(double v) { return v; }
inline KeyValue to_value(bool v) { return v; }
inline KeyValue to_value(int v) { return static_cast<std::int64_t>(v); }
inline KeyValue to_value(std::uint64_t v) { return static_cast<std::int64_t>(v); }
inline KeyValue to_value(const Uncertain& v) { return v; }
inline KeyValue to_value(const std::vector<double>& v) { return v; }
inline KeyValue to_value(const SyntheticTerrain& v) { return v; }
template <Worded Enum>
KeyValue to_value(Enum v) {
  return std::string(to_string(v));
}
inline KeyValue to_value(const std::string& v) { return v.empty() ? KeyValue{} : KeyValue{v}; }
template <class T>
KeyValue to_value(const std::vector<T>& v) {
  return v.empty() ? KeyValue{} : KeyValue{v};
}
template <class T>
KeyValue to_value(const std::map<std::string, T>& v) {
  return v.empty() ? KeyValue{} : KeyValue{v};
}
template <std::size_t n>
KeyValue to_value(const std::array<double, n>& v) {
  return std::vector<double>(v.begin(), v.end());
}
template <class T>
KeyValue to_value(const std::optional<T>& v) {
  return v ? to_value(*v) : KeyValue{};
}

template <class T>
const T& held(const KeyValue& v) {
  expect(std::holds_alternative<T>(v), "a key is set with a value of its own kind");
  return std::get<T>(v);
}
template <class T>
void from_value(const KeyValue& v, T& out) {
  out = held<T>(v);
}
inline void from_value(const KeyValue& v, int& out) {  // saturates: the range check reports it
  out = static_cast<int>(std::clamp<std::int64_t>(
      held<std::int64_t>(v), std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
}
inline void from_value(const KeyValue& v, std::uint64_t& out) {
  out = static_cast<std::uint64_t>(held<std::int64_t>(v));
}
inline void from_value(const KeyValue& v, Uncertain& out) {
  out = std::holds_alternative<double>(v) ? Uncertain(std::get<double>(v)) : held<Uncertain>(v);
}
template <Worded Enum>
void from_value(const KeyValue& v, Enum& out) {  // an unknown word changes nothing: it is reported
  out = from_word<Enum>(held<std::string>(v)).value_or(out);
}
template <std::size_t n>
void from_value(const KeyValue& v, std::array<double, n>& out) {
  const auto& list = held<std::vector<double>>(v);
  expect(list.size() == n, "a fixed list is set with its own length");
  std::copy(list.begin(), list.end(), out.begin());
}
template <class T>
void from_value(const KeyValue& v, std::optional<T>& out) {
  from_value(v, out.emplace());
}

/// The part of a row that is text and limits.
struct Row {
  const char* path;
  ValueKind kind;
  const char* units;
  double min, max;
  const char* help;
};

template <class Owner, class Member>
KeyInfo key(const Block<Owner>& block, Member Owner::*member, const Row& row) {
  KeyInfo info;
  info.path = row.path;
  info.kind = row.kind;
  info.units = row.units;
  info.min = row.min;
  info.max = row.max;
  info.help = row.help;
  info.get = [block, member](const Scenario& s) {
    const Owner* owner = block.find(s);
    return owner ? to_value(owner->*member) : KeyValue{};
  };
  info.set = [block, member](Scenario& s, const KeyValue& v) {
    from_value(v, block.make(s).*member);
  };
  return info;
}

/// A text without limits.
template <class Owner>
KeyInfo text_key(const Block<Owner>& block, std::string Owner::*member, const char* path,
                 ValueKind kind, const char* help) {
  return key(block, member, {path, kind, "", -no_limit, no_limit, help});
}

/// One of the words of an enumeration.
template <class Owner, Worded Enum>
KeyInfo choice_key(const Block<Owner>& block, Enum Owner::*member, const char* path,
                   const char* help, std::vector<std::string> later = {}) {
  KeyInfo info = key(block, member, {path, ValueKind::choice, "", -no_limit, no_limit, help});
  for (const auto& word : words_of(Enum{})) info.choices.emplace_back(word.text);
  info.set = [set = std::move(info.set)](Scenario& s, const KeyValue& v) {
    // An unknown word does not even make the block that it stands in.
    if (from_word<Enum>(held<std::string>(v))) set(s, v);
  };
  info.later_choices = std::move(later);
  return info;
}
inline KeyInfo with_choices(KeyInfo info, std::vector<std::string> choices) {
  info.choices = std::move(choices);
  return info;
}
inline KeyInfo with_size(KeyInfo info, int size) {
  info.list_size = size;
  return info;
}
inline KeyInfo above_min(KeyInfo info) {
  info.above_min = true;
  return info;
}
inline KeyInfo is_required(KeyInfo info) {
  info.required = true;
  return info;
}
/// For numbers whose default 0 means "not given".
inline KeyInfo absent_when_zero(KeyInfo info) {
  info.get = [get = std::move(info.get)](const Scenario& s) {
    KeyValue v = get(s);
    const bool zero = (std::holds_alternative<double>(v) && std::get<double>(v) == 0) ||
                      (std::holds_alternative<std::int64_t>(v) && std::get<std::int64_t>(v) == 0);
    return zero ? KeyValue{} : v;
  };
  return info;
}

/// A block that is there only where the file has it.
template <class Owner>
BlockInfo optional_block(const char* path, const char* help, const Block<Owner>& block) {
  return {path, help, [block](const Scenario& s) { return block.find(s) != nullptr; },
          [block](Scenario& s) { block.make(s); }};
}

// The table's parts, in file order; schema.cpp joins them.
void add_site_keys(std::vector<KeyInfo>&);         ///< title, terrain, release
void add_material_keys(std::vector<KeyInfo>&);     ///< grains, basal, formulation
void add_discrete_keys(std::vector<KeyInfo>&);     ///< grains.discrete: within grains
void add_fluid_keys(std::vector<KeyInfo>&);        ///< fluid, coupling: after mixture
void add_structure_keys(std::vector<KeyInfo>&);    ///< terrain.dams, .buildings: within terrain
void add_bed_field_keys(std::vector<KeyInfo>&);    ///< basal.samosat, basal.rasters: within basal
void add_erosion_keys(std::vector<KeyInfo>&);      ///< erosion
void add_inflow_keys(std::vector<KeyInfo>&);       ///< inflow
void add_run_keys(std::vector<KeyInfo>&);          ///< numerics, domain, ensemble, hazard
void add_gauge_keys(std::vector<KeyInfo>&);        ///< gauges
void add_observation_keys(std::vector<KeyInfo>&);  ///< observation
void add_asset_keys(std::vector<KeyInfo>&);        ///< assets
void add_report_keys(std::vector<KeyInfo>&);       ///< report
// Their optional blocks.
void add_site_blocks(std::vector<BlockInfo>&);
void add_material_blocks(std::vector<BlockInfo>&);
void add_discrete_blocks(std::vector<BlockInfo>&);
void add_fluid_blocks(std::vector<BlockInfo>&);
void add_structure_blocks(std::vector<BlockInfo>&);
void add_bed_field_blocks(std::vector<BlockInfo>&);
void add_erosion_blocks(std::vector<BlockInfo>&);
void add_run_blocks(std::vector<BlockInfo>&);
void add_gauge_blocks(std::vector<BlockInfo>&);
void add_observation_blocks(std::vector<BlockInfo>&);
void add_asset_blocks(std::vector<BlockInfo>&);

}  // namespace sturz::schema_rows
