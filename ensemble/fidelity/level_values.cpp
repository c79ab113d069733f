// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/level_values.hpp"

#include "ensemble/fidelity/valid_members.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sturz {
namespace {

constexpr std::int64_t least_members = 8;
constexpr std::size_t most_values = 25'000'000;

LevelValues values_of(const std::string& name, std::span<const ByNumber> levels,
                      std::span<const std::int64_t> members) {
  const ScalarInfo& scalar = scalar_named(name);
  LevelValues r{name, std::vector<std::vector<double>>(levels.size()), 1};
  for (const std::int64_t number : members) {
    if (!std::all_of(levels.begin(), levels.end(), [&](const ByNumber& level) {
          return is_known(*level.at(number), scalar.field);
        }))
      continue;
    for (std::size_t l = 0; l < levels.size(); ++l)
      r.values[l].push_back(levels[l].at(number)->scalars.*scalar.field);
  }
  return r;
}

Window extent_of(std::span<const MemberParts* const> levels,
                 const std::vector<std::int64_t>& members) {
  Window extent;
  for (const MemberParts* level : levels)
    for (const MemberSummary& m : level->members())
      if (std::binary_search(members.begin(), members.end(), m.member))
        extent = joined(extent, m.window);
  return extent;
}

/// Places in `extent` that some members of the first level cover and others do not.
std::vector<std::size_t> uncertain_cells(const MemberParts& first,
                                         const std::vector<std::int64_t>& members,
                                         const Window& extent, double threshold_m,
                                         std::size_t n_levels, CancelFlag cancel) {
  const Raster<double> share = share_thicker(first, members, extent, threshold_m, cancel);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < share.values.size(); ++i)
    if (share.values[i] > 0.05 && share.values[i] < 0.95) cells.push_back(i);
  const std::size_t step = 1 + cells.size() * members.size() * n_levels / most_values;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < cells.size(); i += step) some.push_back(cells[i]);
  return some;
}

LevelValues map_of(std::span<const MemberParts* const> levels,
                   const std::vector<std::int64_t>& members, double threshold_m,
                   CancelFlag cancel) {
  const Window extent = extent_of(levels, members);
  const auto cells =
      uncertain_cells(*levels.front(), members, extent, threshold_m, levels.size(), cancel);
  LevelValues map{"map", std::vector<std::vector<double>>(levels.size()), cells.size()};
  for (std::size_t l = 0; l < levels.size(); ++l) {
    map.values[l].resize(cells.size() * members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
      const Raster<double> one =
          share_thicker(*levels[l], {members[k]}, extent, threshold_m, cancel);
      for (std::size_t i = 0; i < cells.size(); ++i)
        map.values[l][i * members.size() + k] = one.values[cells[i]];
    }
  }
  return map;
}

}  // namespace

std::vector<LevelValues> level_values(std::span<const MemberParts* const> levels,
                                      std::span<const std::string> results, double threshold_m,
                                      CancelFlag cancel) {
  std::vector<ByNumber> by_number;
  for (const MemberParts* level : levels) by_number.push_back(valid_members(*level));
  const std::vector<std::int64_t> members = common_members(by_number);
  std::vector<LevelValues> all;
  const auto add = [&all](LevelValues values) {
    const std::size_t n = values.n_cells > 0 ? values.values.front().size() / values.n_cells : 0;
    if (static_cast<std::int64_t>(n) >= least_members) all.push_back(std::move(values));
  };
  for (const std::string& name : results) add(values_of(name, by_number, members));
  add(map_of(levels, members, threshold_m, cancel));
  // Sampled anew together, results need the same members.
  std::size_t n = 0;
  for (const LevelValues& r : all) n = std::max(n, r.values.front().size() / r.n_cells);
  std::erase_if(all, [n](const LevelValues& r) { return r.values.front().size() / r.n_cells < n; });
  return all;
}

}  // namespace sturz
