// SPDX-License-Identifier: Apache-2.0
/// One member's thickness over time, kept for the page to play (report.animation).
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/maps/thickness_frame.hpp"
#include "engine/simulation/simulation.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "io/members/member_store.hpp"
#include "reports/page/report_input.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace sturz::workflow {

/// Keeps some tens of instants of a run of unknown length: where there are too many, every
/// second one goes and the next are taken half as often. The first and the last always stay.
class FrameTaker {
 public:
  static constexpr std::size_t most_frames = 40;
  static constexpr std::size_t most_cells = 60'000;  ///< a frame; more are joined
  static constexpr double first_interval_s = 0.5;

  /// An instant of a run; those between two frames are passed over, unless `last`.
  void take(const SimulationParts&, bool last = false);
  /// On one grid, in cells that a page can hold; of joined ones the thickest. Nothing without two
  /// frames with mass.
  std::optional<FramesShown> frames(std::int64_t member, const Grid& maps) const;

 private:
  std::vector<ThicknessFrame> kept_;
  double interval_s_ = first_interval_s, next_s_ = 0;
};

/// The valid member whose runout is the middle one, of those that are not cut off where there are
/// such; nothing where no member is valid.
std::optional<std::size_t> middle_member(std::span<const MemberSummary> members);

/// Computes middle_member() again. \throws Cancelled
std::optional<FramesShown> frames_of_middle(const Scenario&, const DesignTable&, const SceneInputs&,
                                            std::span<const MemberSummary>, CancelFlag);

/// As frames.nc: flow_thickness(time, y, x).
void write_frames(const OutputFolder&, const FramesShown&);
/// Nothing where there is no such file.
std::optional<FramesShown> read_frames(const OutputFolder&);

}  // namespace sturz::workflow
