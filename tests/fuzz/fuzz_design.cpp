// SPDX-License-Identifier: Apache-2.0
// Any bytes as a design table, a user's or a saved one: a table or SetupError; what was accepted
// is rectangular, and comes back unchanged when it is written.
#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "io/scenario/scenario_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

const sturz::Scenario& scene() {
  static const sturz::Scenario read = sturz::read_scenario_text(
      "terrain: {synthetic: {ramp: {cell_size_m: 1, slope_deg: 30}}}\n"
      "release: {box: {x_m: [1, 9], y_m: [1, 9]}, thickness_m: {uniform: {min: 1, max: 3}}}\n"
      "grains: {friction_angle_deg: 30}\n"
      "basal: {friction_coefficient: {truncated_normal: {mean: 0.3, sd: 0.1, min: 0, max: 1}}}\n"
      "numerics: {spacing_m: 1}\n"
      "ensemble: {design: table, table: design.csv}\n",
      "fuzz.yaml", "");
  return read;
}

/// Quotes and blanks around a word are taken off by every reading.
bool is_plain(const std::string& word) { return word.find_first_of("\" \t\r") == word.npos; }

bool comes_back(const sturz::DesignTable& table) {
  for (const auto* words : {&table.keys, &table.units})
    if (!std::all_of(words->begin(), words->end(), is_plain)) return true;
  if (table.keys.empty()) return true;
  return sturz::from_csv(sturz::to_csv(table)) == table;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sturz::DesignTable table;
  try {
    table = sturz::from_csv({reinterpret_cast<const char*>(data), size});
  } catch (const sturz::SetupError&) {
    return 0;
  }
  for (const auto& row : table.values)
    if (row.size() != table.keys.size()) std::abort();
  if (!comes_back(table)) std::abort();
  try {
    sturz::table_design(scene(), table.keys, table.values);
  } catch (const sturz::SetupError&) {
  }
  return 0;
}
