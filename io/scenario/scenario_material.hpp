// SPDX-License-Identifier: Apache-2.0
/// The ready-made priors of `material`, laid under what a scenario file says itself.
#pragma once

#include "io/scenario/yaml_tree.hpp"

namespace sturz {

/// Puts the values of `material: NAME` into the tree where it has none of its own. Their place is
/// "material NAME". An unknown name changes nothing: the key table reports it.
void add_material_values(YamlNode& root);

}  // namespace sturz
