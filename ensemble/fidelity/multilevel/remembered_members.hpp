// SPDX-License-Identifier: Apache-2.0
/// Members whose layers are read many times.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sturz {

/// Keeps what was read of another source, as long as memory allows; what does not fit is read each
/// time. For one thread.
class RememberedMembers final : public MemberParts {
 public:
  /// \param source outlives it
  RememberedMembers(const MemberParts& source, std::size_t memory_bytes)
      : source_(source), left_(memory_bytes) {}

  const std::vector<MemberSummary>& members() const override { return source_.members(); }
  const Grid& grid() const override { return source_.grid(); }
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override;

 private:
  const MemberParts& source_;
  mutable std::size_t left_;
  mutable std::map<std::pair<std::size_t, PeakLayer>, std::vector<float>> kept_;  // whole windows
};

}  // namespace sturz
