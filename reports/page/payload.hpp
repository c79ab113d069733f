// SPDX-License-Identifier: Apache-2.0
/// The data that the page's script works on: maps as packed whole numbers, members as columns.
#pragma once

#include "reports/figures/map_scene.hpp"
#include "reports/page/report_input.hpp"

#include <string>
#include <vector>

namespace sturz {

/// How a raster of numbers became whole numbers, and back. Code `nodata` is NaN.
///   linear: value = offset + factor * code
///   square: value = factor * code^2 (fine steps near zero, where thresholds lie)
struct Quantised {
  bool square = false;
  double offset = 0, factor = 1;
  int nodata = 65535;
  std::vector<std::uint16_t> codes;
};
/// Shares k / n_members become k, exactly, when every value is one; `n_members` <= 65534.
/// Whole numbers below 65535 stay themselves. Others get about 4000 steps: squares when none is
/// negative, else even ones.
Quantised quantise(const std::vector<float>& values, int n_members);

/// JSON, not yet made safe for a script element. `scene` and `maps` may be null: no maps.
std::string report_payload(const ReportInput& input, const MapScene* scene, const LayerStack* maps);

}  // namespace sturz
