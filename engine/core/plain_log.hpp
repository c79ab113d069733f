// SPDX-License-Identifier: Apache-2.0
/// Logarithms and powers in plain arithmetic, as plain_exp.hpp has exponentials.
#pragma once

#include "engine/core/plain_exp.hpp"

#include <bit>
#include <cstdint>

namespace sturz {

/// ln x within 2 units of the last place for normal x > 0; of 0 it is below -700.
inline double plain_log(double x) {
  // x = 2^n m with m in [sqrt(1/2), sqrt(2)); ln m = 2 artanh f, f = (m - 1)/(m + 1).
  constexpr std::uint64_t one = std::uint64_t{1023} << 52, half = 0x3fe6a09e667f3bcd;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t raised = (bits - half + one) >> 52;  // n + 1023
  // NOLINTNEXTLINE(modernize-use-auto): the type is what is said here
  const double m = std::bit_cast<double>(bits - (raised << 52) + one);
  // As a number by way of the last bits of 2^52, for lanes know no other.
  constexpr std::uint64_t shift = 0x4330000000000000;
  const double n = std::bit_cast<double>(raised | shift) - 4503599627370496.0 - 1023;
  const double f = (m - 1) / (m + 1), f2 = f * f, f4 = f2 * f2, f8 = f4 * f4;
  // f^2 < 0.0295: what is left out after f^21 is 2e-18.
  const double a = 1.0 / 3 + f2 * (1.0 / 5), b = 1.0 / 7 + f2 * (1.0 / 9);
  const double c = 1.0 / 11 + f2 * (1.0 / 13), d = 1.0 / 15 + f2 * (1.0 / 17);
  const double e = 1.0 / 19 + f2 * (1.0 / 21);
  const double tail = (a + f4 * b) + f8 * ((c + f4 * d) + f8 * e);
  const double low = n * 1.90821492927058770002e-10 + 2 * f * f2 * tail;
  return n * 6.93147180369123816490e-01 + (2 * f + low);
}

/// x^p for x >= 0, 0^p = 0 for p > 0; relative error |p ln x| times rounding.
inline double plain_pow(double x, double p) { return plain_exp(p * plain_log(x)); }

}  // namespace sturz
