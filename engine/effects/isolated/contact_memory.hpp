// SPDX-License-Identifier: Apache-2.0
/// What contacts of isolated particles carry from step to step, found again by the ids of the two.
#pragma once

#include "engine/effects/isolated/bodies.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

namespace sturz {

class ContactMemory {
 public:
  /// Gives contacts their tangential springs back and measures them. What an overlap grew by since
  /// then came from no approach (a grain became isolated, the ground's plane jumped): that part
  /// carries no load until it has opened again, so it sets no energy free. Rounding of positions
  /// and of the ground's plane, 1e-4 of the radius, is left to the springs.
  void recall(std::vector<IsolatedContact>& contacts,
              const std::vector<IsolatedBody>& bodies) const {
    for (IsolatedContact& c : contacts) {
      const Entry key = entry(c, bodies);
      const auto found = std::lower_bound(entries_.begin(), entries_.end(), key, before);
      double loaded = 0;
      if (found != entries_.end() && !before(key, *found)) {
        c.history = found->history;
        c.unloaded = found->unloaded;
        loaded = found->loaded;
      }
      measure(c, bodies);
      if (c.loaded() > loaded + 1e-4 * bodies[c.a].radius) c.unloaded = c.overlap - loaded;
    }
  }

  void remember(const std::vector<IsolatedContact>& contacts,
                const std::vector<IsolatedBody>& bodies) {
    entries_.clear();
    for (const IsolatedContact& c : contacts)
      if (c.overlap > 0) entries_.push_back(entry(c, bodies));
    std::sort(entries_.begin(), entries_.end(), before);
  }

  std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  struct Entry {
    std::uint32_t first = 0, second = 0;  // ids, or IsolatedContact::ground
    Vec3 history{0, 0, 0};
    double loaded = 0, unloaded = 0;
  };
  static bool before(const Entry& a, const Entry& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  }
  static Entry entry(const IsolatedContact& c, const std::vector<IsolatedBody>& bodies) {
    const std::uint32_t second = c.b == IsolatedContact::ground ? c.b : bodies[c.b].id;
    return {bodies[c.a].id, second, c.history, c.loaded(), c.unloaded};
  }

  std::vector<Entry> entries_;
};

}  // namespace sturz
