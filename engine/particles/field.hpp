// SPDX-License-Identifier: Apache-2.0
/// Typed names of the values that effects add to particles: a misspelt field does not compile.
#pragma once

#include <cstdint>
#include <vector>

namespace sturz {

/// A field of real numbers. Its identity is its address: declare one `inline constexpr` object per
/// field, next to its owner's others (engine/effects/fields.hpp).
struct FieldKey {
  const char* name;    ///< lower-case words, for messages
  int components;      ///< 1 scalar, 3 vector, 6 symmetric tensor xx yy zz xy yz zx
  const char* unit;    ///< SI; "1" where there is none
  const char* owner;   ///< the effect that adds it
  double initial = 0;  ///< of a particle that enters
};

/// A field of small whole numbers, one byte a particle: counters, flags and enumerations.
struct FlagKey {
  const char* name;
  const char* owner;
  std::uint8_t initial = 0;
};

/// Values of a FieldKey, [components][n].
struct Field {
  const FieldKey* key;
  std::vector<std::vector<double>> component;
};

/// Values of a FlagKey, [n].
struct Flags {
  const FlagKey* key;
  std::vector<std::uint8_t> value;
};

}  // namespace sturz
