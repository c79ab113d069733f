// SPDX-License-Identifier: Apache-2.0
/// The peaks of a folder's members on one grid, for readers of events: xarray, CLIMADA.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_stack.hpp"

#include <filesystem>
#include <string>

namespace sturz::workflow {

struct StackRequest {
  std::filesystem::path folder;        ///< that `sturz ensemble` wrote
  std::filesystem::path file;          ///< netCDF, to be made
  std::string quantity = "thickness";  ///< in the word of Quantity
  double frequency_per_year = 1;       ///< of the release
};

struct StackMade {
  StackWritten written;
  std::string units;
};

/// \throws SetupError for an unknown quantity, or when no valid member has it; IoError; Cancelled
StackMade stack_members(const StackRequest&, Observer&, CancelFlag cancel = {});

/// The words that a request may name.
std::string stack_quantities();

}  // namespace sturz::workflow
