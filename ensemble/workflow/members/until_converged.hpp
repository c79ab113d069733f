// SPDX-License-Identifier: Apache-2.0
/// An ensemble that stops when its map, or the probability of a hit of one asset, is as sure as was
/// asked for.
#pragma once

#include "ensemble/workflow/members/run_ensemble.hpp"

namespace sturz::workflow {

/// Runs the members up to the next look, looks, and goes on until the wanted half width or the last
/// look is reached. The folder is at every time that of a plain ensemble of so many members. Looks
/// before those that the folder had come to are made again, from its members, and decide nothing.
/// Progress counts the members up to the look at which the rule will probably stop.
/// \pre the job was asked for with `until_half_width`
/// \return as run_ensemble(); job.manifest.stop and `stop` say how it ended, when it did
MembersRun run_until_converged(EnsembleJob&, Observer&, const std::atomic<bool>& cancel);

/// Where the rule of a job stands before its first look.
StopRecord stop_before(const EnsembleJob&);

}  // namespace sturz::workflow
