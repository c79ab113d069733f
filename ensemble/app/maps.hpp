// SPDX-License-Identifier: Apache-2.0
/// From the members of a folder to its maps, table and page.
#pragma once

#include "engine/terrain/raster.hpp"
#include "ensemble/app/console.hpp"
#include "ensemble/app/output_folder.hpp"
#include "ensemble/sampling/design.hpp"

#include <cstdint>
#include <vector>

namespace sturz::app {

/// How complete the maps are.
struct MapsMade {
  std::int64_t planned = 0, finished = 0, valid = 0;
  std::int64_t failed() const { return finished - valid; }
};

/// Reads all member files, writes hazard.nc, hazard/*.tif, members.csv and report.html, and puts
/// the maps' hash into the manifest, which is saved.
/// \param elevation for the page's relief; may be null
/// \throws SetupError; IoError when the disk refuses (members are not touched)
MapsMade make_maps(const OutputFolder&, Manifest&, const Scenario&, const DesignTable&,
                   const Raster<double>* elevation, Console&);

/// Says how the ensemble ended and where to look; returns the process's exit code, which depends
/// on ensemble.max_failed_fraction.
int verdict(const MapsMade&, const OutputFolder&, const Manifest&, double max_failed_fraction,
            Console&);

}  // namespace sturz::app
