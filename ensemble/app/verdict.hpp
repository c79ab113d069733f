// SPDX-License-Identifier: Apache-2.0
/// The last words of an ensemble, and what they are as an exit code.
#pragma once

#include "ensemble/app/console.hpp"
#include "ensemble/workflow/results/maps.hpp"

namespace sturz::app {

/// Says how the ensemble ended and where to look; returns the process's exit code, which depends
/// on ensemble.max_failed_fraction.
int verdict(const workflow::MapsMade&, Console&);

}  // namespace sturz::app
