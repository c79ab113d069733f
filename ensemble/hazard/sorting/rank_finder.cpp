// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/rank_finder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace sturz {
namespace {

constexpr std::size_t most_buckets = 2048;  // they still lie in the processor's nearest cache

/// More of them leave fewer numbers to sort, and cost where there are not many.
int bucket_bits(std::size_t n_values) { return n_values < 512 ? 8 : n_values < 2048 ? 10 : 11; }

/// -0 is 0 here: its bits would come last.
std::uint32_t key_of(float value) { return std::bit_cast<std::uint32_t>(value + 0.0F); }

}  // namespace

/// What stands at place r is the largest number than which no more than r others are smaller.
/// Comparing all with all has no branches to guess wrong.
void RankFinder::compare_all(std::span<const float> values, std::span<const std::size_t> ranks,
                             std::span<float> out) {
  constexpr std::size_t step = 8;  // that are compared at a time
  const std::size_t n = values.size(), padded = (n + step - 1) / step * step;
  std::array<std::int32_t, few> keys, n_smaller;  // non-negative numbers: their bits are, too
  for (std::size_t i = 0; i < padded; ++i) {
    keys[i] = i < n ? static_cast<std::int32_t>(key_of(values[i])) : INT32_MAX;
    n_smaller[i] = 0;
  }
  for (std::size_t j = 0; j < n; ++j) {
    const std::int32_t key = keys[j];
    for (std::size_t i = 0; i < padded; ++i) n_smaller[i] += key < keys[i];
  }
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    const auto rank = static_cast<std::int32_t>(ranks[r]);
    std::int32_t largest = 0;
    for (std::size_t i = 0; i < padded; ++i)
      largest = std::max(largest, n_smaller[i] <= rank ? keys[i] : 0);
    out[r] = std::bit_cast<float>(largest);
  }
}

void RankFinder::find(std::span<const float> values, std::span<const std::size_t> ranks,
                      std::span<float> out) {
  if (ranks.empty()) return;  // mostly so where few members come: all quantiles are zero
  if (values.size() < few) return compare_all(values, ranks, out);
  std::uint32_t least = key_of(values[0]), most = least;
  for (const float v : values) {
    least = std::min(least, key_of(v));
    most = std::max(most, key_of(v));
  }
  const int bits = bucket_bits(values.size());
  const int shift = std::max(0, static_cast<int>(std::bit_width(most - least)) - bits);
  const auto bucket_of = [&](std::uint32_t key) { return (key - least) >> shift; };
  std::array<std::uint32_t, most_buckets> counts;
  std::fill_n(counts.begin(), std::size_t{1} << bits, 0U);
  for (const float v : values) ++counts[bucket_of(key_of(v))];

  // Where the bucket of each rank begins, and whether a bucket is wanted.
  std::array<bool, most_buckets> wanted;
  std::fill_n(wanted.begin(), std::size_t{1} << bits, false);
  std::size_t bucket = 0, before = 0, before_wanted = 0;
  keys_.clear();
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    for (; before + counts[bucket] <= ranks[r]; ++bucket) {
      before += counts[bucket];
      if (wanted[bucket]) before_wanted += counts[bucket];
    }
    wanted[bucket] = true;
    // For now: its place among the keys of wanted buckets, which are sorted below.
    out[r] = std::bit_cast<float>(static_cast<std::uint32_t>(before_wanted + ranks[r] - before));
  }
  for (const float v : values)
    if (const std::uint32_t key = key_of(v); wanted[bucket_of(key)]) keys_.push_back(key);
  std::sort(keys_.begin(), keys_.end());
  for (std::size_t r = 0; r < ranks.size(); ++r)
    out[r] = std::bit_cast<float>(keys_[std::bit_cast<std::uint32_t>(out[r])]);
}

}  // namespace sturz
