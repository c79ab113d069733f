// SPDX-License-Identifier: Apache-2.0
/// sources.csv: a row for each source of a region.
#pragma once

#include "ensemble/workflow/region/region_members.hpp"
#include "scenarios/layers/source_lists.hpp"

#include <string>
#include <vector>

namespace sturz::workflow {

/// Areas of one source on the maps [m2].
struct SourceAreas {
  double possible = 0;   ///< some member comes
  double likely = 0;     ///< half of the members come
  double likeliest = 0;  ///< no other source is more probable (of equal ones the first)
};
std::vector<SourceAreas> source_areas(const SourceLists& lists, std::size_t n_sources);

/// RFC 4180: number (as in most_likely_source and hit_source), source, folder, planned, finished,
/// valid, cut_off, release_volume_m3 (of the first valid member), possible_area_m2, likely_area_m2,
/// likeliest_area_m2, reason (why it could not be computed).
std::string source_table(const StoredMembers&, const SourceLists&);

}  // namespace sturz::workflow
