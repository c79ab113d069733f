// SPDX-License-Identifier: Apache-2.0
/// Values as one-line YAML, the way the scenario writer and every message show them.
#pragma once

#include "scenarios/schema/schema.hpp"

#include <string>

namespace sturz {

/// Plain where that is safe in YAML, else double-quoted with escapes.
std::string quoted_text(const std::string& text);

/// "{uniform: [0.3, 0.6]}", "{normal: {mean: 0.3, sd: 0.05, min: 0}}", ...
std::string distribution_text(const Distribution&);

/// Any value in YAML flow style; empty for an absent one. Numbers keep full precision.
std::string value_text(const KeyValue&);

}  // namespace sturz
