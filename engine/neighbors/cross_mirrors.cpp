// SPDX-License-Identifier: Apache-2.0
// Images in ground and walls of the pairs across two sets.
#include "engine/core/error.hpp"
#include "engine/neighbors/cross_pairs.hpp"
#include "engine/neighbors/smoothing_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {

/// Distances to ground and walls, and which way they point.
void CrossPairs::mirror(PairSide& side, const Set& set, const Domain& domain, double time) const {
  std::size_t n = set.ground.distance ? 1 : 0;
  for (const Wall& wall : domain.walls) n += time < wall.remove_at_s;
  side.mirrors_.resize(n);
  const auto far = static_cast<float>(support_ / unit_);
  const auto prepare = [&](PairSide::Mirror& m) {
    m.gap.resize(side.n_sources());
    for (auto* c : {&m.nx, &m.ny, &m.nz}) c->resize(side.n_rows());
    m.near.resize(side.n_rows());
  };
  const auto finish = [&](PairSide::Mirror& m) {
    for (std::size_t r = 0; r < side.n_rows(); ++r) m.near[r] = m.gap[r] < far;
    for (std::size_t k = 0; k < side.image_row_.size(); ++k)
      m.gap[side.n_rows() + k] = m.gap[side.image_row_[k]];
  };
  const auto in_units = [&](double distance) {
    return std::min(far, static_cast<float>(std::max(0.0, distance) / unit_));
  };
  std::size_t at = 0;
  if (set.ground.distance) {
    PairSide::Mirror& m = side.mirrors_[at++];
    prepare(m);
    for (std::size_t r = 0; r < side.n_rows(); ++r) {
      const std::uint32_t i = side.index_[r];
      m.gap[r] = in_units(set.ground.distance[i]);
      m.nx[r] = set.ground.nx[i], m.ny[r] = set.ground.ny[i], m.nz[r] = set.ground.nz[i];
    }
    finish(m);
  }
  for (const Wall& wall : domain.walls) {
    if (time >= wall.remove_at_s) continue;
    PairSide::Mirror& m = side.mirrors_[at++];
    prepare(m);
    const ParticleSet& p = set.particles;
    for (std::size_t r = 0; r < side.n_rows(); ++r) {
      const std::uint32_t i = side.index_[r];
      m.gap[r] = in_units((Vec3(p.x[i], p.y[i], p.z[i]) - wall.point).dot(wall.normal));
    }
    std::fill(m.nx.begin(), m.nx.end(), static_cast<float>(wall.normal.x()));
    std::fill(m.ny.begin(), m.ny.end(), static_cast<float>(wall.normal.y()));
    std::fill(m.nz.begin(), m.nz.end(), static_cast<float>(wall.normal.z()));
    finish(m);
  }
}

/// Adds to the weights of a block what images in ground and walls give: |r'|^2 = |r|^2 + 4 d_i d_j
/// over a plane, as in the pair sweep (image_sums.hpp).
void CrossPairs::add_mirrored(PairSide& from, const PairSide& to, bool gradients,
                              std::size_t block) const {
  PairSide::Block& b = from.blocks_[block];
  const std::size_t first = block * PairSide::block;
  const std::size_t last = std::min(from.n_rows(), first + PairSide::block);
  const SmoothingKernel smoothing{h_};
  const auto to_s = static_cast<float>(unit_ / support_);
  const auto norm = static_cast<float>(smoothing.value(0));
  const auto slope = static_cast<float>(smoothing.discrete_gradient_factor());
  const std::int32_t *to_x = to.x_.data(), *to_y = to.y_.data(), *to_z = to.z_.data();
  const std::uint32_t* source = b.source.data();
  constexpr std::uint32_t chunk = 64;
  expect(from.mirrors_.size() == to.mirrors_.size(), "both sets know of the ground, or none");
  b.images.resize(from.mirrors_.size());
  for (std::size_t m = 0; m < from.mirrors_.size(); ++m) {
    PairSide::ImageBlock& images = b.images[m];
    images.weight.resize(b.source.size());
    images.slope.resize(gradients ? b.source.size() : 0);
    const float* __restrict gap = to.mirrors_[m].gap.data();
    float* __restrict weight = b.weight.data();
    for (std::size_t r = first; r < last; ++r) {
      if (!from.near(r, m)) continue;
      const float own = from.mirrors_[m].gap[r];
      const std::int32_t x = from.x_[r], y = from.y_[r], z = from.z_[r];
      const std::uint32_t end = from.runs_[r].end;
      for (std::uint32_t k = from.runs_[r].begin; k < end; k += chunk) {
        const std::uint32_t n = std::min(chunk, end - k);
        float apart[chunk], sum[chunk];  // so that the arithmetic runs over plain arrays
        for (std::uint32_t c = 0; c < n; ++c) {
          const std::uint32_t s = source[k + c];
          const auto dx = static_cast<float>(to_x[s] - x), dy = static_cast<float>(to_y[s] - y),
                     dz = static_cast<float>(to_z[s] - z);
          apart[c] = dx * dx + dy * dy + dz * dz + 4 * own * gap[s];
          sum[c] = own + gap[s];
        }
        float value[chunk], steep[chunk];
        for (std::uint32_t c = 0; c < n; ++c) {
          const float least = sum[c] * sum[c], r2 = apart[c] > least ? apart[c] : least;
          const float left = 1 - std::sqrt(r2) * to_s, t = left > 0 ? left : 0;
          const float t3 = t * t * t;
          value[c] = norm * t3 * t * (5 - 4 * t);
          steep[c] = slope * t3;
        }
        for (std::uint32_t c = 0; c < n; ++c) weight[k + c] += value[c];
        std::copy(value, value + n, images.weight.begin() + k);
        if (gradients) std::copy(steep, steep + n, images.slope.begin() + k);
      }
    }
  }
}

}  // namespace sturz
