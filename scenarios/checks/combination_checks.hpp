// SPDX-License-Identifier: Apache-2.0
/// Checks across keys: what excludes, needs or contradicts what. Used by validate only.
#pragma once

#include "scenarios/checks/validate.hpp"

#include <vector>

namespace sturz {

void check_terrain_and_release(const Scenario&, std::vector<Problem>&);
void check_material(const Scenario&, std::vector<Problem>&);
void check_fluid(const Scenario&, std::vector<Problem>&);
void check_discrete(const Scenario&, std::vector<Problem>&);
void check_structures(const Scenario&, std::vector<Problem>&);
void check_flow(const Scenario&, std::vector<Problem>&);
void check_bed(const Scenario&, std::vector<Problem>&);
void check_erosion(const Scenario&, std::vector<Problem>&);
void check_ensemble(const Scenario&, std::vector<Problem>&);
void check_hazard(const Scenario&, std::vector<Problem>&);
void check_observation(const Scenario&, std::vector<Problem>&);
void check_assets(const Scenario&, std::vector<Problem>&);

}  // namespace sturz
