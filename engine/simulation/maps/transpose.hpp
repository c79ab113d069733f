// SPDX-License-Identifier: Apache-2.0
/// Eight by eight floats, rows to columns.
#pragma once

#include <cstring>

namespace sturz {

/// \param in   [8 x 8] by rows  \param out  the eight columns
inline void transpose_eight(const float* in, float* const* out) {
  using Eight [[gnu::vector_size(32)]] = float;
  Eight a[8], b[8];
  std::memcpy(a, in, sizeof a);
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
    b[j] = __builtin_shufflevector(a[j], a[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    b[j + 4] = __builtin_shufflevector(a[j], a[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
  for (int j = 0; j < 8; ++j) std::memcpy(out[j], &b[j], sizeof b[j]);
}

}  // namespace sturz
