// SPDX-License-Identifier: Apache-2.0
/// The rasters that `basal.rasters` names, from their files to the scene.
#pragma once

#include "io/site/bed/bed_raster.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"
#include "scenarios/schema/raster_fields.hpp"

#include <memory>
#include <string>
#include <vector>

namespace sturz {

struct OpenBedLayer {
  const RasterField* field = nullptr;
  std::unique_ptr<BedRasterFile> file;
};
using OpenBedLayers = std::vector<OpenBedLayer>;

/// Opens one of them and looks through it. \throws SetupError
OpenBedLayer open_bed_layer(const Scenario&, const RasterField&, const Grid& terrain);
/// What can be said of it without a terrain. \throws SetupError
void check_bed_layer(const Scenario&, const RasterField&);

/// Finds least, most and mean in a window; values are not kept. \return whether least or most of
/// one of them is another than before
bool measure_bed_layers(const OpenBedLayers&, const Window&, SceneInputs&);
/// Reads the values on the held cells, and notes how many there are. Least, most and mean stay.
/// \throws SetupError where one of them says nothing there
void lay_bed_layers(const OpenBedLayers&, SceneInputs&);

}  // namespace sturz
