// SPDX-License-Identifier: Apache-2.0
/// The keys of a batch list as JSON Schema, so that editors complete and check it.
#pragma once

#include <string>

namespace sturz {

/// JSON Schema (draft 2020-12), indented text.
std::string batch_schema();

}  // namespace sturz
