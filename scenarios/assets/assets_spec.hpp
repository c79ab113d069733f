// SPDX-License-Identifier: Apache-2.0
/// What may be hit: plain data of the block `assets`. No member depends on it.
#pragma once

#include <string>

namespace sturz {

struct AssetsSpec {
  std::string features;         ///< points, lines or polygons, any OGR layer
  std::string layer;            ///< layer name inside `features`; empty: the first
  std::string name_attribute;   ///< field with a name of each; required
  std::string class_attribute;  ///< field with a class of `vulnerability`; empty: none
  std::string value_attribute;  ///< field with what each is worth, in `value_unit`; empty: none
  std::string value_unit;       ///< "CHF": ends the names of columns with a value or a loss
  std::string vulnerability;    ///< YAML file with a curve for every class; empty: none
  std::string crs;              ///< of `features` where it has none
  bool operator==(const AssetsSpec&) const = default;
};

}  // namespace sturz
