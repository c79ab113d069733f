// SPDX-License-Identifier: Apache-2.0
/// What took how long, in an order that means something.
#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <set>
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

/// The same, to be kept of a hundred thousand: who has the same names shares them.
class SharedSeconds {
 public:
  SharedSeconds() = default;
  SharedSeconds(const NamedSeconds& times) {
    if (times.empty()) return;
    std::vector<std::string> names;
    for (const auto& [name, seconds] : times) {
      names.push_back(name);
      seconds_.push_back(seconds);
    }
    names_ = shared(std::move(names));
  }
  bool empty() const { return seconds_.empty(); }
  NamedSeconds named() const {
    NamedSeconds times;
    for (std::size_t i = 0; i < seconds_.size(); ++i) times.emplace_back((*names_)[i], seconds_[i]);
    return times;
  }

 private:
  using Names = std::vector<std::string>;
  /// Never destroyed: there are as many as there are kinds of scenes.
  static const Names* shared(Names names) {
    static auto* lock = new std::mutex;
    static auto* all = new std::set<Names>;
    const std::lock_guard guard(*lock);
    return &*all->insert(std::move(names)).first;
  }

  const Names* names_ = nullptr;
  std::vector<double> seconds_;
};

}  // namespace sturz
