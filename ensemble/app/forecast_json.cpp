// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/forecast_json.hpp"

#include <ctime>

namespace sturz::app {

nlohmann::ordered_json forecast_json(const workflow::Forecast& f) {
  const auto range = [](const workflow::Range& r, bool known = true) -> nlohmann::ordered_json {
    if (!known) return nullptr;
    return {{"likely", r.likely}, {"low", r.low}, {"high", r.high}};
  };
  const bool ensemble = f.members > 0, members_tried = f.tried_members > 0;
  return {{"members", f.members},
          {"workers", f.workers},
          {"tried", f.tried},
          {"tried_members", f.tried_members},
          {"cut_off_members", f.cut_off_members},
          {"tried_spacing_m", f.tried_spacing_m},
          {"trial_cpu_s", f.trial_s},
          {"slowdown", f.slowdown},
          {"median_cpu_s", range(f.median_s)},
          {"median_steps", range(f.median_steps)},
          {"member_cpu_s", range(f.member_s, ensemble)},
          {"members_cpu_s", range(f.members_s, ensemble)},
          {"start_cpu_s", f.start_s},
          {"maps_cpu_s", range(f.maps_s, members_tried)},
          {"total_cpu_s", range(f.total_s, !ensemble || members_tried)},
          {"elapsed_s", range(f.elapsed_s, !ensemble || members_tried)},
          {"memory_bytes", range(f.memory_bytes)},
          {"members_disk_bytes", range(f.members_disk_bytes, members_tried)},
          {"maps_disk_bytes", range(f.maps_disk_bytes, members_tried)}};
}

double process_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace sturz::app
