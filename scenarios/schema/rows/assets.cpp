// SPDX-License-Identifier: Apache-2.0
// Keys of what may be hit: assets.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto assets = blocks::at<&Scenario::assets>;

void add_text(std::vector<KeyInfo>& keys, std::string AssetsSpec::*member, const char* path,
              ValueKind kind, const char* help) {
  keys.push_back(text_key(assets, member, path, kind, help));
}

}  // namespace

void add_asset_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  using A = AssetsSpec;
  add_text(keys, &A::features, "assets.features", path,
           "Layer of points, lines or polygons that may be hit: houses, roads, lines; `ensemble` "
           "writes what each has to expect.");
  add_text(keys, &A::layer, "assets.layer", text,
           "Layer inside the file of features; the first when absent.");
  add_text(keys, &A::name_attribute, "assets.name_attribute", text,
           "Field of features with a name of each; no two may be the same.");
  add_text(keys, &A::class_attribute, "assets.class_attribute", text,
           "Field of features with a class of vulnerability.");
  add_text(keys, &A::vulnerability, "assets.vulnerability", path,
           "YAML file with a curve for every class: intensity and which share of the value it "
           "destroys.");
  add_text(keys, &A::value_attribute, "assets.value_attribute", text,
           "Field of features with what each is worth, in value_unit.");
  add_text(keys, &A::value_unit, "assets.value_unit", text,
           "Unit of value_attribute, CHF say; the names of columns with a value or a loss end with "
           "it.");
  add_text(keys, &A::crs, "assets.crs", text, "Coordinate system of features that have none.");
}

void add_asset_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block(
      "assets", "What may be hit, and what it is worth: a table of risk at each.", assets));
}

}  // namespace sturz::schema_rows
