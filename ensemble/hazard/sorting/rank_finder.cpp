// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/rank_finder.hpp"

#include <algorithm>
#include <bit>

namespace sturz {
namespace {

/// -0 is 0 here: its bits would come last.
std::uint32_t key_of(float value) { return std::bit_cast<std::uint32_t>(value + 0.0F); }

/// Many buckets leave few numbers to sort, few are counted in faster: some sixteen numbers in each.
int bucket_bits(std::size_t n_values) {
  constexpr int least = 8, most = 11;  // the most still lie in the processor's nearest cache
  return std::clamp(static_cast<int>(std::bit_width(n_values)) - 4, least, most);
}

}  // namespace

void RankFinder::count(std::span<const float> values) {
  std::uint32_t least = key_of(values[0]), most = least;
  for (const float v : values) {
    least = std::min(least, key_of(v));
    most = std::max(most, key_of(v));
  }
  const int bits = bucket_bits(values.size());
  least_ = least;
  shift_ = std::max(0, static_cast<int>(std::bit_width(most - least)) - bits);
  counts_.assign(std::size_t{1} << bits, 0);
  std::uint32_t* const counts = counts_.data();
  const int shift = shift_;
  for (const float v : values) ++counts[(key_of(v) - least) >> shift];
}

/// Fills intervals_ with the keys of buckets in which a wanted place lies, and \param places with
/// each one's place among the numbers of these buckets, once those are sorted.
void RankFinder::choose(std::span<const std::size_t> ranks, std::span<std::size_t> places) {
  intervals_.clear();
  std::size_t bucket = 0, before = 0, before_wanted = 0, last = counts_.size();
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    for (; before + counts_[bucket] <= ranks[r]; ++bucket) {
      before += counts_[bucket];
      if (bucket == last) before_wanted += counts_[bucket];
    }
    if (bucket != last)
      intervals_.push_back({least_ + static_cast<std::uint32_t>(bucket << shift_),
                            static_cast<std::uint32_t>((std::size_t{1} << shift_) - 1)});
    last = bucket;
    places[r] = before_wanted + ranks[r] - before;
  }
}

/// Into keys_: those that lie in the intervals. Most groups of neighbours hold none.
void RankFinder::collect(std::span<const float> values) {
  constexpr std::size_t group = 16;
  keys_.clear();
  const auto wanted = [](std::uint32_t key, const Interval& i) {
    return static_cast<std::uint32_t>(key - i.first <= i.width);
  };
  for (std::size_t at = 0; at < values.size(); at += group) {
    const auto some = values.subspan(at, std::min(group, values.size() - at));
    if (some.size() == group) {
      std::uint32_t any = 0;
      for (const Interval& i : intervals_)
        for (std::size_t k = 0; k < group; ++k) any |= wanted(key_of(some[k]), i);
      if (any == 0) continue;
    }
    for (const float v : some)
      for (const Interval& i : intervals_)
        if (wanted(key_of(v), i) != 0) keys_.push_back(key_of(v));
  }
}

void RankFinder::find(std::span<const float> values, std::span<const std::size_t> ranks,
                      std::span<float> out) {
  if (values.size() < few) {
    keys_.resize(values.size());
    std::transform(values.begin(), values.end(), keys_.begin(), key_of);
    std::sort(keys_.begin(), keys_.end());
    for (std::size_t r = 0; r < ranks.size(); ++r) out[r] = std::bit_cast<float>(keys_[ranks[r]]);
    return;
  }
  places_.resize(ranks.size());
  count(values);
  choose(ranks, places_);
  collect(values);
  std::sort(keys_.begin(), keys_.end());
  for (std::size_t r = 0; r < ranks.size(); ++r) out[r] = std::bit_cast<float>(keys_[places_[r]]);
}

}  // namespace sturz
