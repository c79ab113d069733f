// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/outcome.hpp"

#include <array>
#include <utility>

namespace sturz {
namespace {

constexpr std::array<std::pair<Outcome, std::string_view>, 6> words{{
    {Outcome::settled, "settled"},
    {Outcome::out_of_time, "out_of_time"},
    {Outcome::left_terrain, "left_terrain"},
    {Outcome::diverged, "diverged"},
    {Outcome::failed, "failed"},
    {Outcome::cancelled, "cancelled"},
}};

constexpr std::array<std::pair<Censoring, std::string_view>, 4> censorings{{
    {Censoring::none, "none"},
    {Censoring::left_terrain, "left_terrain"},
    {Censoring::still_moving, "still_moving"},
    {Censoring::left_and_moving, "left_and_moving"},
}};

}  // namespace

std::string_view to_string(Outcome outcome) {
  for (const auto& [value, word] : words)
    if (value == outcome) return word;
  return "failed";
}

std::optional<Outcome> outcome_from(std::string_view text) {
  for (const auto& [value, word] : words)
    if (word == text) return value;
  return std::nullopt;
}

std::string_view to_string(Censoring censoring) {
  for (const auto& [value, word] : censorings)
    if (value == censoring) return word;
  return "none";
}

std::optional<Censoring> censoring_from(std::string_view text) {
  for (const auto& [value, word] : censorings)
    if (word == text) return value;
  return std::nullopt;
}

}  // namespace sturz
