// SPDX-License-Identifier: Apache-2.0
/// What a distribution's parameters say without drawing from it: its support, and what is wrong.
#pragma once

#include "scenarios/uncertain.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Smallest and largest value that can come out; infinite where nothing bounds it. Only for a
/// distribution without problems.
std::pair<double, double> support(const Distribution&);
/// The one value for a fixed number, the support for a distribution.
std::pair<double, double> support(const Uncertain&);

/// What is wrong with the parameters, each as a short clause: "max must be above min".
std::vector<std::string> parameter_problems(const Distribution&);

}  // namespace sturz
