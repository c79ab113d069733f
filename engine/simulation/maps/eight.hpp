// SPDX-License-Identifier: Apache-2.0
/// Eight floats that move together: a vector of the compiler's, which every target has.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sturz {

using Eight [[gnu::vector_size(32)]] = float;

inline Eight eight_at(const float* p) {
  Eight v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void put_eight(float* p, const Eight& v) { std::memcpy(p, &v, sizeof v); }
inline Eight larger(const Eight& a, const Eight& b) { return a > b ? a : b; }
inline Eight smaller(const Eight& a, const Eight& b) { return a < b ? a : b; }
/// Whether a comparison of two vectors holds anywhere.
template <class Truth>
bool any(const Truth& lanes) {
  static_assert(sizeof lanes == sizeof(Eight));
  std::uint64_t parts[4];
  std::memcpy(parts, &lanes, sizeof parts);
  return (parts[0] | parts[1] | parts[2] | parts[3]) != 0;
}
inline Eight root(Eight v) {
  float each[8];
  put_eight(each, v);
  for (float& x : each) x = std::sqrt(x);
  return eight_at(each);
}

/// Eight by eight, rows to columns. \param in  [8 x 8] by rows
inline void transpose_eight(const float* in, Eight (&out)[8]) {
  Eight a[8], b[8];
  for (int k = 0; k < 8; ++k) a[k] = eight_at(in + std::ptrdiff_t{8} * k);
  for (int k = 0; k < 8; k += 2) {  // pairs of rows, interleaved
    b[k] = __builtin_shufflevector(a[k], a[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    b[k + 1] = __builtin_shufflevector(a[k], a[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 8; k += 4)
    for (int j = k; j < k + 2; ++j) {
      a[j] = __builtin_shufflevector(b[j], b[j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      a[j + 2] = __builtin_shufflevector(b[j], b[j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int j = 0; j < 4; ++j) {
    out[j] = __builtin_shufflevector(a[j], a[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    out[j + 4] = __builtin_shufflevector(a[j], a[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace sturz
