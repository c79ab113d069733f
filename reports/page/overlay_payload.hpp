// SPDX-License-Identifier: Apache-2.0
/// What the script draws besides results. Included by .cpp files only.
#pragma once

#include "reports/page/report_input.hpp"

#include <nlohmann/json.hpp>

#include <span>

namespace sturz {

/// [{"name": ..., "features": [{"kind": "line", "at": [[x, y], ...], "name": ...}, ...]}, ...]; a
/// point's `at` is [x, y], a polygon's a list of rings. Coordinates to a decimetre.
nlohmann::ordered_json overlays_json(std::span<const Overlay> overlays);

/// {"west": ..., "south": ..., "east": ..., "north": ..., "picture": data URI}; null without one.
nlohmann::ordered_json orthophoto_json(const ReportInput& input, const Grid& view);

}  // namespace sturz
