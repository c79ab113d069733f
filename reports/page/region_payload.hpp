// SPDX-License-Identifier: Apache-2.0
/// Which sources reach which cell, as the page's script reads it.
#pragma once

#include "reports/figures/map_scene.hpp"
#include "reports/page/report_input.hpp"

#include <nlohmann/json.hpp>

namespace sturz {

/// {"names": [...], "counts": ..., "sources": ..., "shares": ...}: the number of sources of each
/// cell of the scene, then all cells' sources (from 0) and shares (of 65534) one behind the other,
/// packed as in codec.hpp. Where cells were joined, each source with its largest probability. Null
/// where the hits are more than a page can hold.
nlohmann::ordered_json sources_json(const RegionShown& region, const MapScene& scene);

}  // namespace sturz
