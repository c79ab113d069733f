// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/random_words.hpp"

#include <Random123/philox.h>
#include <openturns/Log.hxx>
#include <openturns/RandomGenerator.hxx>

namespace sturz {
namespace {

std::mutex& generator_lock() {
  static std::mutex lock;
  return lock;
}

}  // namespace

std::uint32_t random_word(std::uint64_t seed, Stream stream, std::uint32_t index,
                          std::uint32_t block) {
  const r123::Philox4x32_R<10>::key_type key{
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const r123::Philox4x32_R<10>::ctr_type counter{
      {index, block, 0, static_cast<std::uint32_t>(stream)}};
  return r123::Philox4x32_R<10>{}(counter, key)[0];
}

double random_unit(std::uint64_t seed, Stream stream, std::uint32_t index, std::uint32_t block) {
  return (random_word(seed, stream, index, block) + 0.5) * 0x1p-32;
}

SeededGenerator::SeededGenerator(std::uint64_t seed, Stream stream, std::uint32_t index)
    : guard_(generator_lock()) {
  OT::Log::Show(OT::Log::NONE);
  OT::RandomGenerator::SetSeed(random_word(seed, stream, index));
}

}  // namespace sturz
