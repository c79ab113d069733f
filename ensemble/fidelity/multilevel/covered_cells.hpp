// SPDX-License-Identifier: Apache-2.0
/// The cells in which a member exceeds a threshold, and how far each cell lies from their outline.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <cstddef>
#include <cstdint>

namespace sturz {

/// What a map is the probability of.
struct Exceedance {
  PeakLayer layer = PeakLayer::arrival;
  float above = 0;  ///< [SI]; of an arrival nothing: reached where it is a number
  bool holds(float value) const { return is_arrival() ? value == value : value > above; }
  bool is_arrival() const;
};

/// 1 where it holds. \param extent cells of source.grid(); beyond the member's window it does not
/// hold
Raster<std::uint8_t> covered_cells(const MemberParts& source, std::size_t index, const Exceedance&,
                                   const Window& extent);

}  // namespace sturz
