// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/rank_finder.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace sturz {
namespace {

constexpr std::size_t n_buckets = 256;

/// -0 is 0 here: its bits would come last.
std::uint32_t key_of(float value) { return std::bit_cast<std::uint32_t>(value + 0.0F); }

}  // namespace

void RankFinder::find(std::span<const float> values, std::span<const std::size_t> ranks,
                      std::span<float> out) {
  if (values.size() < few) {
    keys_.resize(values.size());
    std::transform(values.begin(), values.end(), keys_.begin(), key_of);
    std::sort(keys_.begin(), keys_.end());
    for (std::size_t r = 0; r < ranks.size(); ++r) out[r] = std::bit_cast<float>(keys_[ranks[r]]);
    return;
  }
  std::uint32_t least = key_of(values[0]), most = least;
  for (const float v : values) {
    least = std::min(least, key_of(v));
    most = std::max(most, key_of(v));
  }
  const int shift = std::max(0, static_cast<int>(std::bit_width(most - least)) - 8);
  const auto bucket_of = [&](std::uint32_t key) { return (key - least) >> shift; };
  std::array<std::uint32_t, n_buckets> counts{};
  for (const float v : values) ++counts[bucket_of(key_of(v))];

  // Where the bucket of each rank begins, and whether a bucket is wanted.
  std::array<bool, n_buckets> wanted{};
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
