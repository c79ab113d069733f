// SPDX-License-Identifier: Apache-2.0
/// Distributions as the scenario file writes them: {uniform: [a, b]}, {normal: {mean: ..}}, ...
#pragma once

#include "io/scenario/number_nodes.hpp"
#include "scenarios/uncertain.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// How one kind of distribution is written.
struct DistributionForm {
  const char* name;  ///< the word in the file
  Distribution::Kind kind;
  std::vector<const char*> list;  ///< parameters of the short form [a, b]; empty: none
  std::vector<const char*> required, optional;  ///< parameters of the form {name: value}
};
/// Every form that is understood; discrete and table hold lists instead of numbers.
const std::vector<DistributionForm>& distribution_forms();

/// Reads {kind: parameters}. Parameter values are not judged here.
std::optional<Distribution> read_distribution(const std::string& path, const YamlNode&,
                                              FileProblems&);

}  // namespace sturz
