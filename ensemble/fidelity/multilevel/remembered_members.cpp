// SPDX-License-Identifier: Apache-2.0
#include "ensemble/fidelity/multilevel/remembered_members.hpp"

#include <algorithm>
#include <array>

namespace sturz {
namespace {

/// What probability maps are of.
constexpr std::array together{PeakLayer::arrival, PeakLayer::thickness, PeakLayer::speed,
                              PeakLayer::energy, PeakLayer::pressure};

}  // namespace

void RememberedMembers::read_part(std::size_t index, PeakLayer layer, const Window& part,
                                  std::span<float> out) const {
  const Window& whole = members()[index].window;
  const auto key = std::pair(index, layer);
  auto kept = kept_.find(key);
  if (kept == kept_.end()) {
    // All at once: opening a member's file takes longer than reading a layer of it.
    std::vector<PeakLayer> layers{layer};
    if (std::find(together.begin(), together.end(), layer) != together.end())
      layers.assign(together.begin(), together.end());
    const std::size_t bytes = layers.size() * whole.n_cells() * sizeof(float);
    if (bytes > left_) {
      source_.read_part(index, layer, part, out);
      return;
    }
    left_ -= bytes;
    for (const PeakLayer one : layers) {
      std::vector<float>& values = kept_[std::pair(index, one)];
      values.resize(whole.n_cells());
      source_.read_part(index, one, whole, values);
    }
    kept = kept_.find(key);
  }
  for (int row = 0; row < part.n_rows; ++row)
    std::copy_n(kept->second.begin() +
                    static_cast<std::ptrdiff_t>(row + part.row0 - whole.row0) * whole.n_cols +
                    part.col0 - whole.col0,
                part.n_cols, out.begin() + static_cast<std::ptrdiff_t>(row) * part.n_cols);
}

}  // namespace sturz
