// SPDX-License-Identifier: Apache-2.0
/// Random numbers by index: the same number for the same key and counter, whichever caller asks and
/// when.
///
/// Philox4x32-10 (Salmon et al. 2011) through Random123. There is no state to carry along, so a
/// member drawn alone, after a resume or among thousands gets the same bits.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace sturz {

using RandomWords = std::array<std::uint32_t, 4>;

/// Four words for a 64-bit key and a 128-bit counter, low word first.
inline RandomWords random_words(std::uint64_t key, const RandomWords& counter) {
  const r123::Philox4x32::key_type k{
      {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
  const r123::Philox4x32::ctr_type c{{counter[0], counter[1], counter[2], counter[3]}};
  const auto w = r123::Philox4x32{}(c, k);
  return {w[0], w[1], w[2], w[3]};
}

/// Uniform in the open interval (0, 1) with steps of 2^-32.
inline double unit_from(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

/// Uniform in the open interval (0, 1) with steps of 2^-52: safe to put into a quantile function.
inline double unit_random(std::uint64_t key, std::uint64_t a, std::uint64_t b = 0) {
  const RandomWords w =
      random_words(key, {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32),
                         static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(b >> 32)});
  const std::uint64_t bits = (static_cast<std::uint64_t>(w[0]) << 32 | w[1]) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

}  // namespace sturz
