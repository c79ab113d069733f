// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/plane_name.hpp"

#include <array>
#include <charconv>
#include <string_view>

namespace sturz {
namespace {

/// "kJ_m2" of "kJ m-2", nothing of "1".
std::string unit_word(std::string_view udunits) {
  if (udunits.empty() || udunits == "1") return {};
  std::string text;
  for (const char c : udunits)
    if (c != '-') text += c == ' ' ? '_' : c;
  // In the way of the scenario's keys: m s-1 is m_s, not m_s1.
  if (text.ends_with("1")) text.pop_back();
  return text;
}

/// "_kj_m2", as keys have it.
std::string suffix_of(std::string_view udunits) {
  std::string text = unit_word(udunits);
  if (text.empty()) return text;
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  text.insert(text.begin(), '_');
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

bool is_quantile(const Layer& layer) {
  return layer.meaning.statistic == Statistic::quantile ||
         layer.meaning.statistic == Statistic::source_quantile;
}

/// "P_reached" of "probability_of_reach", "P_high_intensity" of "probability_of_high_intensity";
/// other names stay.
std::string people_word(std::string name) {
  constexpr std::string_view long_word = "probability_of_";
  if (!name.starts_with(long_word)) return name;
  name.replace(0, long_word.size(), "P_");
  if (cut(name, "reach")) name += "reached";
  return name;
}

}  // namespace

std::string plane_name(const Layer& layer, std::size_t plane) {
  std::string stem = layer.name, end;
  if (layer.axis.values.empty()) return stem + suffix_of(layer.units);
  const double value = layer.axis.values[plane];
  if (is_quantile(layer)) {
    cut(stem, "_quantile");
    return stem + "_p" + percentage(value) + suffix_of(layer.units);
  }
  if (layer.meaning.is_bound())
    for (const char* bound : {"_lower", "_upper"})
      if (cut(stem, bound)) end = bound;
  return stem + "_" + digits(value) + suffix_of(layer.axis.units) + end;
}

std::string plane_file_name(const Layer& layer, std::size_t plane) {
  std::string stem = layer.name, end;
  const std::string unit = layer.units == "year-1" ? "per_year" : unit_word(layer.units);
  const std::string after = unit.empty() ? unit : "_" + unit;
  if (layer.meaning.is_bound())
    for (const char* bound : {"_lower", "_upper"})
      if (cut(stem, bound)) end = bound;
  if (layer.axis.values.empty()) return people_word(stem) + after + end;
  const double value = layer.axis.values[plane];
  if (is_quantile(layer)) {
    cut(stem, "_quantile");
    return stem + "_p" + percentage(value) + after;
  }
  const std::string of_axis = unit_word(layer.axis.units);
  // A difference of probabilities keeps its own words: it is none.
  if (layer.meaning.statistic != Statistic::difference && cut(stem, "_exceedance"))
    return "P_" + stem + "_gt_" + digits(value) + of_axis + end;
  return stem + "_" + digits(value) + (of_axis.empty() ? "" : "_" + of_axis) + end;
}

}  // namespace sturz
