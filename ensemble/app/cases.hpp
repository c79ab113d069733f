// SPDX-License-Identifier: Apache-2.0
/// sturz cases: what it may be told.
#pragma once

#include "ensemble/app/console.hpp"

#include <string>

namespace sturz::app {

struct CasesOptions {
  std::string name;  ///< empty: list them
  std::string out;   ///< folder of the copy; empty: the case's name, here
};

/// Lists the shipped cases, or copies one. \throws SetupError
int cases_command(const CasesOptions&, Console&);

}  // namespace sturz::app
