// SPDX-License-Identifier: Apache-2.0
/// Other programs, for a workflow that must not start any by itself.
#pragma once

#include "ensemble/workflow/cluster/slurm.hpp"

namespace sturz::app {

/// Found on the user's PATH; its output is collected, its input is empty. It ends with this
/// process, however that ends.
workflow::Ran run_command(const std::vector<std::string>& words);

}  // namespace sturz::app
