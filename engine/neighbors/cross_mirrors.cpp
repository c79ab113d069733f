// SPDX-License-Identifier: Apache-2.0
// Ground and walls in which pairs across two sets have images.
#include "engine/core/parallel.hpp"
#include "engine/neighbors/cross_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sturz {
namespace {

/// Distance of particle i to ground or wall along its normal [m].
class Distance {
 public:
  explicit Distance(const float* ground) : ground_(ground) {}
  Distance(const ParticleSet& p, const Wall& wall) : set_(&p), wall_(&wall) {}
  double operator()(std::uint32_t i) const {
    if (ground_) return ground_[i];
    return (Vec3(set_->x[i], set_->y[i], set_->z[i]) - wall_->point).dot(wall_->normal);
  }

 private:
  const float* ground_ = nullptr;
  const ParticleSet* set_ = nullptr;
  const Wall* wall_ = nullptr;
};

/// Calls body(number, distance, wall) for the ground, whose wall is null, and walls that still
/// stand. \return how many there are
template <class Body>
std::size_t each_mirror(const CrossPairs::Set& set, const Domain& domain, double time,
                        Body&& body) {
  std::size_t n = 0;
  if (set.ground.distance) body(n++, Distance(set.ground.distance), nullptr);
  for (const Wall& wall : domain.walls)
    if (time < wall.remove_at_s) body(n++, Distance(set.particles, wall), &wall);
  return n;
}

}  // namespace

float CrossPairs::gap_units(double distance) const {
  const auto far = static_cast<float>(support_ / unit_);
  return std::min(far, static_cast<float>(std::max(0.0, distance) / unit_));
}

/// Distances to ground and walls, and which way they point.
void CrossPairs::mirror(PairSide& side, const Set& set, const Domain& domain, double time,
                        int threads) const {
  side.mirrors_.resize(each_mirror(set, domain, time, [](auto&&...) {}));
  side.far_ = static_cast<float>(support_ / unit_);
  const std::size_t n = side.n_rows();
  each_mirror(set, domain, time, [&](std::size_t k, const Distance& distance, const Wall* wall) {
    PairSide::Mirror& m = side.mirrors_[k];
    fit(m.gap, side.n_sources());
    for (auto* c : {&m.nx, &m.ny, &m.nz}) fit(*c, n);
    parallel_ranges(n, reduction_block, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        const std::uint32_t i = side.index_[r];
        m.gap[r] = gap_units(distance(i));
        const CrossPairs::Ground& g = set.ground;
        m.nx[r] = wall ? static_cast<float>(wall->normal.x()) : g.nx[i];
        m.ny[r] = wall ? static_cast<float>(wall->normal.y()) : g.ny[i];
        m.nz[r] = wall ? static_cast<float>(wall->normal.z()) : g.nz[i];
      }
    });
    side.copy_images(m.gap);
    for (std::size_t s = 0; k == 0 && s < side.n_sources(); ++s) side.places_[s].gap = m.gap[s];
  });
}

/// How much nearer to, or farther from, ground or a wall a particle has come since its gaps were
/// looked up, where images are near [m]: no more than what changes a weight as much where the
/// smoothing kernel is steepest. The normal of rough ground turns from cell to cell, and high above
/// it gaps jump that hardly weigh.
double CrossPairs::approach(const PairSide& side, const Set& set, const Domain& domain, double time,
                            int threads) const {
  if (side.mirrors_.size() != each_mirror(set, domain, time, [](auto&&...) {}))
    return std::numeric_limits<double>::infinity();
  const double per_s = unit_ / support_;
  // |dW/dr| of an image no nearer than the gap, over its largest, 20 t^3 s at s = 1/4.
  const auto steepness = [&](float gap) {
    const double s = gap * per_s, t = 1 - s;
    return s < 0.25 ? 1 : t * t * t * s / (0.25 * 0.75 * 0.75 * 0.75);
  };
  double most = 0;
  each_mirror(set, domain, time, [&](std::size_t k, const Distance& distance, const Wall*) {
    const float* gap = side.mirrors_[k].gap.data();
    most = ordered_reduce(
        side.n_rows(), threads, most,
        [&](std::size_t begin, std::size_t end, double& out) {
          for (std::size_t r = begin; r < end; ++r) {  // both are cut at 2h
            const float now = gap_units(distance(side.index_[r]));
            if (now == gap[r]) continue;
            out = std::max(out, std::abs(now - gap[r]) * steepness(std::min(now, gap[r])));
          }
        },
        [](double& total, double block) { total = std::max(total, block); });
  });
  return most * unit_;
}

}  // namespace sturz
