// SPDX-License-Identifier: Apache-2.0
/// Exponentials in plain arithmetic: loops of them run four side by side, and give the same bits on
/// every processor and in the last odd columns of a loop too, which those of the C library do not.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace sturz {

/// e^x within 2 units of the last place; x is cut at +-700.
inline double plain_exp(double x) {
  x = x < -700 ? -700 : x;
  x = x > 700 ? 700 : x;
  // x = n ln 2 + r. The sum puts n into the last bits of a number, where the exponent takes it
  // from.
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52
  const double shifted = x * 1.4426950408889634 + shift, n = shifted - shift;
  const double r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  // Taylor to r^13 (|r| < 0.347: what is left out is 4e-18), in pairs, which wait for less.
  const double r2 = r * r, r4 = r2 * r2;
  const double a = 1.0 / 2 + r * (1.0 / 6), b = 1.0 / 24 + r * (1.0 / 120);
  const double c = 1.0 / 720 + r * (1.0 / 5040), d = 1.0 / 40320 + r * (1.0 / 362880);
  const double e = 1.0 / 3628800 + r * (1.0 / 39916800);
  const double f = 1.0 / 479001600 + r * (1.0 / 6227020800);
  const double tail = (a + r2 * b) + r4 * ((c + r2 * d) + r4 * (e + r2 * f));
  const std::uint64_t exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  return (1 + (r + r2 * tail)) * std::bit_cast<double>(exponent);
}

/// What decays at a constant rate, after x of its time constants.
struct Decay {
  double left;  ///< e^-x
  double mean;  ///< (1 - e^-x)/x, of what was there at the start
  double lag;   ///< (x - 1 + e^-x)/x^2, mean of what a constant source built up
};

inline Decay decay_over(double x) {
  const double left = plain_exp(-x);
  const bool small = std::abs(x) < 0.0625;
  const double y = small ? x : 0, divisor = small ? 1 : x;
  const double series =
      1.0 / 2 -
      y * (1.0 / 6 - y * (1.0 / 24 - y * (1.0 / 120 -
                                          y * (1.0 / 720 - y * (1.0 / 5040 - y * (1.0 / 40320))))));
  const double mean = (1 - left) / divisor, lag = (1 - mean) / divisor;
  return {left, small ? 1 - y * series : mean, small ? series : lag};
}

}  // namespace sturz
