// SPDX-License-Identifier: Apache-2.0
/// Members beside what was observed, as lines for people and JSON for machines.
#pragma once

#include "ensemble/scores/score_table.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz::app {

/// Names and values of one row: "outline", "IoU 0.61, hit rate 0.80, ..."; then each quantity
/// beside the observed one. Empty for a member without scores.
std::vector<std::pair<std::string, std::string>> score_lines(const ScoreTable&, std::size_t row);

/// {"scores": {name: {"value": .., "known": ..}}, "observed": [{"name": .., "value": .., "sd": ..,
/// "unit": .., "simulated": .., "known": ..}]}; null for a member without scores.
nlohmann::ordered_json score_json(const ScoreTable&, std::size_t row);

/// "nearest to what was observed: member 7 (misfit 0.81, outline IoU 0.62), then 3, 12"; empty
/// where none is scored. \param numbers of the members, in the order of the rows
std::string nearest_text(const ScoreTable&, std::span<const std::int64_t> numbers);

}  // namespace sturz::app
