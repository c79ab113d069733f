// SPDX-License-Identifier: Apache-2.0
/// What `ensemble` does with a scene whose estimator is multilevel.
#pragma once

#include "ensemble/app/console/console.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"

namespace sturz::app {

/// Computes the members of all levels and makes the results. \return the exit code
int multilevel_ensemble(const workflow::EnsembleRequest&, Console&);

}  // namespace sturz::app
