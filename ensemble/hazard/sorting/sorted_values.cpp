// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/sorting/sorted_values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace sturz {

void ValueSorter::sort(std::vector<float>& values) {
  if (values.size() < few) {
    std::sort(values.begin(), values.end());
    return;
  }
  constexpr int n_digits = 4, n_buckets = 256;
  std::array<std::array<std::uint32_t, n_buckets>, n_digits> counts{};
  keys_.resize(values.size());
  other_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    // -0 is 0 here: its bits would come last.
    const auto key = std::bit_cast<std::uint32_t>(values[i] + 0.0F);
    keys_[i] = key;
    for (int digit = 0; digit < n_digits; ++digit)
      ++counts[static_cast<std::size_t>(digit)][key >> (8 * digit) & 0xff];
  }
  for (int digit = 0; digit < n_digits; ++digit) {
    auto& count = counts[static_cast<std::size_t>(digit)];
    if (count[keys_[0] >> (8 * digit) & 0xff] == keys_.size()) continue;  // all alike
    std::uint32_t begin = 0;
    for (std::uint32_t& c : count) c = std::exchange(begin, begin + c);
    for (const std::uint32_t key : keys_) other_[count[key >> (8 * digit) & 0xff]++] = key;
    keys_.swap(other_);
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::bit_cast<float>(keys_[i]);
}

}  // namespace sturz
