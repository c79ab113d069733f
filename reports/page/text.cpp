// SPDX-License-Identifier: Apache-2.0
#include "reports/page/text.hpp"

#include "reports/texts/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz {
namespace {

constexpr const char* narrow_space = "\u202F";
constexpr const char* minus_sign = "\u2212";

std::string grouped(const std::string& digits) {
  if (digits.size() < 5) return digits;
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += narrow_space;
    out += digits[i];
  }
  return out;
}

/// "8.69e-12" as "8.69 x 10^-12" is written in print.
std::string with_power_of_ten(const std::string& text) {
  static constexpr const char* raised[] = {"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                           "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::string number = text.substr(0, e);
  if (const std::size_t dot = number.find('.'); dot != std::string::npos)
    number.replace(dot, 1, tr("number.decimal"));
  number += "\u00A0\u00D7\u00A010";
  if (text[e + 1] == '-') number += "\u207B";
  const std::string digits = text.substr(text.find_first_not_of("+-0", e + 1));
  for (const char c : digits) number += raised[c - '0'];
  return number;
}

}  // namespace

std::string html_escape(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      case '\0':
        out += "\uFFFD";
        break;
      default:
        out += c;
    }
  return out;
}

std::string script_safe(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

std::string plain_number(double value, int digits) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221E" : "-\u221E";
  if (value == 0) return "0";
  const double size = std::floor(std::log10(std::abs(value)));
  if (size < -6 || size > 14) return fmt::format("{:.{}e}", value, digits - 1);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(size));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string shown_number(double value, int digits) {
  std::string text = plain_number(value, digits);
  const bool negative = text.starts_with('-');
  if (negative) text.erase(0, 1);
  if (text.find_first_not_of("0123456789.") == std::string::npos) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    const std::string decimals = text.substr(std::min(dot + 1, text.size()));
    text =
        grouped(text.substr(0, dot)) + (dot < text.size() ? tr("number.decimal") : "") + decimals;
  } else {
    text = with_power_of_ten(text);
  }
  return negative ? minus_sign + text : text;
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0)) return "\u2013";
  if (seconds < 10) return shown_number(seconds, 2) + " s";
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{} d {} h", whole / 86400, whole / 3600 % 24);
}

std::string percent_text(double fraction) {
  if (std::isnan(fraction)) return "\u2013";
  const double percent = 100 * fraction;
  if (percent > 0 && percent < 1) return "<\u00A01\u00A0%";
  if (percent < 100 && percent > 99) return ">\u00A099\u00A0%";
  return fmt::format("{:.0f}\u00A0%", percent);
}

DisplayUnit display_unit(std::string_view udunits) {
  struct Row {
    std::string_view udunits;
    const char* label;
    double factor;
  };
  static constexpr std::array<Row, 19> table{{{"m", "m", 1},
                                              {"m2", "m²", 1},
                                              {"m3", "m³", 1},
                                              {"m s-1", "m/s", 1},
                                              {"m s-2", "m/s²", 1},
                                              {"m-1", "1/m", 1},
                                              {"Pa s", "Pa s", 1},
                                              {"J m-2", "kJ/m²", 1e-3},
                                              {"Pa", "kPa", 1e-3},
                                              {"kJ m-2", "kJ/m²", 1},
                                              {"kPa", "kPa", 1},
                                              {"s", "s", 1},
                                              {"1", "", 1},
                                              {"", "", 1},
                                              {"degree", "°", 1},
                                              {"kg m-3", "kg/m³", 1},
                                              {"m3 s-1", "m³/s", 1},
                                              {"N m-1", "kN/m", 1e-3},
                                              {"kg", "t", 1e-3}}};
  for (const auto& row : table)
    if (row.udunits == udunits) return {row.label, row.factor};
  return {std::string(udunits), 1};
}

std::string with_unit(double value, std::string_view udunits, int digits) {
  const DisplayUnit unit = display_unit(udunits);
  const std::string text = shown_number(unit.factor * value, digits);
  return unit.label.empty() || std::isnan(value) ? text : text + "\u00A0" + unit.label;
}

namespace {
struct AreaUnit {
  const char* label;
  double square_metres;
};
AreaUnit area_unit(double area_m2) {
  if (area_m2 >= 1e6) return {"km²", 1e6};
  if (area_m2 >= 1e4) return {"ha", 1e4};
  return {"m²", 1};
}
}  // namespace

std::string area_text(double area_m2) {
  if (std::isnan(area_m2)) return "\u2013";
  const AreaUnit unit = area_unit(area_m2);
  return shown_number(area_m2 / unit.square_metres) + "\u00A0" + unit.label;
}

std::string area_text(double from_m2, double to_m2) { return area_text(from_m2, to_m2, to_m2); }

std::string area_text(double from_m2, double to_m2, double like_m2) {
  const AreaUnit unit = area_unit(like_m2);
  return shown_number(from_m2 / unit.square_metres) + "\u00A0\u2013\u00A0" +
         shown_number(to_m2 / unit.square_metres) + "\u00A0" + unit.label;
}

std::string moment_text(const std::string& iso) {
  const bool known = iso.size() == 20 && iso[10] == 'T' && iso.back() == 'Z';
  return known ? iso.substr(0, 10) + " " + iso.substr(11, 5) + " UTC" : iso;
}

std::string english_attribute() { return page_language() == "en" ? "" : " lang=\"en\""; }

std::string words(std::string_view identifier) {
  std::string out(identifier);
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string words_without_unit(std::string_view identifier) {
  for (const std::string_view unit : {"_m_s", "_m2", "_m3", "_m", "_s"})
    if (identifier.ends_with(unit)) {
      identifier.remove_suffix(unit.size());
      break;
    }
  return words(identifier);
}

}  // namespace sturz
