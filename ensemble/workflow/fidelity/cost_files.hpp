// SPDX-License-Identifier: Apache-2.0
/// A study of what accuracy costs, as files.
#pragma once

#include "ensemble/workflow/fidelity/cost_study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

/// What is asked of a study.
struct CostQuestions {
  double wanted_error = 0.05;  ///< relative
  /// What has to be within it: names of results, and `map`, the map of the least threshold.
  std::vector<std::string> wanted{"runout_m", "reached_area_m2", "com_travel_m", map_word};
  double core_s = 0;  ///< computing time for an ensemble; 0: what its planned members take
                      ///< at the finest spacing
};

/// The three numbers under a headline, relative to the result, of the planned members at one
/// spacing: half width of the 90 % bounds by sampling, expected sizes of the others.
struct Certainty {
  std::string result;
  double sampling = nan_d, resolution = nan_d;
  double model =
      nan_d;  ///< largest difference of this formulation to another; NaN: only one was computed
};
/// \param ladder index into study.ladders
std::vector<Certainty> certainty_at(const CostStudy& study, std::size_t ladder, double spacing_m,
                                    double members);

/// core_s, or what stands for it where it is 0.
double core_seconds(const CostStudy&, const LadderAccuracy&, const CostQuestions&);

/// Every number; JSON text.
std::string cost_json_text(const CostStudy&, const CostQuestions&);

/// cost.json, cost.csv with one line per formulation, spacing and result, and the page cost.html.
/// \throws IoError
void write_cost_files(const CostStudy&, const CostQuestions&);

}  // namespace sturz::workflow
