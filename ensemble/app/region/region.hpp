// SPDX-License-Identifier: Apache-2.0
/// What `ensemble`, `merge` and `describe` do with a region.
#pragma once

#include "ensemble/app/console/console.hpp"
#include "ensemble/workflow/region/region_results.hpp"

#include <string>

namespace sturz::app {

/// Computes all sources, or a shard of them, and makes the maps. \return the exit code
int region_ensemble(const workflow::EnsembleRequest&, const std::string& shard, Console&);

int region_merge(const std::string& folder, bool partial, Console&);

int region_describe(const workflow::SceneRequest&, Console&);

}  // namespace sturz::app
