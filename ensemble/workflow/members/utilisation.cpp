// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/utilisation.hpp"

#include "engine/terrain/raster.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {

double Utilisation::fraction() const {
  return wall_s > 0 && cores > 0 ? core_s / (wall_s * cores) : nan_d;
}

Utilisation utilisation_of(const EnsembleJob& job, const MembersRun& run) {
  Utilisation u;
  u.workers = job.workers;
  u.threads = job.threads;
  u.cores = job.max_cores > 0 ? std::min(job.max_cores, available_cores()) : available_cores();
  u.wall_s = run.wall_s;
  u.storing_s = run.storing_s;
  u.members = static_cast<std::int64_t>(run.computed.size());
  for (const MemberSummary& m : run.computed) {
    u.core_s += m.scalars.cpu_s;
    u.busy_s += m.scalars.wall_s * u.threads;
    u.longest_s = std::max(u.longest_s, m.scalars.wall_s);
  }
  return u;
}

std::string utilisation_text(const Utilisation& u) {
  if (u.members == 0 || !(u.wall_s > 0)) return {};
  return fmt::format("{:.0f} % of {} core{} ({} of computing in {})", 100 * u.fraction(), u.cores,
                     u.cores == 1 ? "" : "s", duration_text(u.core_s), duration_text(u.wall_s));
}

std::string low_utilisation(const Utilisation& u) {
  constexpr double enough = 0.5, too_short_s = 10;
  if (u.members == 0 || u.wall_s < too_short_s || u.fraction() >= enough) return {};
  if (u.storing_s > 0.3 * u.wall_s)
    return fmt::format("writing members took {} of {}: the disk is slow",
                       duration_text(u.storing_s), duration_text(u.wall_s));
  // What members had of their cores while they ran: the rest was others', or waiting for memory.
  if (u.core_s < 0.6 * u.busy_s)
    return fmt::format(
        "members had {:.0f} % of the cores that they ran on: other work on this "
        "machine, or threads that wait for each other",
        100 * u.core_s / u.busy_s);
  if (u.workers * u.threads < 0.6 * u.cores)
    return fmt::format(
        "{} member{} at a time with {} thread{} each: more do not fit into the "
        "memory, or were not asked for",
        u.workers, u.workers == 1 ? "" : "s", u.threads, u.threads == 1 ? "" : "s");
  if (u.longest_s > 0.5 * u.wall_s && u.members > 1)
    return fmt::format("one member took {} of {}: the others had ended", duration_text(u.longest_s),
                       duration_text(u.wall_s));
  if (u.members < 2 * static_cast<std::int64_t>(u.cores))
    return fmt::format("{} member{} for {} cores are few: at the end some of them idle", u.members,
                       u.members == 1 ? "" : "s", u.cores);
  return "members took turns unevenly: some cores waited for the last ones";
}

}  // namespace sturz::workflow
