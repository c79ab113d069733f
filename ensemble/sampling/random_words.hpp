// SPDX-License-Identifier: Apache-2.0
/// Random bits as a pure function of where they are needed; and the one generator of OpenTURNS.
#pragma once

#include <cstdint>
#include <mutex>

namespace sturz {

/// Keeps apart the streams that one seed feeds.
enum class Stream : std::uint32_t {
  generator_seed = 0x64657369,
  digital_shift = 0x73686966,
  trajectory = 0x74726a79,
  chain = 0x63686169,
  resample = 0x72736d70,
};

/// 32 random bits of (seed, stream, index, block).
std::uint32_t random_word(std::uint64_t seed, Stream stream, std::uint32_t index,
                          std::uint32_t block = 0);
/// The same on the open interval (0, 1).
double random_unit(std::uint64_t seed, Stream stream, std::uint32_t index, std::uint32_t block = 0);

/// OpenTURNS has one generator for the whole process: who uses it holds this, and it is seeded
/// anew each time. Its seed has 32 bits; mixing lets all 64 of ours count.
class SeededGenerator {
 public:
  explicit SeededGenerator(std::uint64_t seed, Stream stream = Stream::generator_seed,
                           std::uint32_t index = 0);

 private:
  std::lock_guard<std::mutex> guard_;
};

}  // namespace sturz
