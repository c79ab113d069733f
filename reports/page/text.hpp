// SPDX-License-Identifier: Apache-2.0
/// Words and numbers as a page shows them: escaped, rounded, in the units that engineers use.
#pragma once

#include <string>
#include <string_view>

namespace sturz {

/// Text made safe for HTML content and double-quoted attributes.
std::string html_escape(std::string_view text);
/// JSON made safe inside a script element: no '<' is left, so no `</script` or `<!--` either.
std::string script_safe(const std::string& json);

/// `value` rounded to `digits` significant digits, thousands separated by narrow spaces from 10 000
/// on, real minus sign; an en dash for NaN. Whole numbers keep all their digits.
std::string shown_number(double value, int digits = 3);
/// The same without any grouping and with a plain minus: for labels that are read as numbers.
std::string plain_number(double value, int digits = 3);
/// Seconds as "48 s", "12 min 5 s", "3 h 20 min" or "2 d 4 h".
std::string duration_text(double seconds);
/// A fraction as "47 %"; "< 1 %" and "> 99 %" where rounding would say 0 or 100.
std::string percent_text(double fraction);

/// How a stored unit is shown: shown value = factor * stored value.
struct DisplayUnit {
  std::string label;  ///< "m", "m/s", "kJ/m²", "kPa", "s", or empty for pure numbers
  double factor = 1;
};
/// \param udunits text such as "m s-1"; unknown texts are shown as they are
DisplayUnit display_unit(std::string_view udunits);
/// `value` in stored units, converted, rounded, with its label: "100 kJ/m²".
std::string with_unit(double value, std::string_view udunits, int digits = 3);
/// An area as "0.42 km²", or in hectares or m² where those read better.
std::string area_text(double area_m2);
/// The same for both ends of a range, in the unit of the larger: "7 – 10.4 ha".
std::string area_text(double from_m2, double to_m2);
/// The same in the unit that `like_m2` is shown in, so that an interval can be compared with it.
std::string area_text(double from_m2, double to_m2, double like_m2);

/// "2026-11-30T22:09:27Z" as "2026-11-30 22:09 UTC"; other texts as they are.
std::string moment_text(const std::string& iso);
/// ` lang="en"` where the page speaks another language: for what other folders wrote, so that
/// browsers read, break and translate it as what it is.
std::string english_attribute();

/// "probability_of_x" or "basal.friction_coefficient" as words: "probability of x".
std::string words(std::string_view identifier);
/// Likewise without the unit at its end: "outline distance" of "outline_distance_m".
std::string words_without_unit(std::string_view identifier);

}  // namespace sturz
