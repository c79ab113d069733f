// SPDX-License-Identifier: Apache-2.0
/// What a GIS opens: outlines, the ground under the maps, a styled project over all files, and the
/// item of a data catalogue.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_result.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "scenarios/layers/feature_table.hpp"
#include "scenarios/layers/layer_stream.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace sturz::workflow {

/// What there is of a results folder; absent parts are null or empty.
struct GisContent {
  std::string title;
  bool one_run = false;                 ///< the files are called peaks, not hazard
  const LayerSource* maps = nullptr;    ///< whose GeoTIFFs lie in the folder
  const LayerStack* coarse = nullptr;   ///< the same in few cells, for the classes of the styles
  const SceneInputs* inputs = nullptr;  ///< observation, thalweg and gauges
  std::shared_ptr<const LayerSource> elevation;   ///< see ground_source()
  const Raster<std::uint8_t>* release = nullptr;  ///< see release_footprint()
  std::optional<FeatureTable> assets;             ///< see risk_features()
  std::span<const MemberSummary> members;         ///< whose deposits are shown
  std::size_t n_members = 0;                      ///< behind the maps: the valid ones
  std::string started;                            ///< as Manifest::started
  std::string hazard_hash;                        ///< of the maps
  CancelFlag cancel;
};

/// What a page shows of an ensemble, and the scene that it is of; all of it must live on.
GisContent gis_content(const LayerSource& maps, const PageContent& page, const Manifest&,
                       const Scenario&, const SceneInputs&);

/// Writes hazard.gpkg (peaks.gpkg of a run; so all of these names), ground.tif (where there are
/// elevations), hazard.qgz and stac_item.json. Memory holds one layer's outlines at a time, and the
/// files that grow. \throws IoError; Cancelled
void write_gis_files(const OutputFolder&, const GisContent&);

/// GeoTIFFs with their styles, and write_gis_files(); or, where the scene wants none
/// (hazard.gis_files), nothing of them, and what earlier maps left is removed.
/// \throws IoError; Cancelled
void write_all_for_gis(const OutputFolder&, const Scenario&, const GisContent&);

/// Removes what write_gis_files() left in the folder.
void remove_gis_files(const OutputFolder&);

}  // namespace sturz::workflow
