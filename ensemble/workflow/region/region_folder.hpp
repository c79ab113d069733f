// SPDX-License-Identifier: Apache-2.0
/// Where the files of a region lie.
///
///   scenario.yaml, manifest.json, design.csv   of the region
///   features/<name>/                           an ordinary ensemble folder for each source
///   failed/<name>.txt                          why a source could not be computed
///   hazard.nc, hazard/*.tif, sources.csv, report.html   of all sources together
#pragma once

#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace sturz::workflow {

/// A source's name as a file system takes it: letters, digits, "-", "_" and "." (not at the start)
/// stay, every other byte becomes %XX. Two names never become one.
/// \throws SetupError for a name that is longer than file names may be
std::string source_file_name(const std::string& source);

/// Folder of the members of one source.
OutputFolder source_folder(const OutputFolder& region, const std::string& source);

std::filesystem::path sources_csv(const OutputFolder& region);

/// Why the source could not be computed when it was last tried; nothing: it could, or was not.
std::optional<std::string> failure_of(const OutputFolder& region, const std::string& source);
/// Keeps it, or forgets it (an empty reason). \throws IoError
void keep_failure(const OutputFolder& region, const std::string& source, const std::string& reason);

/// True when the scenario makes a region of its release. \throws SetupError
bool is_region(const SceneRequest&);
/// True for a folder that `sturz ensemble` made of a region.
bool is_region(const std::filesystem::path& folder);

/// The scene of one source of a region's scene.
SceneRequest source_scene(const SceneRequest& region, const std::string& source);

}  // namespace sturz::workflow
