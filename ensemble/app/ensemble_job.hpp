// SPDX-License-Identifier: Apache-2.0
/// What `sturz ensemble` knows before its first member starts.
#pragma once

#include "ensemble/app/commands.hpp"
#include "ensemble/app/console.hpp"
#include "ensemble/app/output_folder.hpp"
#include "ensemble/app/scene.hpp"
#include "ensemble/sampling/design.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::app {

struct EnsembleJob {
  Scene scene;
  OutputFolder folder;
  Manifest manifest;
  DesignTable design;
  std::vector<std::int64_t> to_do;
  std::int64_t finished_before = 0;  ///< of this call's share
  int workers = 1;                   ///< members at a time
  int threads = 1;                   ///< of each member
};

/// Reads and checks the scene, then begins the results folder or finds out what is left to do in
/// it. Nothing is written before everything that the user could have wrong has been looked at.
/// \throws SetupError
EnsembleJob prepare_ensemble(const EnsembleOptions&, Console&);

/// The command as manifest and log keep it.
std::string command_text(const EnsembleOptions&);

}  // namespace sturz::app
