// SPDX-License-Identifier: Apache-2.0
/// A hash of bits, to see whether two results are the same: FNV-1a, 64 bits. Not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace sturz {

/// Takes in bytes piece by piece; the pieces' borders do not matter.
class Hash64 {
 public:
  Hash64& add(std::span<const std::byte> bytes) {
    for (std::byte b : bytes) value_ = (value_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    return *this;
  }
  /// The bits of plain values in storage order (so -0.0 and 0.0 differ, as do NaN payloads).
  template <class T>
  requires std::is_trivially_copyable_v<T> Hash64& add(std::span<const T> values) {
    return add(std::as_bytes(values));
  }
  template <class T>
  requires std::is_arithmetic_v<T> Hash64& add(T value) {
    return add(std::as_bytes(std::span<const T, 1>(&value, 1)));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Hash of one array.
template <class T>
std::uint64_t hash_of(std::span<const T> values) {
  return Hash64{}.add(values).value();
}

}  // namespace sturz
