// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/source_table.hpp"

#include "ensemble/workflow/region/region_folder.hpp"

#include <fmt/core.h>

#include <cmath>

namespace sturz::workflow {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::vector<SourceAreas> source_areas(const SourceLists& lists, std::size_t n_sources) {
  std::vector<SourceAreas> areas(n_sources);
  const double cell = lists.grid.cell_m * lists.grid.cell_m;
  for (std::size_t i = 0; i < lists.cells.size(); ++i) {
    const auto hits = lists.at(lists.cells[i]);
    for (const SourceHit& hit : hits) {
      areas[hit.source].possible += cell;
      if (hit.probability >= 0.5F) areas[hit.source].likely += cell;
    }
    areas[likeliest(hits, 0)].likeliest += cell;
  }
  return areas;
}

std::string source_table(const StoredMembers& members, const SourceLists& lists) {
  const std::vector<SourceAreas> areas = source_areas(lists, members.sources().size());
  std::string text =
      "number,source,folder,planned,finished,valid,cut_off,release_volume_m3,possible_area_m2,"
      "likely_area_m2,likeliest_area_m2,reason\n";
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const SourceState& s = members.sources()[i];
    const bool known = s.counts.valid > 0;
    const auto number = [&](double value) {
      return known && std::isfinite(value) ? fmt::format("{}", value) : std::string();
    };
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", i + 1, quoted(s.counts.name),
                        quoted("features/" + source_file_name(s.counts.name)), s.counts.planned,
                        s.finished, s.counts.valid, s.cut_off, number(s.release_volume_m3),
                        number(areas[i].possible), number(areas[i].likely),
                        number(areas[i].likeliest), quoted(s.failure));
  }
  return text;
}

}  // namespace sturz::workflow
