// SPDX-License-Identifier: Apache-2.0
/// The pair loop of a step, chosen once by instruction set and active terms.
#pragma once

#include "engine/neighbors/column_records.hpp"
#include "engine/neighbors/neighbor_records.hpp"

#include <cstddef>
#include <string_view>

namespace sturz {

enum class InstructionSet { plain, avx2, avx512 };

std::string_view to_string(InstructionSet);
/// What this processor can run; never more than what was built.
bool supports(InstructionSet);
InstructionSet best_instruction_set();

/// The sweeps of one instruction set. All give the same bits on avx2 and avx512.
struct Sweeps {
  /// One fused pass over groups [first, last): dense stress force, velocity gradient, density
  /// diffusion (dense/sums.hpp).
  void (*dense)(const NeighborView&, const SweepConstants&, const BoundaryView&, const SweepOutput&,
                std::size_t first_group, std::size_t last_group);
  /// The same where grains may disperse: kinetic stresses, conduction of granular temperature, how
  /// full each support is (kinetic/sums.hpp). Groups without dispersed grains in or near them
  /// take `dense`.
  void (*kinetic)(const NeighborView&, const KineticView&, const SweepConstants&,
                  const BoundaryView&, const SweepOutput&, std::size_t first_group,
                  std::size_t last_group);
  /// Appends to `out` those of `candidates` that lie within `radius_units` of any particle of the
  /// group that starts at record `first`, in the given order. Returns how many.
  std::size_t (*tight_list)(const NeighborRecord* records, std::size_t first, int n_in_group,
                            const std::uint32_t* candidates, std::size_t n_candidates,
                            float radius_units, std::uint32_t* out);
  /// One pass over groups [first, last) of depth-averaged columns (columns/sums.hpp).
  void (*columns)(const ColumnView&, const ColumnConstants&, const ColumnSweepOutput&,
                  std::size_t first_group, std::size_t last_group);
  /// The same across two sets of columns (phases/sums.hpp).
  void (*across)(const AcrossView&, bool steep, const AcrossOutput&, std::size_t first_group,
                 std::size_t last_group);
};
const Sweeps& sweeps(InstructionSet);

}  // namespace sturz
