// SPDX-License-Identifier: Apache-2.0
/// Members of several ensembles of one site as one source.
#pragma once

#include "engine/simulation/member_parts.hpp"

#include <cstddef>
#include <vector>

namespace sturz {

/// Members are numbered through: those of the first ensemble, those of the second, and so on.
class JoinedMembers final : public MemberParts {
 public:
  /// \pre at least one; all lie on the same grid and outlive this
  explicit JoinedMembers(std::vector<const MemberParts*> ensembles);

  const std::vector<MemberSummary>& members() const override { return members_; }
  const Grid& grid() const override { return ensembles_.front()->grid(); }
  void read_part(std::size_t index, PeakLayer layer, const Window& part,
                 std::span<float> out) const override;
  void read_touched(std::size_t index, const Window& part, std::span<const PeakLayer> layers,
                    TouchedCells& out) const override;

  std::size_t n_ensembles() const { return ensembles_.size(); }
  /// Ensemble of each valid member, in the order in which MemberCells counts them.
  const std::vector<std::size_t>& ensemble_of_valid() const { return ensemble_of_valid_; }

 private:
  std::vector<const MemberParts*> ensembles_;
  std::vector<MemberSummary> members_;
  std::vector<std::size_t> ensemble_, index_in_;  // of each member
  std::vector<std::size_t> ensemble_of_valid_;
};

}  // namespace sturz
