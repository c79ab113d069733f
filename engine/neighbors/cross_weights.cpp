// SPDX-License-Identifier: Apache-2.0
// Smoothing weights of the pairs across two sets, with the images in ground and walls.
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"
#include "engine/neighbors/cross_pairs.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace sturz {
namespace {

constexpr std::size_t chunk = 64;  // candidates that are weighed side by side
constexpr std::size_t whole_lanes(std::size_t n) { return (n + 7) / 8 * 8; }

using IntQuad = std::int32_t __attribute__((vector_size(16)));
using FloatQuad = float __attribute__((vector_size(16)));

/// The smoothing kernel of squared distances in position units.
class Weights {
 public:
  Weights(double h, double unit) {
    const SmoothingKernel kernel{h};
    to_s_ = static_cast<float>(unit / kernel.support());
    norm_ = static_cast<float>(kernel.value(0));
    slope_ = static_cast<float>(kernel.discrete_gradient_factor());
  }
  /// \param n  a multiple of eight, so that no lane is left over
  void operator()(const float* distance2, float* weight, float* slope, std::size_t n) const {
    for (std::size_t c = 0; c < n; ++c) {
      const float left = 1 - std::sqrt(distance2[c]) * to_s_, t = left > 0 ? left : 0;
      const float t3 = t * t * t;
      weight[c] = norm_ * t3 * t * (5 - 4 * t);
      slope[c] = slope_ * t3;
    }
  }

 private:
  float to_s_, norm_, slope_;
};

/// What is computed of a chunk of a row's candidates.
struct Chunk {
  alignas(64) float square[chunk][4] = {};
  alignas(64) float distance2[chunk] = {}, gap[chunk] = {}, mirrored[chunk] = {};
  alignas(64) float weight[chunk] = {}, slope[chunk] = {}, image[chunk] = {}, steep[chunk] = {};
};

/// Appends those of a chunk that have a weight. No branches: which do is not to be foreseen.
/// \return how many entries there are then
std::size_t append(const std::uint32_t* source, const float* weight, const float* slope,
                   std::size_t n, std::size_t at, std::uint32_t* to_source, float* to_weight,
                   float* to_slope, const float* decides) {
  for (std::size_t c = 0; c < n; ++c) {
    to_source[at] = source[c];
    to_weight[at] = weight[c];
    if (to_slope) to_slope[at] = slope[c];
    at += decides[c] > 0;
  }
  return at;
}

}  // namespace

/// One entry more than there may be: `append` writes before it knows.
void PairSide::Weighed::make_room(std::size_t rows, std::size_t entries, bool gradients) {
  fit(runs, rows);
  fit(source, entries + 1);
  fit(weight, entries + 1);
  if (gradients) fit(slope, entries + 1);
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
      const PairSide::Run run = from_.runs_[first + k];
      b.weighed.runs[k].begin = static_cast<std::uint32_t>(n);
      for (std::size_t m = 0; m < b.images.size(); ++m)
        if (!b.images[m].runs.empty()) {
          PairSide::Run* r = b.images[m].runs.data() + k;
          r->begin = r->end = k > 0 ? r[-1].end : 0;
        }
      for (std::size_t at = run.begin; at < run.end; at += chunk)
        n = row(b, k, first + k, b.candidate.data() + at, std::min(chunk, run.end - at), n);
      b.weighed.runs[k].end = static_cast<std::uint32_t>(n);
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

  std::size_t row(PairSide::Block& b, std::size_t k, std::size_t r, const std::uint32_t* source,
                  std::size_t n, std::size_t at) {
    const PairSide::Place& here = from_.places_[r];
    const IntQuad own{here.x, here.y, here.z, 0};
    for (std::size_t c = 0; c < n; ++c) {
      IntQuad there;
      std::memcpy(&there, &to_.places_[source[c]], sizeof there);
      const FloatQuad apart = __builtin_convertvector(there - own, FloatQuad);
      const FloatQuad square = apart * apart;
      std::memcpy(chunk_.square[c], &square, sizeof square);
    }
    const std::size_t padded = whole_lanes(n);
    for (std::size_t c = 0; c < padded; ++c)
      chunk_.distance2[c] = chunk_.square[c][0] + chunk_.square[c][1] + chunk_.square[c][2];
    weights_(chunk_.distance2, chunk_.weight, chunk_.slope, padded);
    for (std::size_t m = 0; m < b.images.size(); ++m)
      if (from_.near(r, m)) add_images(b.images[m], k, from_.gap(r, m), m, source, n);
    PairSide::Weighed& w = b.weighed;
    return append(source, chunk_.weight, chunk_.slope, n, at, w.source.data(), w.weight.data(),
                  gradients_ ? w.slope.data() : nullptr, chunk_.weight);
  }

  /// |r'|^2 = |r|^2 + 4 d_i d_j over a plane, as in the pair sweep (sweep/image_sums.hpp). What has
  /// an image within the support lies there itself.
  void add_images(PairSide::Weighed& images, std::size_t k, float own, std::size_t m,
                  const std::uint32_t* source, std::size_t n) {
    const float* gap = to_.mirrors_[m].gap.data();
    for (std::size_t c = 0; c < n; ++c) chunk_.gap[c] = gap[source[c]];
    const std::size_t padded = whole_lanes(n);
    for (std::size_t c = 0; c < padded; ++c) {
      const float sum = own + chunk_.gap[c], least = sum * sum;
      const float apart = chunk_.distance2[c] + 4 * own * chunk_.gap[c];
      chunk_.mirrored[c] = apart > least ? apart : least;
    }
    weights_(chunk_.mirrored, chunk_.image, chunk_.steep, padded);
    for (std::size_t c = 0; c < padded; ++c) chunk_.weight[c] += chunk_.image[c];
    PairSide::Run& run = images.runs[k];
    run.end = static_cast<std::uint32_t>(
        append(source, chunk_.image, chunk_.steep, n, run.end, images.source.data(),
               images.weight.data(), gradients_ ? images.slope.data() : nullptr, chunk_.image));
  }

  PairSide& from_;
  const PairSide& to_;
  bool gradients_;
  Weights weights_;
  Chunk chunk_;
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
