// SPDX-License-Identifier: Apache-2.0
/// Completion for bash, written from the command table.
#pragma once

#include "ensemble/app/command_entries.hpp"

namespace sturz::app {

/// A script to be sourced; it needs nothing but bash. Without a last line break.
/// \param shapes words for values that are called SHAPE
std::string bash_completion(const CommandTable&, const std::vector<std::string>& shapes);

}  // namespace sturz::app
