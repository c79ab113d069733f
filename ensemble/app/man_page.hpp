// SPDX-License-Identifier: Apache-2.0
/// The manual page, written from the command table.
#pragma once

#include "ensemble/app/command_entries.hpp"

namespace sturz::app {

/// troff text with man macros, without a last line break.
std::string man_page(const CommandTable&, const std::string& version);

}  // namespace sturz::app
