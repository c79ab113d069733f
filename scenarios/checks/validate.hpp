// SPDX-License-Identifier: Apache-2.0
/// Checks that need no file: ranges, combinations, distributions as data.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/schema/schema.hpp"

#include <string>
#include <vector>

namespace sturz {

/// One thing wrong with a scenario. `path` names the key, io adds file:line:column.
struct Problem {
  std::string path;
  std::string message;  ///< whole sentence, names the key: key = value (why). Suggestion.
};

/// All problems at once; empty when the scenario can be assembled (files aside).
std::vector<Problem> validate(const Scenario&);

/// What is wrong with one value by itself: range, choice, distribution, list length.
std::vector<Problem> check_value(const KeyInfo&, const KeyValue&);

/// Throws SetupError with all problems, one a line, when there is any.
void require_valid(const Scenario&);

}  // namespace sturz
