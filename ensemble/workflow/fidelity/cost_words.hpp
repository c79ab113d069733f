// SPDX-License-Identifier: Apache-2.0
/// What a study of what accuracy costs says, in sentences.
#pragma once

#include "ensemble/workflow/fidelity/cost_files.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// "4.2 %", or "unknown".
std::string share_text(double share);

/// "512 planned members", or that the study's own number stands for one that was not given.
std::string planned_text(const CostStudy&);

/// Of one formulation: what is not told and why, the cheapest spacing for the wanted error, the
/// best split of the computing time. \param i index into study.ladders
std::vector<std::string> ladder_sentences(const CostStudy& study, std::size_t i,
                                          const CostQuestions&);

/// "runout_m", or "map > 0.5 m".
std::string name_of(const CheckedError&);
/// The spacing that the estimates are checked at: the coarsest computed one that is no coarser than
/// what is chosen for the wanted error, or the finest.
double checked_spacing(const LadderAccuracy&, const CostQuestions&);
/// How many of the quantities were met there, and at all spacings. \pre something was checked
std::string check_sentence(const LadderAccuracy&, const CostQuestions&);

/// What a multilevel estimate would save.
std::string multilevel_sentence(const MultilevelForecast&);

/// "full_stress less depth_averaged, each at its finest, with the same values".
std::string title_of(const ModelDifference&);
/// "numerics.cfl=0.1 in depth_averaged at 4 m: 2.10 times the seconds".
std::string title_of(const VariantCost&);

}  // namespace sturz::workflow
