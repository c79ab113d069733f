// SPDX-License-Identifier: Apache-2.0
/// What is cut off, in the page's language. In English the same words as censoring_report.hpp has.
#pragma once

#include "ensemble/censoring/censoring_report.hpp"

#include <string>
#include <vector>

namespace sturz {

/// As counts_text().
std::string cut_off_counts(const CensoringReport&);
/// As censoring_sentences(); where mass left stays in the words of CensoringReport::where.
std::vector<std::string> cut_off_sentences(const CensoringReport&);
/// "out of time", "noch in Bewegung".
std::string outcome_text(Outcome);
std::string censoring_text(Censoring);

}  // namespace sturz
