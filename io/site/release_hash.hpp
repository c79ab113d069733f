// SPDX-License-Identifier: Apache-2.0
/// What a release is known by, whatever window of the terrain was read.
#pragma once

#include "scenarios/scene_inputs.hpp"

#include <string>

namespace sturz {

/// Hash of ground and pattern where the release lies, "sha256:..." : cells in the order of the
/// grid, each with its place, so that a window's own counting of rows and columns does not enter.
/// \pre elevation and release are loaded
std::string hash_of_release(const SceneInputs&);

}  // namespace sturz
