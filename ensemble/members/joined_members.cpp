// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/joined_members.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace sturz {

JoinedMembers::JoinedMembers(std::vector<const MemberParts*> ensembles)
    : ensembles_(std::move(ensembles)) {
  expect(!ensembles_.empty(), "something is joined");
  for (std::size_t e = 0; e < ensembles_.size(); ++e) {
    const std::vector<MemberSummary>& own = ensembles_[e]->members();
    std::vector<std::size_t> order(own.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return own[a].member < own[b].member; });
    for (const std::size_t i : order) {
      members_.push_back(own[i]);
      members_.back().member = static_cast<std::int64_t>(members_.size()) - 1;
      ensemble_.push_back(e);
      index_in_.push_back(i);
      if (is_valid(own[i].outcome)) ensemble_of_valid_.push_back(e);
    }
  }
}

void JoinedMembers::read_part(std::size_t index, PeakLayer layer, const Window& part,
                              std::span<float> out) const {
  ensembles_[ensemble_[index]]->read_part(index_in_[index], layer, part, out);
}

void JoinedMembers::read_touched(std::size_t index, const Window& part,
                                 std::span<const PeakLayer> layers, TouchedCells& out) const {
  ensembles_[ensemble_[index]]->read_touched(index_in_[index], part, layers, out);
}

}  // namespace sturz
