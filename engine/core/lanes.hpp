// SPDX-License-Identifier: Apache-2.0
/// A handful of float lanes that move together: the only place that knows an instruction set.
///
/// Included by the sweep files only, each compiled for one instruction set into its own namespace
/// STURZ_ISA. Every operation is IEEE (explicit fma, true sqrt and division) and no operation
/// crosses lanes, so 16 lanes of AVX-512 and two rounds of 8 lanes of AVX2 give the same bits.
#pragma once

#include <cstdint>

#if !defined(STURZ_PLAIN_LANES) && (defined(__AVX512F__) || defined(__AVX2__))
#include <immintrin.h>
#endif

namespace sturz::STURZ_ISA {

#if defined(__AVX512F__) && !defined(STURZ_PLAIN_LANES)

struct Lanes {
  static constexpr int width = 16;
  __m512 v;
  static Lanes all(float a) { return {_mm512_set1_ps(a)}; }
  static Lanes load(const float* p) { return {_mm512_loadu_ps(p)}; }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
};
inline Lanes operator+(Lanes a, Lanes b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {_mm512_div_ps(a.v, b.v)}; }
/// a b + c
inline Lanes fma(Lanes a, Lanes b, Lanes c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
/// c - a b
inline Lanes fnma(Lanes a, Lanes b, Lanes c) { return {_mm512_fnmadd_ps(a.v, b.v, c.v)}; }
inline Lanes max(Lanes a, Lanes b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Lanes sqrt(Lanes a) { return {_mm512_sqrt_ps(a.v)}; }
/// yes where a < b, else no
inline Lanes select_less(Lanes a, Lanes b, Lanes yes, Lanes no) {
  return {_mm512_mask_blend_ps(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ), no.v, yes.v)};
}
inline bool any_less(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ) != 0; }
/// float(load(p)[lane] - j): exact integer difference, one rounding.
struct IntLanes {
  __m512i v;
  static IntLanes load(const std::int32_t* p) { return {_mm512_loadu_si512(p)}; }
};
inline Lanes difference(IntLanes a, std::int32_t j) {
  return {_mm512_cvtepi32_ps(_mm512_sub_epi32(a.v, _mm512_set1_epi32(j)))};
}

#elif defined(__AVX2__) && !defined(STURZ_PLAIN_LANES)

struct Lanes {
  static constexpr int width = 8;
  __m256 v;
  static Lanes all(float a) { return {_mm256_set1_ps(a)}; }
  static Lanes load(const float* p) { return {_mm256_loadu_ps(p)}; }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
};
inline Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Lanes operator/(Lanes a, Lanes b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Lanes fma(Lanes a, Lanes b, Lanes c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Lanes fnma(Lanes a, Lanes b, Lanes c) { return {_mm256_fnmadd_ps(a.v, b.v, c.v)}; }
inline Lanes max(Lanes a, Lanes b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Lanes sqrt(Lanes a) { return {_mm256_sqrt_ps(a.v)}; }
inline Lanes select_less(Lanes a, Lanes b, Lanes yes, Lanes no) {
  return {_mm256_blendv_ps(no.v, yes.v, _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ))};
}
inline bool any_less(Lanes a, Lanes b) {
  return _mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)) != 0;
}
struct IntLanes {
  __m256i v;
  static IntLanes load(const std::int32_t* p) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
  }
};
inline Lanes difference(IntLanes a, std::int32_t j) {
  return {_mm256_cvtepi32_ps(_mm256_sub_epi32(a.v, _mm256_set1_epi32(j)))};
}

#else  // other architectures: the same formulas lane by lane, without the promise of equal bits

struct Lanes {
  static constexpr int width = 8;
  float v[width];
  static Lanes all(float a) {
    Lanes r;
    for (float& x : r.v) x = a;
    return r;
  }
  static Lanes load(const float* p) {
    Lanes r;
    for (int k = 0; k < width; ++k) r.v[k] = p[k];
    return r;
  }
  void store(float* p) const {
    for (int k = 0; k < width; ++k) p[k] = v[k];
  }
};
template <class F>
inline Lanes each(F f) {
  Lanes r;
  for (int k = 0; k < Lanes::width; ++k) r.v[k] = f(k);
  return r;
}
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return each([&](int k) { return a.v[k] + b.v[k]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return each([&](int k) { return a.v[k] - b.v[k]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return each([&](int k) { return a.v[k] * b.v[k]; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return each([&](int k) { return a.v[k] / b.v[k]; });
}
inline Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) {
  return each([&](int k) { return a.v[k] * b.v[k] + c.v[k]; });
}
inline Lanes fnma(const Lanes& a, const Lanes& b, const Lanes& c) {
  return each([&](int k) { return c.v[k] - a.v[k] * b.v[k]; });
}
inline Lanes max(const Lanes& a, const Lanes& b) {
  return each([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes sqrt(const Lanes& a) {
  return each([&](int k) { return __builtin_sqrtf(a.v[k]); });
}
inline Lanes select_less(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
  return each([&](int k) { return a.v[k] < b.v[k] ? yes.v[k] : no.v[k]; });
}
inline bool any_less(const Lanes& a, const Lanes& b) {
  for (int k = 0; k < Lanes::width; ++k)
    if (a.v[k] < b.v[k]) return true;
  return false;
}
struct IntLanes {
  std::int32_t v[Lanes::width];
  static IntLanes load(const std::int32_t* p) {
    IntLanes r;
    for (int k = 0; k < Lanes::width; ++k) r.v[k] = p[k];
    return r;
  }
};
inline Lanes difference(const IntLanes& a, std::int32_t j) {
  return each([&](int k) { return static_cast<float>(a.v[k] - j); });
}

#endif

}  // namespace sturz::STURZ_ISA
