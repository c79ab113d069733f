// SPDX-License-Identifier: Apache-2.0
/// Turns finished results into one self-contained page.
///
/// The page needs no network and no other file. It carries its own policy in a meta element:
///   default-src 'none'; script-src 'sha256-..'; style-src 'sha256-..'; img-src data: blob:
/// A server that sends a policy of its own must allow the same (or 'unsafe-inline' for script and
/// style). Maps and charts need a browser from 2023 on (DecompressionStream); older ones, pages
/// printed, and builds without the script bundle show still figures instead.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/terrain/raster.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/sampling/design.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Named columns of numbers; rows in any order unless said otherwise, NaN where unknown.
struct ReportTable {
  std::vector<std::string> columns;
  std::vector<std::string> units;         ///< UDUNITS per column; may be empty
  std::vector<std::vector<double>> rows;  ///< [n][columns.size()]
};

struct ReportInput {
  std::string title;
  std::string scenario_yaml;
  /// Version, git hash, compiler, seed, design, checksums of inputs, command, date ... in order.
  std::vector<std::pair<std::string, std::string>> manifest;
  const Raster<double>* elevation = nullptr;  ///< may be null: maps without relief
  const LayerStack* hazard = nullptr;         ///< maps of the ensemble; null for a single run
  const LayerStack* peaks = nullptr;          ///< maps of one member, used when `hazard` is null
  const MemberHistory* history = nullptr;     ///< of a single run; may be null or empty
  std::vector<MemberSummary> members;
  ReportTable samples;  ///< sampled keys; one row per entry of `members`, or no rows
  std::vector<ConvergencePoint> convergence;  ///< may be empty
  std::vector<std::string> warnings;          ///< to be read before the maps
  std::vector<std::string> notes;             ///< what was resampled, corrected, left out
  std::vector<std::string> description;       ///< lines of `describe`: effects and why
  NamedSeconds timings;                       ///< by effect, all members together [s]
  NamedSeconds pass_timings;                  ///< by pass of a step, shown folded; may be empty [s]
  double elapsed_s = 0;                       ///< wall time of the whole run; 0 = unknown
  double resolved_thickness_m = 0;  ///< thickness thresholds below it are marked 'not resolved'
};

/// The design's values of the finished members, one row each, for ReportInput::samples.
/// \throws SetupError naming the member that is not in the design
ReportTable sampled_values(const DesignTable& design, std::span<const MemberSummary> members);

/// The whole page as UTF-8 text. Never fails on strange results (no valid member, empty maps):
/// it says what is missing.
/// \throws std::logic_error if `samples` has rows that do not match `members`
std::string make_report(const ReportInput& input);

/// False when the library was built without the script bundle (still figures only).
bool report_has_script();

}  // namespace sturz
