// SPDX-License-Identifier: Apache-2.0
/// Ready-made priors of the usual processes: `material: rock_avalanche`. A place to begin, with the
/// source of every value; whatever the file gives itself holds.
#pragma once

#include "scenarios/scenario.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// A key that a material gives where the file does not.
struct MaterialValue {
  const char* key;     ///< dotted
  const char* value;   ///< as a file would say it, YAML
  const char* source;  ///< author and year
  bool checked;        ///< the value was held against the source, not only known from memory
};

/// Calibrated for `depth_averaged`: full stress needs a friction about 0.05 smaller.
struct Material {
  const char* name;  ///< word of the key `material`
  const char* what;  ///< in words
  std::vector<MaterialValue> values;
};

std::span<const Material> materials();
/// nullptr for an unknown name.
const Material* find_material(const std::string& name);
std::vector<std::string> material_names();

/// One sentence for each value of the scene's material: what it gave and from where, or that the
/// file has another one. Empty without `material`.
std::vector<std::string> material_notes(const Scenario&);

}  // namespace sturz
