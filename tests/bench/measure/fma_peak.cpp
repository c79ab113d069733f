// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/fma_peak.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace sturz::bench {
namespace {

constexpr int chains = 12;  // enough to hide four to five cycles of latency on two ports
constexpr long rounds = 100'000;
volatile float sink;  // keeps the loops from being optimised away

#if defined(__x86_64__)
__attribute__((target("avx512f"))) double burst_avx512() {
  __m512 sum[chains];
  const __m512 factor = _mm512_set1_ps(0.999f), add = _mm512_set1_ps(1e-3f);
  for (__m512& s : sum) s = add;
  for (long r = 0; r < rounds; ++r)
    for (__m512& s : sum) s = _mm512_fmadd_ps(s, factor, add);
  __m512 total = sum[0];
  for (int k = 1; k < chains; ++k) total = _mm512_add_ps(total, sum[k]);
  alignas(64) float lanes[16];
  _mm512_store_ps(lanes, total);
  sink = lanes[0];
  return 2.0 * 16 * chains * rounds;
}

__attribute__((target("avx2,fma"))) double burst_avx2() {
  __m256 sum[chains];
  const __m256 factor = _mm256_set1_ps(0.999f), add = _mm256_set1_ps(1e-3f);
  for (__m256& s : sum) s = add;
  for (long r = 0; r < rounds; ++r)
    for (__m256& s : sum) s = _mm256_fmadd_ps(s, factor, add);
  __m256 total = sum[0];
  for (int k = 1; k < chains; ++k) total = _mm256_add_ps(total, sum[k]);
  alignas(32) float lanes[8];
  _mm256_store_ps(lanes, total);
  sink = lanes[0];
  return 2.0 * 8 * chains * rounds;
}
#endif

double burst_plain() {
  constexpr int width = 8 * chains;
  float sum[width];
  for (float& s : sum) s = 1e-3f;
  for (long r = 0; r < rounds; ++r)
    for (float& s : sum) s = __builtin_fmaf(s, 0.999f, 1e-3f);
  float total = 0;
  for (float s : sum) total += s;
  sink = total;
  return 2.0 * width * rounds;
}

}  // namespace

double fma_burst(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return burst_avx512();
  if (set == InstructionSet::avx2) return burst_avx2();
#endif
  (void)set;
  return burst_plain();
}

}  // namespace sturz::bench
