// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/height_unit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sturz {
namespace {

constexpr double foot = 0.3048, survey_foot = 1200.0 / 3937.0;

bool is_metre(double metres) { return std::abs(metres - 1) < 1e-9; }

/// What the vertical part of a system says.
struct VerticalPart {
  double metres = 0;  ///< per unit; 0: there is no vertical part
  std::string unit;
  bool down = false;
};

VerticalPart vertical_part(const OGRSpatialReference* crs) {
  VerticalPart part;
  if (crs == nullptr || !crs->IsVertical()) return part;
  const char* unit = nullptr;
  part.metres = crs->GetTargetLinearUnits("VERT_CS", &unit);
  part.unit = unit == nullptr ? "" : unit;
  OGRAxisOrientation direction = OAO_Other;
  crs->GetAxis(nullptr, crs->IsCompound() ? 2 : 0, &direction);
  part.down = direction == OAO_Down;
  return part;
}

}  // namespace

double metres_per_unit(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* known : {"", "m", "metre", "metres", "meter", "meters"})
    if (word == known) return 1;
  for (const char* known : {"ft", "foot", "feet", "international foot"})
    if (word == known) return foot;
  for (const char* known : {"us survey foot", "us-ft", "ftus", "us_survey_foot", "us foot"})
    if (word == known) return survey_foot;
  if (word == "cm" || word == "centimetre" || word == "centimeter") return 0.01;
  if (word == "mm" || word == "millimetre" || word == "millimeter") return 0.001;
  if (word == "dm" || word == "decimetre" || word == "decimeter") return 0.1;
  if (word == "km" || word == "kilometre" || word == "kilometer") return 1000;
  return 0;
}

HeightUnit height_unit(const OGRSpatialReference& settled, const OGRSpatialReference* own,
                       const std::string& word, const std::string& label) {
  HeightUnit result;
  const VerticalPart asked = vertical_part(&settled), filed = vertical_part(own);
  std::string unit = word;
  if (asked.metres > 0) {
    unit = asked.unit;
    result.metres = asked.metres;
    const double band = word.empty() ? 0 : metres_per_unit(word);
    if (band > 0 && std::abs(band / asked.metres - 1) > 1e-9)
      result.warning = fmt::format(
          "{}: the band says '{}', its coordinate system {} says '{}'; the system's unit is used",
          label, word, crs_name(settled), unit);
  } else if (!word.empty()) {
    result.metres = metres_per_unit(word);
    if (result.metres == 0) {
      result.warning =
          fmt::format("{}: unit '{}' is not known; values are taken as metres", label, word);
      result.metres = 1;
    }
  } else if (filed.metres > 0) {
    unit = filed.unit;
    result.metres = filed.metres;
  } else if (settled.IsProjected() && !is_metre(settled.GetLinearUnits())) {
    const char* map_unit = nullptr;
    settled.GetLinearUnits(&map_unit);
    result.warning = fmt::format(
        "{}: its map is in {}, and nothing says in which unit its heights are; they are taken as "
        "metres. If they are feet, name a height system, such as terrain.crs: EPSG:2263+6360",
        label, map_unit == nullptr ? "another unit than the metre" : map_unit);
  }
  result.down = asked.down;
  if (!is_metre(result.metres))
    result.note = fmt::format("{}: values converted from {} to metres (x {:.9g})", label, unit,
                              result.metres);
  else
    result.metres = 1;
  return result;
}

}  // namespace sturz
