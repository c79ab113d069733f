// SPDX-License-Identifier: Apache-2.0
/// A finished member in Python: numbers as numbers, maps as numpy views of the engine's own arrays.
#pragma once

#include "engine/simulation/member_result.hpp"

#include <pybind11/pybind11.h>

namespace sturz::python {

/// Adds the class `Result`.
void add_result(pybind11::module_&);

}  // namespace sturz::python
