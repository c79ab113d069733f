// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/forecast/forecast.hpp"

#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/workflow/forecast/trial.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/machine/map_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::workflow {
namespace {

constexpr double untried_factor = 4;
constexpr double machine_factor = 1.4;
constexpr double map_factor = 1.6;
/// Over the made-up maps that were measured: relief, outlines, hashes and tables of real ones.
constexpr double more_than_measured = 1.35;
constexpr double bytes_factor = 1.25;  // of members; maps compress less evenly
constexpr double map_bytes_factor = 1.6;
constexpr double memory_factor = 1.35;

double member_factor(const Trial& trial) {
  return std::max(machine_factor * std::pow(trial.coarser, 0.3), trial.surprise);
}

struct Mean {
  double value = 0, error = 0;  ///< of the mean, one standard error
};

/// Over some of `all` members; none of it is chance where all were tried.
Mean mean_of(const std::vector<TriedMember>& members, double TriedMember::*field,
             std::int64_t all) {
  Mean mean;
  const auto n = static_cast<double>(members.size());
  for (const TriedMember& m : members) mean.value += m.*field / n;
  double squares = 0;
  for (const TriedMember& m : members) squares += std::pow(m.*field - mean.value, 2);
  if (n > 1)
    mean.error = std::sqrt(squares / (n - 1) / n * std::max(0.0, 1 - n / static_cast<double>(all)));
  return mean;
}

Range with_chance(const Mean& mean, double factor) {
  if (!(mean.value > 0)) return {};
  const double chance = 2 * mean.error / mean.value;
  return Range::within(mean.value, std::exp(std::hypot(std::log(factor), chance)));
}

/// Standard deviations that the largest of n normal values lies above their mean, about.
double farthest_of(double n) {
  if (n < 2) return 0;
  const double a = std::sqrt(2 * std::log(n));
  return std::max(0.0, a - (std::log(std::log(n)) + std::log(4 * std::numbers::pi)) / (2 * a));
}

/// One side of the rectangle around all members, outward positive: as far as the farthest tried
/// one, and as far as the farthest of all may come.
struct Side {
  double seen = 0, possible = 0;
};
Side side_of(const std::vector<double>& reach, double all) {
  const auto n = static_cast<double>(reach.size());
  double mean = 0, squares = 0;
  for (const double r : reach) mean += r / n;
  for (const double r : reach) squares += (r - mean) * (r - mean);
  const double deviation = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
  const double seen = *std::max_element(reach.begin(), reach.end());
  return {seen, n >= all ? seen : std::max(seen, mean + farthest_of(all) * deviation)};
}

/// Cells of the maps: the rectangle around what all members touch, with its margin.
Range map_cells(const std::vector<TriedMember>& members, std::int64_t all, const Grid& grid) {
  std::vector<double> north, south, west, east;
  for (const TriedMember& m : members) {
    if (m.window.n_cells() == 0) continue;
    north.push_back(-m.window.row0), south.push_back(m.window.end_row());
    west.push_back(-m.window.col0), east.push_back(m.window.end_col());
  }
  if (north.empty()) {
    const double empty = empty_map_cells * empty_map_cells;
    return {empty, empty, empty};
  }
  const auto n = static_cast<double>(all);
  const auto cells = [&](double share) {
    const auto out = [&](const std::vector<double>& reach) {
      const Side side = side_of(reach, n);
      return static_cast<int>(std::ceil(side.seen + share * (side.possible - side.seen)));
    };
    const Window hull = window_between(-out(north), out(south), -out(west), out(east), grid);
    return static_cast<double>(map_extent(hull, grid).n_cells());
  };
  return {cells(0.5), cells(0), cells(1)};
}

double terrain_bytes(const Scene& scene) {
  return 2 * sizeof(double) * static_cast<double>(scene.inputs.held().n_cells());
}

/// Maps of all members of the design, whenever these were computed.
void add_maps(const Scene& scene, const ForecastRequest& request, const Trial& trial, Forecast& f) {
  const std::int64_t all = request.design->n_members();
  const Mean touched = mean_of(trial.members, &TriedMember::touched_cells, all);
  const Range cells = map_cells(trial.members, all, scene.inputs.hazard_grid);
  const MapSpeed speed = map_speed(request.speed_cache);
  const bool materials = has_materials(scene.scenario);
  const auto cost = [&](double of_cells) {
    return predict_map_cost(
        {all, touched.value, of_cells,
         map_planes(scene.scenario.hazard, scene.scenario.erosion.has_value(), materials),
         materials},
        speed);
  };
  const MapCost likely = cost(cells.likely), low = cost(cells.low), high = cost(cells.high);
  f.maps_s = Range{likely.seconds, low.seconds / map_factor, high.seconds * map_factor} *
             more_than_measured;
  f.maps_disk_bytes = {likely.disk_bytes, low.disk_bytes / map_bytes_factor,
                       high.disk_bytes * map_bytes_factor};
  const double members_bytes =
      static_cast<double>(scene.description.memory_bytes) * f.workers + program_bytes;
  const double most = std::max(members_bytes, likely.memory_bytes) + terrain_bytes(scene);
  f.memory_bytes = Range::within(most, memory_factor);
}

/// The members with what those that were cut off may take: what they took (share 0) to what their
/// time limit would (share 1).
std::vector<TriedMember> ended(std::vector<TriedMember> members, double share) {
  for (TriedMember& m : members) m.cpu_s *= std::pow(m.longer, share);
  return members;
}

Range member_seconds(const Trial& trial, std::int64_t all) {
  const auto seconds = [&](double share) {
    return with_chance(mean_of(ended(trial.members, share), &TriedMember::cpu_s, all),
                       member_factor(trial));
  };
  return {seconds(0.5).likely, seconds(0).low, seconds(1).high};
}

void add_members(const ForecastRequest& request, const Trial& trial, Forecast& f) {
  const std::int64_t all = request.design->n_members();
  f.member_s = member_seconds(trial, all);
  f.cut_off_members = std::count_if(trial.members.begin(), trial.members.end(),
                                    [](const TriedMember& m) { return m.longer > 1; });
  const auto to_do = static_cast<double>(request.members);
  f.members_s = f.member_s * to_do;
  f.members_disk_bytes = with_chance(mean_of(trial.members, &TriedMember::file_bytes, all),
                                     bytes_factor * std::pow(trial.coarser, 0.3)) *
                         static_cast<double>(all);
}

/// Members side by side, the last of them perhaps alone; maps on one core.
void add_elapsed(Forecast& f) {
  const double together = f.workers;
  const auto rounds = [&](double members_s, double member_s) {
    return members_s / together + (together > 1 ? 0.5 * member_s : 0);
  };
  f.elapsed_s.low = rounds(f.members_s.low, 0) + f.maps_s.low + f.start_s;
  f.elapsed_s.likely =
      f.slowdown * (rounds(f.members_s.likely, f.member_s.likely) + f.maps_s.likely + f.start_s);
  f.elapsed_s.high = machine_factor * f.slowdown *
                     (rounds(f.members_s.high, f.member_s.high) + f.maps_s.high + f.start_s);
}

}  // namespace

Range members_memory(const Scene& scene, int workers) {
  return Range::within(static_cast<double>(scene.description.memory_bytes) * workers +
                           program_bytes + terrain_bytes(scene),
                       memory_factor);
}

Forecast forecast(const Scene& scene, const ForecastRequest& request) {
  const SceneDescription& d = scene.description;
  const bool ensemble = request.design != nullptr && request.design->n_members() > 0;
  const Trial trial =
      try_members(scene, ensemble ? request.design : nullptr,
                  {request.workers, request.trial_s, request.cancel, request.longest_try_s});
  Forecast f;
  f.members = ensemble ? request.members : 0;
  f.workers = request.workers;
  f.tried = trial.median.has_value();
  f.tried_members = static_cast<std::int64_t>(trial.members.size());
  f.spacing_m = d.spacing_m;
  f.tried_spacing_m = d.spacing_m * trial.coarser;
  f.failure = trial.failure;
  f.trial_s = trial.cpu_s;
  f.slowdown = trial.slowdown;
  const double factor = f.tried ? member_factor(trial) : untried_factor;
  f.median_s = Range::within(f.tried ? trial.median->cpu_s : d.predicted_seconds, factor);
  f.median_steps = Range::within(f.tried ? trial.median->steps : d.n_steps, factor);
  f.member_s = f.median_s;
  f.memory_bytes = members_memory(scene, 1);
  if (ensemble && f.tried_members > 0) {
    add_members(request, trial, f);
    request.cancel.check();
    add_maps(scene, request, trial, f);
  } else if (ensemble) {
    f.members_s = f.median_s * static_cast<double>(request.members);
  }
  f.start_s = request.start_s;
  f.total_s =
      (ensemble ? f.members_s + f.maps_s : f.median_s) + Range::within(f.start_s, machine_factor);
  if (ensemble)
    add_elapsed(f);
  else
    f.elapsed_s = {f.slowdown * f.total_s.likely, f.total_s.low / available_cores(),
                   machine_factor * f.slowdown * f.total_s.high};
  return f;
}

}  // namespace sturz::workflow
