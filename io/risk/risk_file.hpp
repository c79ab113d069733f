// SPDX-License-Identifier: Apache-2.0
/// Risk files: which ensembles are scenarios of a site, and how often each comes.
#pragma once

#include "scenarios/risk/risk_spec.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace sturz {

/// \param name of the file in messages
/// \throws SetupError with all problems, one a line: unknown or missing keys, a folder twice, a
///   frequency that is not above 0 and at most 100 a year, lists that do not rise
RiskSpec parse_risk(std::string_view text, const std::string& name);

/// \throws SetupError; IoError when the file cannot be read
RiskSpec read_risk(const std::filesystem::path& file);

}  // namespace sturz
