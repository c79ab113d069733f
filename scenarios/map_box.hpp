// SPDX-License-Identifier: Apache-2.0
/// A rectangle along map x and y, as data.
#pragma once

#include <array>

namespace sturz {

struct MapBox {
  std::array<double, 2> x_m{}, y_m{};
  bool operator==(const MapBox&) const = default;
};

}  // namespace sturz
