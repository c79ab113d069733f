// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/remembered_members.hpp"

#include <algorithm>

namespace sturz {

void RememberedMembers::read_part(std::size_t index, PeakLayer layer, const Window& part,
                                  std::span<float> out) const {
  const Window& whole = members()[index].window;
  const auto key = std::pair(index, layer);
  auto kept = kept_.find(key);
  if (kept == kept_.end()) {
    const std::size_t bytes = whole.n_cells() * sizeof(float);
    if (bytes > left_) {
      source_.read_part(index, layer, part, out);
      return;
    }
    left_ -= bytes;
    kept = kept_.emplace(key, std::vector<float>(whole.n_cells())).first;
    source_.read_part(index, layer, whole, kept->second);
  }
  for (int row = 0; row < part.n_rows; ++row)
    std::copy_n(kept->second.begin() +
                    static_cast<std::ptrdiff_t>(row + part.row0 - whole.row0) * whole.n_cols +
                    part.col0 - whole.col0,
                part.n_cols, out.begin() + static_cast<std::ptrdiff_t>(row) * part.n_cols);
}

}  // namespace sturz
