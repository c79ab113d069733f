// SPDX-License-Identifier: Apache-2.0
#include "scenarios/batch/day_window.hpp"

#include <fmt/core.h>

namespace sturz {
namespace {

constexpr int minutes_of_a_day = 24 * 60;

/// "06:00", two digits each.
std::optional<int> minute_of(std::string_view text) {
  const auto digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  if (text.size() != 5 || text[2] != ':') return std::nullopt;
  for (const std::size_t i : {0, 1, 3, 4})
    if (!digit(i)) return std::nullopt;
  const auto two = [&](std::size_t i) { return 10 * (text[i] - '0') + (text[i + 1] - '0'); };
  if (two(0) > 23 || two(3) > 59) return std::nullopt;
  return 60 * two(0) + two(3);
}

}  // namespace

std::optional<DayWindow> parse_day_window(std::string_view text) {
  constexpr std::size_t dash = 5;
  if (text.size() != 11 || text[dash] != '-') return std::nullopt;
  const auto from = minute_of(text.substr(0, dash)), to = minute_of(text.substr(dash + 1));
  if (!from || !to || *from == *to) return std::nullopt;
  return DayWindow{*from, *to};
}

std::string day_window_text(const DayWindow& w) {
  return fmt::format("{:02}:{:02}-{:02}:{:02}", w.from_min / 60, w.from_min % 60, w.to_min / 60,
                     w.to_min % 60);
}

bool is_open(const DayWindow& w, int minute) {
  if (w.from_min < w.to_min) return minute >= w.from_min && minute < w.to_min;
  return minute >= w.from_min || minute < w.to_min;
}

int minutes_until_open(const DayWindow& w, int minute) {
  if (is_open(w, minute)) return 0;
  return (w.from_min - minute + minutes_of_a_day) % minutes_of_a_day;
}

}  // namespace sturz
