// SPDX-License-Identifier: Apache-2.0
// Assets have names, values have units, classes have curves.
#include "scenarios/checks/combination_checks.hpp"

#include <algorithm>
#include <cstddef>

namespace sturz {
namespace {

constexpr std::size_t longest_unit = 16;

/// A unit becomes part of the names of columns, which many programs read.
bool is_column_word(const std::string& text) {
  return text.size() <= longest_unit && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '_';
         });
}

}  // namespace

void check_assets(const Scenario& s, std::vector<Problem>& problems) {
  if (!s.assets) return;
  const AssetsSpec& a = *s.assets;
  const auto add = [&problems](const std::string& name, const std::string& rest) {
    problems.push_back({"assets." + name, "assets." + name + " " + rest});
  };
  const auto needs = [&add](const std::string& owner, const char* owner_name,
                            const std::string& companion, const char* companion_name,
                            const char* why) {
    if (!owner.empty() && companion.empty())
      add(owner_name,
          std::string("(") + why + "). Add assets." + companion_name + " or remove it.");
  };
  if (a.features.empty())
    problems.push_back({"assets",
                        "assets (names no layer). Add assets.features, a file of points, lines or "
                        "polygons."});
  else if (a.name_attribute.empty())
    problems.push_back({"assets",
                        "assets (without names its table could not be read). Add "
                        "assets.name_attribute, the field of assets.features that holds them."});
  needs(a.class_attribute, "class_attribute", a.vulnerability, "vulnerability",
        "a class says nothing without its curve");
  needs(a.vulnerability, "vulnerability", a.class_attribute, "class_attribute",
        "no asset says which of its curves holds");
  needs(a.value_attribute, "value_attribute", a.value_unit, "value_unit",
        "a number without a unit");
  needs(a.value_unit, "value_unit", a.value_attribute, "value_attribute",
        "there is no value that it could belong to");
  if (!is_column_word(a.value_unit))
    add("value_unit", "= " + a.value_unit +
                          " (it ends the names of columns: letters, digits and underscores, at "
                          "most 16). Write CHF or EUR_2026, say.");
}

}  // namespace sturz
