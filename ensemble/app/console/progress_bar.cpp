// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/console/progress_bar.hpp"

#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::app {
namespace {

using workflow::duration_text;
using workflow::grouped;

std::string with_bar(double fraction, const std::string& text, int columns) {
  const int width = std::clamp(columns - static_cast<int>(text.size()) - 4, 0, 32);
  const int full = static_cast<int>(width * std::clamp(fraction, 0.0, 1.0));
  const std::string bar =
      width >= 5 ? fmt::format("[{}{}] ", std::string(full, '#'), std::string(width - full, '.'))
                 : "";
  return (bar + text).substr(0, std::max(columns - 1, 10));
}

}  // namespace

std::string ensemble_bar(const RunnerProgress& p, std::int64_t finished_before, int columns) {
  const std::int64_t finished = finished_before + p.n_done, total = finished_before + p.n_total;
  const bool has_rule = !std::isnan(p.wanted_half_width);
  std::string text = fmt::format("{}/{}{} members", finished, has_rule ? "~" : "", total);
  if (p.n_failed > 0) text += fmt::format(", {} failed", p.n_failed);
  if (p.n_done > 0)
    text += fmt::format(" | {}/h | {} left", grouped(p.members_per_hour), duration_text(p.eta_s));
  else
    text += fmt::format(" | {} running for {}", p.n_running, duration_text(p.elapsed_s));
  if (has_rule && !std::isnan(p.half_width))
    text += fmt::format(" | half width {:.3f}, wanted {}", p.half_width, p.wanted_half_width);
  return with_bar(total > 0 ? static_cast<double>(finished) / static_cast<double>(total) : 1, text,
                  columns);
}

std::string member_bar(const Progress& p, int columns) {
  const double fraction = p.end_time_s > 0 ? p.time_s / p.end_time_s : 0;
  // What people wait for comes first: a narrow terminal cuts the rest.
  std::string text = fmt::format("t {:.1f} of at most {:.0f} s", p.time_s, p.end_time_s);
  if (fraction > 0)
    text += fmt::format(" | {} left if it takes all",
                        duration_text(p.wall_s * (1 - fraction) / fraction));
  text += fmt::format(" | front {:.0f} m | {:.1f} m/s", p.front_travel_m, p.max_speed_m_s);
  if (p.wall_s > 0)
    text += fmt::format(" | {:.0f} steps/s", static_cast<double>(p.n_steps) / p.wall_s);
  return with_bar(fraction, text, columns);
}

}  // namespace sturz::app
