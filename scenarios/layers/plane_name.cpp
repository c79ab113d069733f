// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/plane_name.hpp"

#include <array>
#include <charconv>
#include <string_view>

namespace sturz {
namespace {

/// "_kj_m2" of "kJ m-2"; nothing of "1".
std::string suffix_of(std::string_view udunits) {
  if (udunits.empty() || udunits == "1") return {};
  std::string text = "_";
  for (const char c : udunits) {
    if (c == '-') continue;
    text += c == ' ' ? '_' : (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  }
  // In the way of the scenario's keys: m s-1 is m_s, not m_s1.
  if (text.ends_with("1")) text.pop_back();
  return text;
}

/// 0.5, 1500: as few digits as tell it from every other number.
std::string digits(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

/// 95 of 0.95.
std::string percentage(double fraction) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), 100 * fraction,
                                 std::chars_format::general, 12);
  return {text.data(), end.ptr};
}

/// Takes an ending away where it is there.
bool cut(std::string& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.resize(text.size() - end.size());
  return true;
}

}  // namespace

std::string plane_name(const Layer& layer, std::size_t plane) {
  std::string stem = layer.name, end;
  if (layer.axis.values.empty()) return stem + suffix_of(layer.units);
  const double value = layer.axis.values[plane];
  if (layer.meaning.statistic == Statistic::quantile ||
      layer.meaning.statistic == Statistic::source_quantile) {
    cut(stem, "_quantile");
    return stem + "_p" + percentage(value) + suffix_of(layer.units);
  }
  if (layer.meaning.is_bound())
    for (const char* bound : {"_lower", "_upper"})
      if (cut(stem, bound)) end = bound;
  return stem + "_" + digits(value) + suffix_of(layer.axis.units) + end;
}

}  // namespace sturz
