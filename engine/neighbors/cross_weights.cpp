// SPDX-License-Identifier: Apache-2.0
// Smoothing weights of the pairs across two sets, with the images in ground and walls.
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/neighbors/cross_pairs.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sturz {
namespace {

// Eight candidates are weighed side by side. No operation crosses lanes but the packing.
constexpr std::size_t lanes = 8;
using IntQuad = std::int32_t __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Floats = float __attribute__((vector_size(32)));

Floats root(Floats a) {
#if defined(__AVX__)
  return __builtin_ia32_sqrtps256(a);
#else
  for (std::size_t k = 0; k < lanes; ++k) a[k] = std::sqrt(a[k]);
  return a;
#endif
}

/// Bit k: whether lane k is true.
unsigned bits_of(Ints truth) {
#if defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskps256(reinterpret_cast<Floats>(truth)));
#else
  unsigned bits = 0;
  for (std::size_t k = 0; k < lanes; ++k) bits |= (truth[k] ? 1u : 0u) << k;
  return bits;
#endif
}

/// out[k] = a[order[k]]
Floats arranged(Floats a, Ints order) {
#if defined(__AVX2__)
  return __builtin_ia32_permvarsf256(a, order);
#else
  Floats out{};
  for (std::size_t k = 0; k < lanes; ++k) out[k] = a[static_cast<std::size_t>(order[k])];
  return out;
#endif
}

/// By bits: the lanes that are true, in order, before the others.
using Order = std::array<std::array<std::int32_t, lanes>, 1 << lanes>;
constexpr Order true_first() {
  Order out{};
  for (std::size_t bits = 0; bits < out.size(); ++bits) {
    std::size_t n = 0;
    for (const bool wanted : {true, false})
      for (std::size_t k = 0; k < lanes; ++k)
        if ((bits >> k & 1) == wanted) out[bits][n++] = static_cast<std::int32_t>(k);
  }
  return out;
}
alignas(64) constexpr Order order = true_first();

template <class To, class From>
To load(const From* from) {
  To out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

/// The smoothing kernel of squared distances in position units.
class Weights {
 public:
  Weights(double h, double unit) {
    const SmoothingKernel smoothing{h};
    to_s_ = static_cast<float>(unit / smoothing.support());
    norm_ = static_cast<float>(smoothing.value(0));
    slope_ = static_cast<float>(smoothing.discrete_gradient_factor());
  }
  void operator()(Floats distance2, Floats& weight, Floats& slope) const {
    const Floats left = 1 - root(distance2) * to_s_, none{};
    const Floats t = left > 0 ? left : none, t3 = t * t * t;
    weight = norm_ * t3 * t * (5 - 4 * t);
    slope = slope_ * t3;
  }

 private:
  float to_s_, norm_, slope_;
};

/// Eight places by component.
struct Places {
  Ints x, y, z;
  Floats gap;  ///< to the first mirror

  template <class Place>
  Places(const Place* places, const std::uint32_t* s) {
    const auto both = [&](std::size_t low, std::size_t high) {
      return __builtin_shufflevector(load<IntQuad>(places + s[low]),
                                     load<IntQuad>(places + s[high]), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Ints a = both(0, 4), b = both(1, 5), c = both(2, 6), d = both(3, 7);
    const Ints ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const Ints cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const Ints more_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const Ints more_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
    z = __builtin_shufflevector(more_ab, more_cd, 0, 1, 8, 9, 4, 5, 12, 13);
    gap = reinterpret_cast<Floats>(
        __builtin_shufflevector(more_ab, more_cd, 2, 3, 10, 11, 6, 7, 14, 15));
  }
};

}  // namespace

/// Eight entries more than there may be: whole lanes are read and written.
void PairSide::Weighed::make_room(std::size_t rows, std::size_t entries, bool gradients) {
  fit(runs, rows);
  fit(source, entries + lanes);
  fit(weight, entries + lanes);
  if (gradients) fit(slope, entries + lanes);
}

/// Weights of one block's rows.
class CrossPairs::Weigher {
 public:
  Weigher(PairSide& from, const PairSide& to, bool gradients, const CrossPairs& pairs)
      : from_(from), to_(to), gradients_(gradients), weights_(pairs.h_, pairs.unit_) {}

  void operator()(std::size_t block) {
    const std::size_t first = block * PairSide::block;
    const std::size_t rows = std::min(from_.n_rows() - first, PairSide::block);
    PairSide::Block& b = from_.blocks_[block];
    b.weighed.make_room(rows, b.candidate.size(), gradients_);
    b.images.resize(from_.mirrors_.size());
    for (std::size_t m = 0; m < b.images.size(); ++m) make_images(b.images[m], first, rows, m);
    std::size_t n = 0;
    for (std::size_t k = 0; k < rows; ++k) {
      for (PairSide::Weighed& images : b.images)
        if (!images.runs.empty())
          images.runs[k].begin = images.runs[k].end = k > 0 ? images.runs[k - 1].end : 0;
      const std::size_t begin = n;
      n = row(b, k, first + k, n);
      b.weighed.runs[k] = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(n)};
    }
  }

 private:
  /// Room for the images of rows near the mirror; far from it none is needed.
  void make_images(PairSide::Weighed& images, std::size_t first, std::size_t rows, std::size_t m) {
    std::size_t entries = 0;
    for (std::size_t r = first; r < first + rows; ++r)
      if (from_.near(r, m)) entries += from_.runs_[r].end - from_.runs_[r].begin;
    images.runs.clear();
    if (entries > 0) images.make_room(rows, entries, gradients_);
  }

  /// \return how many entries the block has then
  std::size_t row(PairSide::Block& b, std::size_t k, std::size_t r, std::size_t n) {
    const PairSide::Place here = from_.places_[r];
    const PairSide::Run run = from_.runs_[r];
    for (std::size_t at = run.begin; at < run.end; at += lanes) {
      const std::uint32_t* source = b.candidate.data() + at;
      const Places there(to_.places_.data(), source);
      const Floats dx = __builtin_convertvector(there.x - here.x, Floats);
      const Floats dy = __builtin_convertvector(there.y - here.y, Floats);
      const Floats dz = __builtin_convertvector(there.z - here.z, Floats);
      const auto left = static_cast<std::int32_t>(run.end - at);
      const Ints own = Ints{0, 1, 2, 3, 4, 5, 6, 7} < left;  // the rest belongs to the next row
      const Floats beyond = Floats{} + 1e30f,
                   distance2 = own ? dx * dx + dy * dy + dz * dz : beyond;
      Floats weight, slope;
      weights_(distance2, weight, slope);
      for (std::size_t m = 0; m < b.images.size(); ++m)
        if (from_.near(r, m))
          weight += images(b.images[m], k, from_.gap(r, m), m == 0 ? there.gap : gaps(m, source),
                           distance2, source);
      n = append(b.weighed, n, source, weight, slope);
    }
    return n;
  }

  Floats gaps(std::size_t m, const std::uint32_t* source) const {
    const float* gap = to_.mirrors_[m].gap.data();
    Floats out;
    for (std::size_t c = 0; c < lanes; ++c) out[c] = gap[source[c]];
    return out;
  }

  /// |r'|^2 = |r|^2 + 4 d_i d_j over a plane, as in the pair sweep (sweep/image_sums.hpp). What has
  /// an image within the support lies there itself.
  Floats images(PairSide::Weighed& to, std::size_t k, float own, Floats gap, Floats distance2,
                const std::uint32_t* source) const {
    const Floats sum = own + gap, least = sum * sum, apart = distance2 + 4 * own * gap;
    Floats weight, slope;
    weights_(apart > least ? apart : least, weight, slope);
    PairSide::Run& run = to.runs[k];
    run.end = static_cast<std::uint32_t>(append(to, run.end, source, weight, slope));
    return weight;
  }

  /// Those that have a weight. \return how many entries there are then
  std::size_t append(PairSide::Weighed& to, std::size_t n, const std::uint32_t* source,
                     Floats weight, Floats slope) const {
    const unsigned bits = bits_of(weight > 0);
    const Ints first = load<Ints>(order[bits].data());
    const Floats sources = arranged(load<Floats>(source), first);  // their bits, as they are
    weight = arranged(weight, first);
    std::memcpy(to.source.data() + n, &sources, sizeof sources);
    std::memcpy(to.weight.data() + n, &weight, sizeof weight);
    if (gradients_) {
      slope = arranged(slope, first);
      std::memcpy(to.slope.data() + n, &slope, sizeof slope);
    }
    return n + static_cast<std::size_t>(std::popcount(bits));
  }

  PairSide& from_;
  const PairSide& to_;
  bool gradients_;
  Weights weights_;
};

void CrossPairs::weigh(PairSide& from, const PairSide& to, bool gradients, int threads) const {
  expect(from.mirrors_.size() == to.mirrors_.size(), "both sets know of the ground, or none");
  parallel_ranges(from.n_rows(), PairSide::block, threads,
                  [&](std::size_t begin, std::size_t /*end*/) {
                    Weigher weigher(from, to, gradients, *this);
                    weigher(begin / PairSide::block);
                  });
}

}  // namespace sturz
