// SPDX-License-Identifier: Apache-2.0
/// A stop rule as manifest and terminal write it.
#pragma once

#include "ensemble/stopping/stop_rule.hpp"

#include <nlohmann/json.hpp>

namespace sturz::workflow {

/// The half width is null without valid members; `asset` is there where the rule is of one.
nlohmann::ordered_json stop_json(const StopRecord&);

}  // namespace sturz::workflow
