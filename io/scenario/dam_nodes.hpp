// SPDX-License-Identifier: Apache-2.0
/// Dams out of YAML nodes. Included by .cpp files only.
#pragma once

#include "io/scenario/number_nodes.hpp"
#include "scenarios/scenario.hpp"

#include <string>

namespace sturz {

/// \return false where something of it was not understood; problems say what
bool read_dam(const std::string& path, const YamlNode&, DamSpec&, FileProblems&);

}  // namespace sturz
