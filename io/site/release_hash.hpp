// SPDX-License-Identifier: Apache-2.0
/// What tells one release from another, whatever part of the terrain was read.
#pragma once

#include "scenarios/scene_inputs.hpp"

#include <string>

namespace sturz {

/// Hash of place, ground and pattern of every cell of the release.
std::string hash_of_release(const SceneInputs& inputs);

}  // namespace sturz
