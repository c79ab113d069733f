// SPDX-License-Identifier: Apache-2.0
/// The scores of all members of an ensemble against one event.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "ensemble/scores/event_scorer.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

struct ScoreTable {
  std::vector<ScoreInfo> columns;
  /// [members][columns]: a row for every member of the source, in its order; empty where the member
  /// has no valid result.
  std::vector<std::vector<Observation>> rows;
  Comparison comparison;  ///< of the valid members

  /// Place of a column; nothing for an unknown name.
  std::optional<std::size_t> column(const std::string& name) const;
};

/// Reads the members one by one. \throws Cancelled
ScoreTable score_members(const MemberParts&, std::shared_ptr<const ObservedEvent>,
                         CancelFlag cancel = {});
/// A run of one member.
ScoreTable score_result(const MemberResult&, std::shared_ptr<const ObservedEvent>);

/// Rows by misfit, the smallest first: those that are fully known, then lower bounds, then those of
/// which a part is not known; equal ones by their place. Without members that have no scores.
std::vector<std::size_t> best_rows(const ScoreTable&);

/// What row `row` of the source covers, as EventScorer::shown_cells() has it; empty without maps.
Raster<std::uint8_t> shown_cells(const MemberParts&, std::size_t row,
                                 std::shared_ptr<const ObservedEvent>);

/// "at least: a, b; not known: c"; empty when every score is known.
std::string bounds_text(const ScoreTable&, std::size_t row);

}  // namespace sturz
