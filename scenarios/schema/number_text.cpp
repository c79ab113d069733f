// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/number_text.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace sturz {
namespace {

template <class Number>
std::optional<Number> parse_all(std::string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

/// Other YAML readers take "1e+30" for text: a float needs its point there.
std::string with_point(std::string text) {
  const auto exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') > exponent) text.insert(exponent, ".0");
  return text;
}

}  // namespace

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e15);
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific);
  return with_point(std::string(buffer, end.ptr));
}

std::optional<double> parse_number(std::string_view text) {
  const auto value = parse_all<double>(text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

std::optional<long long> parse_integer(std::string_view text) { return parse_all<long long>(text); }

std::string short_number(double v) {
  if (v == 0 || !std::isfinite(v)) return number_text(v);
  const double unit = std::pow(10, std::floor(std::log10(std::abs(v))) - 2);
  return number_text(unit < 1 ? std::round(v / unit) / std::round(1 / unit)
                              : std::round(v / unit) * unit);
}

}  // namespace sturz
