// SPDX-License-Identifier: Apache-2.0
/// Members at points that were chosen, in a folder of their own below an ensemble's.
#pragma once

#include "ensemble/scores/comparison.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <atomic>
#include <filesystem>
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

}  // namespace sturz::workflow
