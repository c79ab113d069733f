// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/readable.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {

std::string duration_text(double seconds) {
  if (!(seconds >= 0) || !std::isfinite(seconds)) return "unknown";
  if (seconds > 0 && seconds < 0.0095) return fmt::format("{:.1g} s", std::max(seconds, 0.001));
  if (seconds > 0 && seconds < 0.95) return fmt::format("{:.2g} s", seconds);
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const auto s = static_cast<long long>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02d} s", s / 60, s % 60);
  return fmt::format("{} h {:02d} min", s / 3600, s % 3600 / 60);
}

std::string grouped(double value) {
  if (value == 0) return "0";
  // A flume's release is no 0 m3.
  if (std::abs(value) < 100) return fmt::format("{:.3g}", value);
  std::string digits = fmt::format("{:.0f}", std::abs(value)), out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += ' ';
    out += digits[i];
  }
  return (value < 0 ? "-" : "") + out;
}

std::string measure(double value, int decimals) {
  const bool small = value != 0 && std::abs(value) < std::pow(10.0, 2 - decimals);
  return small ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, decimals);
}

}  // namespace sturz::workflow
