// SPDX-License-Identifier: Apache-2.0
/// The key table as JSON Schema, so that editors complete and check a scenario while it is typed.
#pragma once

#include <string>

namespace sturz {

/// JSON Schema (draft 2020-12) of the scenario file, indented text.
std::string json_schema();

}  // namespace sturz
