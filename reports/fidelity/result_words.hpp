// SPDX-License-Identifier: Apache-2.0
/// Results as people call them.
#pragma once

#include <string>

namespace sturz {

/// Of a column of members.csv; those that have no better name by the words of their column.
std::string result_words(const std::string& name);

}  // namespace sturz
