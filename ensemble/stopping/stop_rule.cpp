// SPDX-License-Identifier: Apache-2.0
#include "ensemble/stopping/stop_rule.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace sturz {
namespace {

std::int64_t batch_after(std::int64_t n) {
  const auto power = static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(n)));
  return std::max(least_batch, power / 8);
}

}  // namespace

std::vector<std::int64_t> look_counts(std::int64_t at_most) {
  expect(at_most > 0, "an ensemble has members");
  std::vector<std::int64_t> counts;
  for (std::int64_t n = least_batch; n < at_most; n += batch_after(n)) counts.push_back(n);
  counts.push_back(at_most);
  return counts;
}

std::int64_t certain_count(double half_width) {
  // z / (2 sqrt(n + z^2)), the half width at a probability of 1/2.
  const double n = z_95 * z_95 / (4 * half_width * half_width) - z_95 * z_95;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(n)));
}

std::int64_t expected_count(const StopRecord& record, const std::vector<std::int64_t>& looks) {
  const Look& last = record.last;
  auto n = static_cast<double>(certain_count(record.wanted_half_width));
  if (last.found.n_valid > 0) {
    const double ratio = last.found.half_width / record.wanted_half_width;
    n = static_cast<double>(last.n_members) * std::max(1.0, ratio * ratio);
  }
  const auto enough = std::find_if(looks.begin(), looks.end(), [&](std::int64_t count) {
    return static_cast<double>(count) >= n;
  });
  return enough == looks.end() ? looks.back() : *enough;
}

const char* to_string(LookedAt at) {
  switch (at) {
    case LookedAt::uncertain_cells:
      return "uncertain_cells";
    case LookedAt::reached_cells:
      return "reached_cells";
    case LookedAt::asset:
      return "asset";
    case LookedAt::no_cell:
      break;
  }
  return "no_cell";
}

std::string looked_at_text(const LargestHalfWidth& found) {
  switch (found.at) {
    case LookedAt::uncertain_cells:
      return fmt::format("{} cells with 0.05 < P < 0.95", found.n_cells);
    case LookedAt::reached_cells:
      return fmt::format("all {} reached cells, because none has 0.05 < P < 0.95", found.n_cells);
    case LookedAt::asset:
      return fmt::format("{} cells of one asset", found.n_cells);
    case LookedAt::no_cell:
      break;
  }
  return "a cell with P = 0, because no member reached one";
}

std::string stop_text(const StopRecord& record) {
  const LargestHalfWidth& found = record.last.found;
  const bool map = record.asset.empty();
  std::string text = map ? "the largest half width of P(reached)"
                         : fmt::format("the half width of P(hit) of {}", record.asset);
  text += fmt::format(" is {:.3g}, wanted is {}", found.half_width, record.wanted_half_width);
  if (map) text += ", in " + looked_at_text(found);
  text += fmt::format("; {} members, {} of them valid", record.last.n_members, found.n_valid);
  if (found.n_not_known > 0)
    text += fmt::format(", {} cut off before they hit it", found.n_not_known);
  return text + fmt::format("; look {}; {} members at most", record.n_looks, record.at_most);
}

}  // namespace sturz
