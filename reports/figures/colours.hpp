// SPDX-License-Identifier: Apache-2.0
/// Colour ramps whose lightness falls steadily, so that they order by eye, in grey print and for
/// colour-blind readers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// hazard: pale yellow to dark purple (probabilities); magnitude: pale green to navy (thickness,
/// speed, ...); arrival: dark to pale violet (early is dark); deposit: sand to dark brown;
/// neutral: light to dark grey-blue (counts, anything else).
enum class Ramp { hazard, magnitude, arrival, deposit, neutral };

/// `n` >= 1 colours evenly spread over the ramp, interpolated in Oklab (Ottosson 2020).
std::vector<Rgb> ramp_colours(Ramp ramp, int n);
/// Perceived lightness L of Oklab, 0 black .. 1 white.
double lightness(Rgb colour);
/// "#rrggbb"
std::string hex_text(Rgb colour);

}  // namespace sturz
