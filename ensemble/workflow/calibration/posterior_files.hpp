// SPDX-License-Identifier: Apache-2.0
/// A posterior as files, and a posterior's files as a design for another ensemble.
#pragma once

#include "ensemble/workflow/calibration/calibrate.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

/// Rows of posterior.csv at most.
inline constexpr std::size_t posterior_rows = 2000;

/// posterior.csv, posterior.json and, where a member explains anything, weights.csv. Maps in
/// weighted/ go when the weights are others than before. \throws IoError
void write_posterior(const OutputFolder&, const Calibrated&);

/// The text of posterior.json: one object; numbers that are not finite are null.
std::string posterior_json(const Calibrated&);

/// The path as a YAML text that stands for itself: spaces, colons and hashes do no harm.
std::string yaml_quoted(const std::filesystem::path&);

/// Overrides that make a scene draw its members from the posterior in `folder`.
/// \throws SetupError when it holds none
std::vector<std::string> posterior_overrides(const std::filesystem::path& folder);

/// What differs between this scene and the one that the posterior was found with, what its rows are
/// worth where fewer than the members asked, and what changed in its folder, as sentences.
/// \throws SetupError when posterior.json is damaged
std::vector<std::string> posterior_warnings(const std::filesystem::path& folder,
                                            const FoundAt& now);

}  // namespace sturz::workflow
