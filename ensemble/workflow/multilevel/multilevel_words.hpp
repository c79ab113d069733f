// SPDX-License-Identifier: Apache-2.0
/// What a multilevel ensemble says, in lines.
#pragma once

#include "ensemble/workflow/multilevel/multilevel_results.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// A table of the pilot: seconds and squared correlations of each level.
std::vector<std::string> pilot_lines(const MultilevelJob&, const MultilevelLook&);
/// What a round will compute, and why. \pre a round in the look, the last of which is told
std::string round_text(const MultilevelJob&, const MultilevelLook&);
/// Headlines with three numbers each, the map, what each level brought and took.
std::vector<std::string> result_lines(const MultilevelMade&);
/// The same without its tables.
std::vector<std::string> page_sentences(const MultilevelMade&);
/// What upper bounds of maps rest on, and where they are not told. \pre maps
std::string upper_bound_text(const MultilevelMade&);
/// Of quantiles whose bounds the draws do not tell: how many would.
std::vector<std::string> open_quantiles(const MultilevelMade&);
/// What the model's number is a difference to; "" without one.
std::string model_text(const MultilevelMade&);
/// Where plain sampling was kept: why. Else what was saved.
std::string gain_text(const MultilevelMade&);

}  // namespace sturz::workflow
