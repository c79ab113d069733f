// SPDX-License-Identifier: Apache-2.0
/// Finished ensembles of one event or several, whose members have the same uncertain values, and
/// what all events together tell of these.
#pragma once

#include "ensemble/workflow/calibration/calibrate.hpp"
#include "ensemble/workflow/results/merge.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct EventsRequest {
  std::vector<std::filesystem::path> folders;  ///< of ensembles, each of one event
  std::filesystem::path out;                   ///< for the posterior's files; empty: the one folder
  std::optional<PosteriorMethod> method;
  double discrepancy = default_discrepancy;
};

/// What keeps two ensembles from being calibrated together: other uncertain values, distributions,
/// numbers of members or drawn values. Terrain, release and observation may be any. A sentence's
/// end, such as "ensemble.seed: 1 -> 2"; empty when nothing does.
std::string what_differs(const Scenario& a, const DesignTable& design_a, const Scenario& b,
                         const DesignTable& design_b);

/// Members that are valid in every event, with the quantities of all: the likelihood of a member is
/// the product over events, with one discrepancy for each kind of quantity. Names of quantities
/// begin with that of their event where there are several.
/// \param events names \param warnings gets how many members have no say
/// \throws SetupError when no member is valid in every event
Comparison joint_comparison(const std::vector<Comparison>& comparisons,
                            const std::vector<std::string>& events,
                            std::vector<std::string>& warnings);

/// Reads the ensembles, scores and weighs them, and writes the posterior's files into `out`. With
/// several events each is also predicted by the others (found.held_out.events). No member is
/// computed: the best fit is not checked.
/// \throws SetupError naming what is missing or differs; IoError; Cancelled
Calibrated calibrate_events(const EventsRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
