// SPDX-License-Identifier: Apache-2.0
/// How one member ended, and whether its end was seen.
#pragma once

#include <optional>
#include <string_view>

namespace sturz {

/// The first three are valid members of an ensemble. `settled`: at rest by the stop rule, also
/// where the end time ended it. `out_of_time`: still moving then. `left_terrain`: more than 1 % of
/// the mass left the known ground or was lost.
enum class Outcome { settled, out_of_time, left_terrain, diverged, failed, cancelled };

inline constexpr bool is_valid(Outcome o) {
  return o == Outcome::settled || o == Outcome::out_of_time || o == Outcome::left_terrain;
}

std::string_view to_string(Outcome);
/// Inverse of to_string; empty for an unknown word.
std::optional<Outcome> outcome_from(std::string_view);

/// Why a member's end is not known. Runout, area, deposit and travel of a censored member are those
/// of the part that was seen: what it exceeds it does exceed, but the whole may be larger.
enum class Censoring {
  none,          ///< all mass came to rest on known ground
  left_terrain,  ///< some mass, however little, crossed the edge of the known ground
  still_moving,  ///< the end time came before the stop rule's rest
  left_and_moving
};

inline constexpr bool is_censored(Censoring c) { return c != Censoring::none; }
inline constexpr bool has_left(Censoring c) {
  return c == Censoring::left_terrain || c == Censoring::left_and_moving;
}
inline constexpr bool is_moving(Censoring c) {
  return c == Censoring::still_moving || c == Censoring::left_and_moving;
}
inline constexpr Censoring censoring_of(bool left, bool moving) {
  if (left) return moving ? Censoring::left_and_moving : Censoring::left_terrain;
  return moving ? Censoring::still_moving : Censoring::none;
}

std::string_view to_string(Censoring);
/// Inverse of to_string; empty for an unknown word.
std::optional<Censoring> censoring_from(std::string_view);

}  // namespace sturz
