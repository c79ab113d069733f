// SPDX-License-Identifier: Apache-2.0
/// Features with attributes: a table that is also a vector layer.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace sturz {

/// One attribute of all features.
struct FeatureColumn {
  std::string name;  ///< letters, digits, underscores; ends with its unit
  /// Text, whole numbers or numbers; NaN: not known.
  std::variant<std::vector<std::string>, std::vector<std::int64_t>, std::vector<double>> values;
};

struct FeatureTable {
  std::string name;  ///< of the layer
  std::string crs_wkt;
  std::vector<std::string> wkb;  ///< one geometry per feature
  std::vector<FeatureColumn> columns;

  std::size_t size() const { return wkb.size(); }
  const FeatureColumn* find(const std::string& column) const {
    for (const FeatureColumn& c : columns)
      if (c.name == column) return &c;
    return nullptr;
  }
};

/// Header and one line per feature, as RFC 4180 has it; without the geometries. What is not known
/// is an empty cell; numbers have as many digits as they need to be read back to the same bits.
std::string to_csv(const FeatureTable&);

}  // namespace sturz
