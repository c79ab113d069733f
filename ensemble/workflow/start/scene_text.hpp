// SPDX-License-Identifier: Apache-2.0
/// The words of a new scenario file.
#pragma once

#include "scenarios/materials/materials.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {

/// What a new scenario says, and why; a comment stands behind its line.
struct SceneDraft {
  struct Line {
    std::string text, comment;
  };
  std::string title, about_ground;
  std::string terrain, crs;   ///< names of files as they lead from the scenario's folder
  std::vector<Line> release;  ///< of the block `release`
  const Material* process = nullptr;
  Line spacing;  ///< "spacing_m: 5"
  int members = 64;
};

/// A file's name, a title or the name of a field as YAML; JSON strings are YAML, too.
std::string quoted(const std::string& text);

/// YAML with comments.
std::string scene_text(const SceneDraft&);

}  // namespace sturz::workflow
