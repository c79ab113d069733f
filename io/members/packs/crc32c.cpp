// SPDX-License-Identifier: Apache-2.0
#include "io/members/packs/crc32c.hpp"

#include <array>
#include <cstring>

#ifdef __SSE4_2__
#include <nmmintrin.h>
#endif

namespace sturz {

#ifdef __SSE4_2__

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) {
  std::uint64_t sum = ~before;
  while (bytes.size() >= sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    sum = _mm_crc32_u64(sum, word);
    bytes = bytes.subspan(sizeof word);
  }
  auto rest = static_cast<std::uint32_t>(sum);
  for (const std::byte b : bytes) rest = _mm_crc32_u8(rest, static_cast<std::uint8_t>(b));
  return ~rest;
}

#else

namespace {

constexpr std::array<std::uint32_t, 256> table() {
  constexpr std::uint32_t polynomial = 0x82f63b78u;
  std::array<std::uint32_t, 256> sums{};
  for (std::uint32_t i = 0; i < sums.size(); ++i) {
    sums[i] = i;
    for (int bit = 0; bit < 8; ++bit)
      sums[i] = (sums[i] >> 1) ^ ((sums[i] & 1) != 0 ? polynomial : 0);
  }
  return sums;
}

}  // namespace

std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t before) {
  static constexpr auto sums = table();
  std::uint32_t sum = ~before;
  for (const std::byte b : bytes)
    sum = (sum >> 8) ^ sums[(sum ^ static_cast<std::uint8_t>(b)) & 0xff];
  return ~sum;
}

#endif

}  // namespace sturz
