// SPDX-License-Identifier: Apache-2.0
#include "scenarios/checks/validate.hpp"

#include "engine/core/error.hpp"
#include "scenarios/checks/combination_checks.hpp"

#include <algorithm>

namespace sturz {

std::vector<Problem> validate(const Scenario& scenario) {
  std::vector<Problem> problems;
  for (const auto& key : schema()) {
    const KeyValue value = key.get(scenario);
    if (key.required && std::holds_alternative<std::monostate>(value))
      problems.push_back({key.path, key.path + " (missing). " + key.help});
    const auto found = check_value(key, value);
    problems.insert(problems.end(), found.begin(), found.end());
  }
  check_terrain_and_release(scenario, problems);
  check_material(scenario, problems);
  check_fluid(scenario, problems);
  check_discrete(scenario, problems);
  check_structures(scenario, problems);
  check_bed(scenario, problems);
  check_erosion(scenario, problems);
  check_flow(scenario, problems);
  check_ensemble(scenario, problems);
  check_hazard(scenario, problems);
  check_observation(scenario, problems);
  check_assets(scenario, problems);
  return problems;
}

void require_valid(const Scenario& scenario) {
  std::string text;
  for (const auto& problem : validate(scenario))
    text += (text.empty() ? "" : "\n") + problem.message;
  require(text.empty(), text);
}

}  // namespace sturz
