// SPDX-License-Identifier: Apache-2.0
/// A results folder as a later command finds it.
#pragma once

#include "engine/terrain/raster.hpp"
#include "ensemble/app/console.hpp"
#include "ensemble/app/output_folder.hpp"

#include <memory>

namespace sturz::app {

struct FinishedFolder {
  OutputFolder folder;
  Manifest manifest;
  Scenario scenario;
  std::shared_ptr<const Raster<double>> elevation;  ///< null when the input files are gone
};

/// Reads a folder back. Warns, and goes on without relief, when the terrain cannot be read any
/// more. \throws SetupError when the folder holds no results
FinishedFolder open_finished(const std::string& folder, Console&);

}  // namespace sturz::app
