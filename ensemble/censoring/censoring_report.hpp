// SPDX-License-Identifier: Apache-2.0
/// How many members of an ensemble are cut off, and the words in which every door says so.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// Of the valid members; the first four add up to `valid`.
struct CensoringReport {
  std::int64_t settled = 0;       ///< at rest, all mass on known ground
  std::int64_t still_moving = 0;  ///< at the end time, all mass on known ground
  std::int64_t left_terrain = 0;  ///< at rest, some mass crossed the edge
  std::int64_t left_and_moving = 0;
  std::int64_t valid = 0;
  double largest_lost_fraction = 0;  ///< of a member's mass
  double accepted_fraction = 0;      ///< ensemble.max_censored_fraction
  std::string where;                 ///< where mass left, in words; may be empty
  /// Where grains and liquid are told apart: of each, the members of which some left, those whose
  /// results of that material alone are cut off, and the largest share of it that left.
  struct OfPhase {
    std::int64_t left = 0, censored = 0;
    double largest_lost_fraction = 0;
  };
  bool phases = false;
  OfPhase grains, liquid;

  std::int64_t left() const { return left_terrain + left_and_moving; }
  std::int64_t moving() const { return still_moving + left_and_moving; }
  std::int64_t censored() const { return valid - settled; }
  double fraction() const {
    return valid > 0 ? static_cast<double>(censored()) / static_cast<double>(valid) : 0;
  }
  /// More members are cut off than the scenario accepts.
  bool too_many() const { return fraction() > accepted_fraction; }
};

CensoringReport censoring_report(std::span<const MemberSummary> members, double accepted_fraction);

/// "28 settled, 3 out of time, 9 left the terrain"; "none" without valid members.
std::string counts_text(const CensoringReport&);

/// One line for manifests and attributes: "12 of 40 valid members (28 settled, 3 out of time, ..."
std::string one_line(const CensoringReport&);

/// What is cut off, in which members, where, what that means and what to do: whole sentences, the
/// first one a headline. Empty when no member is censored.
std::vector<std::string> censoring_sentences(const CensoringReport&);

/// Sentences of the members' warnings with how many members say each, the most frequent first.
/// Numbers in them differ: the first one is given from its least to its greatest. Sentences like
/// those in `known` are left out.
struct MemberWarning {
  std::string text;
  std::int64_t count = 0;
};
std::vector<MemberWarning> member_warnings(std::span<const MemberSummary> members,
                                           std::span<const std::string> known = {});

}  // namespace sturz
