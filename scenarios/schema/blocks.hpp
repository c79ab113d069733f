// SPDX-License-Identifier: Apache-2.0
/// A block of a scenario file as its path of members through Scenario. The files of the key table
/// name the blocks that they have rows for.
#pragma once

#include "scenarios/scenario.hpp"

#include <optional>
#include <type_traits>
#include <utility>

namespace sturz {

/// Where a group of keys lives: `find` gives nullptr while an optional block is absent, `make` puts
/// it there with its defaults.
template <class Owner>
struct Block {
  const Owner* (*find)(const Scenario&);
  Owner& (*make)(Scenario&);
};

namespace blocks {

template <class T>
const T* inside(const T& member) {
  return &member;
}
template <class T>
const T* inside(const std::optional<T>& member) {
  return member ? &*member : nullptr;
}
template <class T>
T& made(T& member) {
  return member;
}
template <class T>
T& made(std::optional<T>& member) {
  return member ? *member : member.emplace();
}

/// Follows members from owner to owner; those that are std::optional are entered or made.
template <auto first, auto... rest>
struct Path {
  template <class Owner>
  static auto find(const Owner& owner) {
    const auto* next = inside(owner.*first);
    if constexpr (sizeof...(rest) == 0)
      return next;
    else
      return next ? Path<rest...>::find(*next) : nullptr;
  }
  template <class Owner>
  static auto& make(Owner& owner) {
    auto& next = made(owner.*first);
    if constexpr (sizeof...(rest) == 0)
      return next;
    else
      return Path<rest...>::make(next);
  }
};

template <auto... members>
using OwnerAt =
    std::remove_reference_t<decltype(Path<members...>::make(std::declval<Scenario&>()))>;

/// The block at the end of the path.
template <auto... members>
inline constexpr Block<OwnerAt<members...>> at{
    [](const Scenario& s) -> const OwnerAt<members...>* { return Path<members...>::find(s); },
    [](Scenario& s) -> OwnerAt<members...>& { return Path<members...>::make(s); }};

inline constexpr Block<Scenario> scene{[](const Scenario& s) { return &s; },
                                       [](Scenario& s) -> Scenario& { return s; }};

}  // namespace blocks
}  // namespace sturz
