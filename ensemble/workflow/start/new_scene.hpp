// SPDX-License-Identifier: Apache-2.0
/// A commented scenario around an elevation raster and a release.
#pragma once

#include "ensemble/workflow/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct NewSceneRequest {
  std::string terrain;           ///< raster, as GDAL opens it from the current folder
  std::string release;           ///< polygon layer or thickness raster, likewise
  std::filesystem::path folder;  ///< where the scenario will lie; names of files start there
  std::string process = "rock_avalanche";  ///< one of process_names()
  std::string title;                       ///< empty: after the process
  std::string crs;                         ///< of a raster without one; empty: its own
  std::optional<double> thickness_m, volume_m3, spacing_m;
  int members = 64;
};

struct NewScene {
  std::string text;  ///< of the scenario file, which was read back and described
  Scene scene;
  std::vector<std::string> choices;  ///< what was chosen and why, a sentence each
};

/// Materials whose friction and turbulent coefficient both come from a publication.
std::vector<std::string> process_names();

/// Reads both files, picks what the request leaves open and describes the scene that comes of it.
/// \throws SetupError as load_scene does; for an unknown process; where a thickness is needed
NewScene new_scene(const NewSceneRequest&);

}  // namespace sturz::workflow
