// SPDX-License-Identifier: Apache-2.0
/// The members that an estimate counts, of a source that may hold more of them.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace sturz {

/// Members with numbers below n, so that a folder that once was asked for more gives the same.
class FirstMembers final : public MemberParts {
 public:
  /// \param source outlives it
  FirstMembers(const MemberParts& source, std::int64_t n) : source_(source) {
    std::copy_if(source.members().begin(), source.members().end(), std::back_inserter(members_),
                 [n](const MemberSummary& m) { return m.member < n; });
  }

  const std::vector<MemberSummary>& members() const override { return members_; }
  const Grid& grid() const override { return source_.grid(); }
  /// Numbers ascend, so that the first ones have the same index in both.
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override {
    source_.read_part(index, layer, part, out);
  }

 private:
  const MemberParts& source_;
  std::vector<MemberSummary> members_;
};

}  // namespace sturz
