// SPDX-License-Identifier: Apache-2.0
/// What the members of some levels tell of the dearest one.
#pragma once

#include "ensemble/fidelity/multilevel/level_plan.hpp"
#include "ensemble/fidelity/multilevel/multilevel_map.hpp"
#include "ensemble/workflow/multilevel/levels.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Members that count: number k of a level only below its entry.
struct LevelMembers {
  std::vector<const MemberParts*> members;  ///< [parts]
  std::vector<std::int64_t> counts;         ///< [parts]
  std::vector<LevelPart> parts;
};

/// Of each level's members, that may be held in memory: maps read them again and again.
inline constexpr std::size_t remembered_bytes = std::size_t{1} << 28;

/// What targets are about.
inline const std::vector<std::string>& headline_results() {
  static const std::vector<std::string> names{"runout_m", "reached_area_m2", "com_travel_m"};
  return names;
}

/// Valid members of some parts below their counts.
std::vector<ByNumber> valid_of(const LevelMembers&, std::span<const std::size_t> parts);
/// Draws that all of these parts have valid members of.
std::size_t shared_draws(const LevelMembers&, std::span<const std::size_t> parts);
/// Mean CPU seconds of a part's valid members below its count, of all where none is valid.
double member_cost_s(const LevelMembers&, std::size_t part);

MultilevelScalar scalar_of(const LevelMembers&, std::span<const std::size_t> parts,
                           const std::string& name);
/// The map of P(reached), or another. \pre two parts or more
MultilevelMap map_of(const LevelMembers&, std::span<const std::size_t> parts, const Exceedance&,
                     CancelFlag);

/// All results of one set of levels, with what the target allows. \pre least_draws shared ones
LevelSet level_set(const LevelMembers&, std::vector<std::size_t> parts, const TargetSpec&,
                   CancelFlag);

}  // namespace sturz::workflow
