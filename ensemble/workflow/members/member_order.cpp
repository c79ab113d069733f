// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/member_order.hpp"

#include "engine/core/error.hpp"
#include "ensemble/members/shards.hpp"
#include "scenarios/assembly/assemble.hpp"

namespace sturz::workflow {
namespace {

/// Describing a member costs about as much as a hundredth of such a one.
constexpr double worth_ordering_s = 1;

double predicted_updates(const EnsembleJob& job, std::int64_t member) {
  try {
    const SceneDescription d =
        describe(member_scenario(job.scene.scenario, job.design, member), job.scene.inputs);
    return d.n_steps * static_cast<double>(d.n_particles);
  } catch (const SetupError&) {
    return 0;
  }
}

}  // namespace

std::vector<std::int64_t> start_order(const EnsembleJob& job) {
  const auto n_workers = static_cast<std::size_t>(job.workers);
  if (job.scene.description.predicted_seconds < worth_ordering_s || job.to_do.size() <= n_workers)
    return job.to_do;
  std::vector<double> cost;
  cost.reserve(job.to_do.size());
  for (const std::int64_t member : job.to_do) cost.push_back(predicted_updates(job, member));
  return longest_first(job.to_do, cost);
}

}  // namespace sturz::workflow
