// SPDX-License-Identifier: Apache-2.0
/// An ensemble whose means and maps are those of the scene as it is, from few of its members and
/// many of cheaper ones.
#pragma once

#include "ensemble/workflow/multilevel/levels.hpp"
#include "ensemble/workflow/multilevel/plan_file.hpp"
#include "io/members/member_store.hpp"

#include <atomic>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Whether the scene asks for it. \throws SetupError as read_scenario()
bool is_multilevel(const SceneRequest&);

struct MultilevelJob {
  EnsembleRequest request;
  Scene scene;                   ///< the dearest level
  std::vector<LevelPart> parts;  ///< that are tried, the dearest first
  StoredPlan plan;               ///< with the rounds that were decided before
};

/// Reads and checks everything; begins or continues the folders of all levels.
/// \throws SetupError; IoError
MultilevelJob prepare_multilevel(const EnsembleRequest&, Observer&);

/// What a decision is told by, and comes to.
struct MultilevelLook {
  std::vector<std::string> results;                       ///< and `map`
  std::vector<std::vector<double>> squared_correlations;  ///< [results][parts], of the pilot; of
                                                          ///< the map: 1 - what the part alone
                                                          ///< leaves of the variance
  std::vector<double> cost_s;                             ///< [parts]
  std::vector<PlanRound> rounds;                          ///< those so far
};

/// Hears of decisions as they are made.
class PlanListener {
 public:
  virtual ~PlanListener() = default;
  virtual void decided(const MultilevelJob&, const MultilevelLook&) {}
};

/// The members of every level up to its number, all valid or not.
struct MultilevelMembers {
  std::vector<MemberStore> stores;    ///< [parts]
  std::vector<std::int64_t> planned;  ///< [parts] draws that count
  std::vector<EnsembleJob> jobs;      ///< [parts]
};

/// Computes the pilot, decides, computes, and decides again until what was asked for is reached, at
/// most five times. Each decision is stored before a member of it is computed, and is made from the
/// members of the rounds before it alone: a run that was stopped anywhere comes to the same
/// members. \throws Cancelled, with all finished members kept; SetupError when the dearest level
/// has too few valid members
MultilevelMembers run_multilevel(MultilevelJob&, Observer&, PlanListener&,
                                 const std::atomic<bool>& cancel);

}  // namespace sturz::workflow
