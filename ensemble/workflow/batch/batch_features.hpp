// SPDX-License-Identifier: Apache-2.0
/// One entry of a batch list as one job for each feature of its release.
#pragma once

#include "io/batch/batch_file.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

struct FeatureJob {
  std::string suffix;             ///< of the job's name: ".12"; empty: the scenario as it is
  std::vector<BatchValue> extra;  ///< overrides that pick the feature
};

/// \param scenario of the entry, with its overrides
/// \throws SetupError when the features of a layer are asked for and it cannot be read
std::vector<FeatureJob> feature_jobs(const BatchEntry&, const Scenario& scenario);

}  // namespace sturz::workflow
