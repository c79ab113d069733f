// SPDX-License-Identifier: Apache-2.0
/// The posterior of a folder as its page shows it, read from its files.
#pragma once

#include "ensemble/workflow/folder/output_folder.hpp"
#include "reports/page/report_input.hpp"

#include <optional>
#include <string>

namespace sturz::workflow {

/// Nothing where there is none, or one of other members than the maps are of: a page of both would
/// mislead. \param maps_of hash of the members, as the manifest knows it
/// \throws SetupError when a file is damaged
std::optional<PosteriorShown> shown_posterior(const OutputFolder&, const std::string& maps_of);

}  // namespace sturz::workflow
