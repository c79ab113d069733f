// SPDX-License-Identifier: Apache-2.0
/// What took how long, in an order that means something.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sturz {

using NamedSeconds = std::vector<std::pair<std::string, double>>;

/// To the entry of that name, or to a new one at the end.
inline void add_seconds(NamedSeconds& times, std::string_view name, double seconds) {
  auto entry =
      std::find_if(times.begin(), times.end(), [&](const auto& e) { return e.first == name; });
  if (entry == times.end()) entry = times.insert(times.end(), {std::string(name), 0.0});
  entry->second += seconds;
}

}  // namespace sturz
