// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/multilevel/estimates.hpp"

#include "engine/core/error.hpp"
#include "ensemble/fidelity/choice.hpp"
#include "ensemble/workflow/machine/cores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {
namespace {

/// Of the map of P(reached) by the dearest level's members alone.
struct PlainMap {
  double variance = 0;  // mean over the doubtful cells
  double n = 0;
};
PlainMap plain_map(const LevelMembers& all, CancelFlag cancel) {
  const std::vector<std::size_t> dearest{0};
  const auto valid = valid_of(all, dearest);
  const MemberParts& source = *all.members.front();
  Window extent;
  for (const auto& [number, summary] : valid.front()) extent = joined(extent, summary->window);
  std::vector<double> covered(extent.n_cells(), 0);
  for (std::size_t i = 0; i < source.members().size(); ++i) {
    if (!valid.front().contains(source.members()[i].member)) continue;
    cancel.check();
    const auto cells = covered_cells(source, i, {}, extent);
    for (std::size_t c = 0; c < covered.size(); ++c) covered[c] += cells.values[c];
  }
  PlainMap map;
  map.n = static_cast<double>(valid.front().size());
  double doubtful = 0;
  for (const double c : covered) {
    const double p = c / map.n;
    if (p <= 0.05 || p >= 0.95) continue;
    doubtful += 1;
    map.variance += p * (1 - p) * map.n / (map.n - 1);
  }
  if (doubtful > 0) map.variance /= doubtful;
  return map;
}

LevelResult map_result(const LevelMembers& all, const std::vector<std::size_t>& parts,
                       const TargetSpec& target, CancelFlag cancel) {
  LevelResult r;
  r.name = map_word;
  r.allowed = target.map_error * target.map_error;
  if (parts.size() < 2) {
    const PlainMap map = plain_map(all, cancel);
    r.plain_variance = map.variance;
    r.variances = {r.plain_variance};
    r.reached = map.variance / map.n;
    return r;
  }
  const MultilevelMap map = map_of(all, parts, {}, cancel);
  const double n = std::max(1.0, static_cast<double>(map.doubtful));
  for (const double v : map.variances) r.variances.push_back(v / n);
  r.plain_variance = map.plain_variance / n;
  // What smoothing shifts, no member removes; but it shrinks with what there is to be smoothed.
  const double shift = map.smoothing_error * map.smoothing_error;
  r.reached = map.doubtful > 0 ? std::max(0.0, map.rms_error * map.rms_error - shift) : 0;
  if (r.allowed > 0) r.allowed = std::max(r.allowed / 4, r.allowed - shift);
  return r;
}

}  // namespace

std::vector<ByNumber> valid_of(const LevelMembers& all, std::span<const std::size_t> parts) {
  std::vector<ByNumber> valid;
  for (const std::size_t part : parts) {
    ByNumber members = valid_members(*all.members[part]);
    std::erase_if(members, [&](const auto& m) { return m.first >= all.counts[part]; });
    valid.push_back(std::move(members));
  }
  return valid;
}

std::size_t shared_draws(const LevelMembers& all, std::span<const std::size_t> parts) {
  return draws_of_levels(level_draws(valid_of(all, parts)), parts.size()).front();
}

double member_cost_s(const LevelMembers& all, std::size_t part) {
  double sum = 0, n = 0, sum_all = 0, n_all = 0;
  for (const MemberSummary& m : all.members[part]->members()) {
    if (m.member >= all.counts[part]) continue;
    sum_all += m.scalars.cpu_s;
    n_all += 1;
    if (!is_valid(m.outcome)) continue;
    sum += m.scalars.cpu_s;
    n += 1;
  }
  // Plans are kept as numbers: a level without any valid member has a cost, too.
  return std::max(n > 0 ? sum / n : sum_all / std::max(n_all, 1.0), 1e-6);
}

MultilevelScalar scalar_of(const LevelMembers& all, std::span<const std::size_t> parts,
                           const std::string& name) {
  const auto valid = valid_of(all, parts);
  return multilevel_scalar(level_draws(valid, scalar_named(name).field), parts.size());
}

MultilevelMap map_of(const LevelMembers& all, std::span<const std::size_t> parts,
                     const Exceedance& what, CancelFlag cancel) {
  MapLevels levels;
  for (const std::size_t part : parts) {
    // A cell of the one would be another place on the other.
    require(all.members[part]->grid().same_place(all.members[parts.front()]->grid()),
            fmt::format("level {}: its maps lie on other cells than those of {}. Give the scene a "
                        "hazard.cell_size_m and a domain that do not depend on the spacing.",
                        all.parts[part].name, all.parts[parts.front()].name));
    levels.levels.push_back(all.members[part]);
    levels.spacings_m.push_back(all.parts[part].spacing_m);
  }
  levels.draws = level_draws(valid_of(all, parts));
  levels.memory_bytes = 0.9 * available_memory_bytes();
  return multilevel_map(levels, what, cancel);
}

LevelSet level_set(const LevelMembers& all, std::vector<std::size_t> parts,
                   const TargetSpec& target, CancelFlag cancel) {
  LevelSet set;
  set.levels = std::move(parts);
  const std::vector<ByNumber> valid = valid_of(all, set.levels);
  for (const std::string& name : headline_results()) {
    const MultilevelScalar s = scalar_of(all, set.levels, name);
    if (!std::isfinite(s.mean.mean) || !(s.variance > 0)) continue;
    const Interval bounds = s.mean.bounds_90();
    const double allowed = target.relative_error * std::abs(s.mean.mean) * s.mean.standard_error /
                           ((bounds.high - bounds.low) / 2);
    LevelResult r{name, s.cautious_variances, s.variance, allowed * allowed, 0};
    r.reached = s.mean.standard_error * s.mean.standard_error;
    for (std::size_t l = 0; l < set.levels.size(); ++l)
      r.reached += (s.cautious_variances[l] - s.variances[l]) / s.draws[l];
    // Of some valid members this result is not known: so many more are needed of each level.
    for (std::size_t l = 0; l < set.levels.size(); ++l)
      r.variances[l] *= static_cast<double>(valid[l].size()) / s.draws[l];
    r.plain_variance *= static_cast<double>(valid.front().size()) / s.draws.front();
    set.results.push_back(std::move(r));
  }
  set.results.push_back(map_result(all, set.levels, target, cancel));
  return set;
}

}  // namespace sturz::workflow
