// SPDX-License-Identifier: Apache-2.0
/// Members at points that were chosen, in a folder of their own below an ensemble's.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/scores/comparison.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sturz::workflow {

struct ChosenMembers {
  std::vector<std::vector<double>> cube;  ///< [valid members][keys]
  Comparison comparison;                  ///< of the valid members
};

/// Computes what is not finished of them, and compares them with what was observed. `table` is the
/// truth: where it exists its points are taken instead of `cube`, so that a stopped call goes on.
/// \param base the ensemble's request; \param job its job, for the uncertain values
/// \param table file of the points (unit cube and values); the members lie beside it in a folder of
///   its name
/// \throws SetupError; Cancelled
ChosenMembers compute_chosen(const EnsembleRequest& base, const EnsembleJob& job,
                             const std::filesystem::path& table,
                             const std::vector<std::vector<double>>& cube, Observer& observer,
                             const std::atomic<bool>& cancel);

/// The file of round K's points, "active/K.csv" below the ensemble's folder.
std::filesystem::path round_table(const OutputFolder&, int round);

/// Members of finished rounds, as earlier calls left them: nothing is computed. What is missing of
/// a round is left out. \param from the first round that is looked at \param keys of the ensemble
/// \param event what they are compared with
/// \throws SetupError when a round is of other keys or its inputs were changed; Cancelled
ChosenMembers finished_rounds(const OutputFolder&, int from, const std::vector<std::string>& keys,
                              const std::shared_ptr<const ObservedEvent>& event, Observer&,
                              CancelFlag cancel);

}  // namespace sturz::workflow
