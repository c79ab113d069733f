// SPDX-License-Identifier: Apache-2.0
/// A posterior as a short table for people.
#pragma once

#include "ensemble/workflow/calibration/calibrate.hpp"

#include <string>
#include <vector>

namespace sturz::app {

/// Method, values before and after, ridges, discrepancy, held-out score and predictive check.
/// \param columns  of the terminal, for the tables; 0: no limit
std::vector<std::string> calibration_lines(const workflow::Calibrated&, int columns = 0);

}  // namespace sturz::app
