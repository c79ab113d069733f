// SPDX-License-Identifier: Apache-2.0
/// What a run or an ensemble will take, members and maps, before it is computed.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/forecast/range.hpp"
#include "ensemble/workflow/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::workflow {

struct ForecastRequest {
  const DesignTable* design = nullptr;  ///< null: the median alone
  std::int64_t members = 0;             ///< still to do, of the design
  int workers = 1;                      ///< members at a time
  SpeedCache speed_cache;               ///< of the machine
  double start_s = 0;                   ///< what starting and reading the scene took
  double trial_s = 1;                   ///< computing time that may be spent on trying members
  double longest_try_s = 2;             ///< that one of them may take before it is cut off
  CancelFlag cancel = {};
};

/// Seconds are of computing time unless they are called elapsed. What the ranges are made of is
/// said at forecast().
struct Forecast {
  std::int64_t members = 0;  ///< 0: the median alone
  int workers = 1;
  bool tried = false;  ///< false: no member could be tried, and the ranges are wide
  std::int64_t tried_members = 0;
  std::int64_t cut_off_members = 0;  ///< of those: not at their end after two seconds
  std::string failure;               ///< why nothing could be tried, where it is not the time
  double spacing_m = 0, tried_spacing_m = 0;  ///< the scene's, and that of the trial
  double trial_s = 0;                         ///< spent on it
  Range median_s, median_steps;               ///< one member, with the median of every distribution
  Range member_s;                             ///< of the design on average
  double start_s = 0;                         ///< starting and reading the scene
  Range members_s, maps_s, total_s;
  Range elapsed_s;      ///< low: the cores are idle otherwise; likely: as busy as now
  double slowdown = 1;  ///< by what others take
  Range memory_bytes;   ///< the most at a time
  Range members_disk_bytes, maps_disk_bytes;
};

/// Members from a trial (trial.hpp), maps from what the tried members reach and this machine's
/// speed at making maps. Ranges are wide enough for what docs/studies/forecasts.md measured:
///   a member     two fifths for the machine, more by a power of 0.3 where the trial was coarser;
///                what the finer of two trials differed from the coarser one, where that is more
///   all members  that, and twice the standard error of the mean of those tried; one that was cut
///   off
///                between what it took and as much more as its time limit would be, the geometric
///                mean at the likeliest
///   maps         three fifths either way, between the ground that the tried members reach and what
///                the farthest of all will
/// Without a trial: a factor of four. \throws Cancelled
Forecast forecast(const Scene&, const ForecastRequest&);

/// What so many members at a time take, with the program and the terrain, without maps [bytes].
Range members_memory(const Scene&, int workers);

/// The forecast in sentences: a line for a member, and for an ensemble those of its parts.
std::vector<std::string> forecast_lines(const Forecast&);

/// "12 s (8.0 s to 18 s)".
std::string seconds_text(const Range&);
/// "12 MB (8 MB to 18 MB)".
std::string bytes_text(const Range&);

}  // namespace sturz::workflow
