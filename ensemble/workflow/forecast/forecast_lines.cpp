// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/readable.hpp"

#include <fmt/format.h>

namespace sturz::workflow {
namespace {

/// "12 MB"; two digits, as more are not known.
std::string size_text(double bytes) {
  constexpr const char* units[] = {"kB", "MB", "GB", "TB"};
  double value = bytes / 1e3;
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < std::size(units)) value /= 1e3, ++unit;
  return fmt::format("{} {}",
                     value < 9.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value),
                     units[unit]);
}

/// How it is known.
std::string trial_text(const Forecast& f, double spacing_m) {
  if (!f.tried)
    return f.failure.empty() ? "no member could be tried in a second or two"
                             : "no member could be tried: " + f.failure;
  std::string text = f.members > 0 && f.tried_members > 0
                         ? fmt::format("the median and {} members tried", f.tried_members)
                         : "tried";
  if (f.tried_spacing_m > 1.001 * spacing_m)
    text += fmt::format(" at a spacing of {:.3g} m", f.tried_spacing_m);
  if (f.cut_off_members > 0)
    text +=
        fmt::format(", {} of them cut off: how long they go on is not known", f.cut_off_members);
  return text;
}

}  // namespace

std::string seconds_text(const Range& r) {
  return fmt::format("{} ({} to {})", duration_text(r.likely), duration_text(r.low),
                     duration_text(r.high));
}

std::string bytes_text(const Range& r) {
  return fmt::format("{} ({} to {})", size_text(r.likely), size_text(r.low), size_text(r.high));
}

std::vector<std::string> forecast_lines(const Forecast& f) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format(
      "predicted: about {} of one core and {} steps for the median member; {}",
      seconds_text(f.median_s), grouped(f.median_steps.likely), trial_text(f, f.spacing_m)));
  if (f.members == 0) {
    lines.push_back(fmt::format("memory: {}", bytes_text(f.memory_bytes)));
    return lines;
  }
  lines.push_back(fmt::format("predicted for {} members, {} at a time: about {}{}", f.members,
                              f.workers, seconds_text(f.elapsed_s),
                              f.slowdown > 1.5 ? fmt::format(", the cores being busy: {:.1f} times "
                                                             "what it takes on idle ones",
                                                             f.slowdown)
                                               : ""));
  const bool known = f.tried_members > 0;
  lines.push_back(fmt::format("  members: {} of computing{}", seconds_text(f.members_s),
                              known ? ", " + bytes_text(f.members_disk_bytes) + " on disk" : ""));
  lines.push_back(known ? fmt::format("  maps: {} of computing, {} on disk", seconds_text(f.maps_s),
                                      bytes_text(f.maps_disk_bytes))
                        : "  maps: not known without a member that was tried");
  lines.push_back(fmt::format("  memory: {} at a time", bytes_text(f.memory_bytes)));
  return lines;
}

}  // namespace sturz::workflow
