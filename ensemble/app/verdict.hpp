// SPDX-License-Identifier: Apache-2.0
/// The last words of an ensemble, and what they are as an exit code.
#pragma once

#include "ensemble/app/console/console.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <string>

namespace sturz::app {

/// Says how the ensemble ended and where to look; returns the process's exit code, which depends
/// on ensemble.max_failed_fraction.
int verdict(const workflow::MapsMade&, Console&);

/// The same of a part of an ensemble, whose maps another command will make.
int shard_verdict(const workflow::EnsembleJob&, const workflow::MembersRun&,
                  const std::string& shard, Console&);

/// Two lines: the maps of a folder, and what a GIS opens where it was wanted.
void list_maps(const workflow::OutputFolder&, Console&);

}  // namespace sturz::app
