// SPDX-License-Identifier: Apache-2.0
/// The posterior of a folder as its page shows it, read from its files.
#pragma once

#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "reports/page/report_input.hpp"
#include "scenarios/scenario.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// "sha256:..." of what was observed: numbers of the scene, and what was read of its files.
std::string observation_hash(const Scenario&, const std::vector<InputIdentity>& inputs);

/// Nothing where there is none, or one of other members or another observation than the manifest
/// knows: a page of both would mislead. A damaged one is told and not shown: maps do not depend on
/// it.
std::optional<PosteriorShown> shown_posterior(const OutputFolder&, const Manifest&, const Scenario&,
                                              Observer&);

}  // namespace sturz::workflow
