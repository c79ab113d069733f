// SPDX-License-Identifier: Apache-2.0
/// Risk at the scene's assets, and its files.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "scenarios/scene_inputs.hpp"

#include <memory>
#include <optional>

namespace sturz::workflow {

struct AssetFindings {
  std::shared_ptr<const Assets> assets;
  RiskTable risk;
};

/// Nothing where the scene has no assets. \throws IoError; Cancelled
std::optional<AssetFindings> find_risk(const MemberParts&, const SceneInputs&,
                                       CancelFlag cancel = {});

/// assets.csv and assets.gpkg; where there are no assets, earlier ones are removed. \throws IoError
void write_asset_files(const OutputFolder&, const std::optional<AssetFindings>&, const Grid& maps);

void write_asset_table(const OutputFolder&, const FeatureTable&);

}  // namespace sturz::workflow
