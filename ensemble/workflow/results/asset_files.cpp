// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/asset_files.hpp"

#include "io/features/feature_file.hpp"
#include "io/files/text_files.hpp"

#include <filesystem>

namespace sturz::workflow {

std::optional<AssetFindings> find_risk(const MemberParts& members, const SceneInputs& inputs,
                                       CancelFlag cancel) {
  if (inputs.assets == nullptr) return std::nullopt;
  const AssetHits hits = find_hits(members, *inputs.assets, cancel);
  return AssetFindings{inputs.assets, assess_assets(*inputs.assets, hits)};
}

void write_asset_files(const OutputFolder& folder, const std::optional<AssetFindings>& found,
                       const Grid& maps) {
  if (!found) {
    for (const auto& file : {folder.assets_csv(), folder.assets_gpkg()})
      std::filesystem::remove(file);
    return;
  }
  write_asset_table(folder, risk_features(*found->assets, found->risk, maps.crs_wkt));
}

void write_asset_table(const OutputFolder& folder, const FeatureTable& table) {
  write_text_atomic(folder.assets_csv(), to_csv(table));
  write_geopackage(folder.assets_gpkg(), table);
}

}  // namespace sturz::workflow
