// SPDX-License-Identifier: Apache-2.0
/// Made-up results of an ensemble: a mountain, a gully, and members that follow it as far
/// as their made-up friction lets them. Maps come from the real make_hazard_map.
#pragma once

#include "engine/simulation/member_parts.hpp"
#include "ensemble/sampling/design.hpp"
#include "reports/page/report.hpp"

#include <memory>

namespace sturz::testing {

struct MadeUpScene {
  int n_cols = 120, n_rows = 80;
  double cell_m = 20;
  int n_members = 32;
  int n_failed = 1;     ///< every so many-th member diverges
  double edge = 1;      ///< share of the width at which mass is lost: 1 is beyond all of them
  bool phases = false;  ///< grains and liquid apart: the liquid runs farther, and leaves alone
};

/// Owns everything that a ReportInput points to.
struct MadeUpResults {
  Raster<double> elevation;
  std::unique_ptr<MemberParts> source;
  LayerStack hazard;      ///< empty layers without members
  LayerStack peaks;       ///< of the first member
  MemberHistory history;  ///< of the first member, with states
  DesignTable design;
  Raster<std::uint8_t> release;

  /// Page of the whole ensemble, with every optional part filled.
  ReportInput ensemble_input() const;
  /// Page of the first member alone.
  ReportInput single_input() const;
};
MadeUpResults make_up_results(const MadeUpScene& scene = {});

}  // namespace sturz::testing
