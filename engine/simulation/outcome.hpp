// SPDX-License-Identifier: Apache-2.0
/// How one member ended.
#pragma once

#include <optional>
#include <string_view>

namespace sturz {

/// The first three are valid members of an ensemble (the second and third are flagged).
enum class Outcome { settled, out_of_time, left_terrain, diverged, failed, cancelled };

inline constexpr bool is_valid(Outcome o) {
  return o == Outcome::settled || o == Outcome::out_of_time || o == Outcome::left_terrain;
}

std::string_view to_string(Outcome);
/// Inverse of to_string; empty for an unknown word.
std::optional<Outcome> outcome_from(std::string_view);

}  // namespace sturz
