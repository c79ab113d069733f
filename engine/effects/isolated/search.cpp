// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/isolated/search.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace sturz {
namespace {

constexpr int bits = 21;  // of each index in a cell's number
constexpr double last_index = (1 << bits) - 3;

/// A particle far away or nowhere (NaN) falls into the last cell: slow, never wrong.
std::uint64_t index_along(double distance, double cell, int offset) {
  const double i = distance > 0 ? std::min(distance / cell, last_index) : 0;
  const auto shifted = static_cast<std::int64_t>(i) + 1 + offset;  // neighbours of 0 are 0
  return static_cast<std::uint64_t>(shifted);
}

}  // namespace

std::uint64_t IsolatedSearch::cell_of(const Vec3& p, int dx, int dy, int dz) const {
  return index_along(p.z() - origin_.z(), cell_, dz) << (2 * bits) |
         index_along(p.y() - origin_.y(), cell_, dy) << bits |
         index_along(p.x() - origin_.x(), cell_, dx);
}

void IsolatedSearch::add_images(const Period& period, int axis, double margin) {
  if (!period.active) return;
  const std::size_t n = entries_.size();
  for (std::size_t k = 0; k < n; ++k) {
    Entry image = entries_[k];
    image.own = false;
    if (image.position[axis] < period.min + margin) {
      image.position[axis] += period.length();
      image.position.z() += period.rise;
    } else if (image.position[axis] > period.max - margin) {
      image.position[axis] -= period.length();
      image.position.z() -= period.rise;
    } else {
      continue;
    }
    entries_.push_back(image);
  }
}

void IsolatedSearch::enter(const std::vector<IsolatedSphere>& spheres, const Domain& domain,
                           double margin) {
  entries_.clear();
  for (std::uint32_t k = 0; k < spheres.size(); ++k) {
    Entry e{0, k, true, spheres[k].position};
    domain.wrap(e.position.x(), e.position.y(), e.position.z());
    entries_.push_back(e);
  }
  add_images(domain.x, 0, margin);
  add_images(domain.y, 1, margin);
  origin_ = entries_.front().position;
  for (const Entry& e : entries_)
    for (int axis = 0; axis < 3; ++axis)
      if (e.position[axis] < origin_[axis]) origin_[axis] = e.position[axis];
  for (Entry& e : entries_) e.cell = cell_of(e.position, 0, 0, 0);
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.cell, a.sphere) < std::tie(b.cell, b.sphere);
  });
}

bool IsolatedSearch::still_good(const std::vector<IsolatedSphere>& spheres, double max_gap) const {
  if (spheres.size() != searched_.size()) return false;
  const double slack = 0.5 * (searched_gap_ - max_gap);
  if (!(slack > 0)) return false;
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const IsolatedSphere &now = spheres[k], &then = searched_[k];
    // A wrapped position is far off, a NaN anywhere.
    if (now.id != then.id || now.radius != then.radius) return false;
    if (!((now.position - then.position).squaredNorm() <= slack * slack)) return false;
  }
  return true;
}

const std::vector<NearPair>& IsolatedSearch::find(const std::vector<IsolatedSphere>& spheres,
                                                  double max_gap, const Domain& domain) {
  pairs_.clear();
  if (spheres.size() < 2) return pairs_;
  if (!still_good(spheres, max_gap)) search(spheres, max_gap, domain);
  for (const NearPair& p : within_) {
    const IsolatedSphere &a = spheres[p.a], &b = spheres[p.b];
    const double limit = a.radius + b.radius + max_gap;
    if ((b.position + p.image - a.position).squaredNorm() < limit * limit) pairs_.push_back(p);
  }
  return pairs_;
}

void IsolatedSearch::search(const std::vector<IsolatedSphere>& spheres, double max_gap,
                            const Domain& domain) {
  double radius = 0;
  for (const IsolatedSphere& s : spheres) radius = std::max(radius, s.radius);
  ++n_grids_;
  within_.clear();
  searched_ = spheres;
  searched_gap_ = max_gap + radius;
  cell_ = 2 * radius + searched_gap_;
  enter(spheres, domain, cell_);

  const auto before = [](const Entry& e, std::uint64_t cell) { return e.cell < cell; };
  for (const Entry& e : entries_) {
    if (!e.own) continue;
    const IsolatedSphere& a = spheres[e.sphere];
    for (int row = 0; row < 9; ++row) {
      const int dy = row % 3 - 1, dz = row / 3 - 1;
      const std::uint64_t last = cell_of(e.position, 1, dy, dz);
      auto other = std::lower_bound(entries_.begin(), entries_.end(),
                                    cell_of(e.position, -1, dy, dz), before);
      for (; other != entries_.end() && other->cell <= last; ++other) {
        const IsolatedSphere& b = spheres[other->sphere];
        if (a.id >= b.id) continue;  // found from the other side
        const double limit = a.radius + b.radius + searched_gap_;
        if (!((e.position - other->position).squaredNorm() < limit * limit)) continue;
        const Vec3 image = (other->position - b.position) - (e.position - a.position);
        within_.push_back({e.sphere, other->sphere, image});
      }
    }
  }
  std::sort(within_.begin(), within_.end(), [&](const NearPair& p, const NearPair& q) {
    return std::tie(spheres[p.a].id, spheres[p.b].id) < std::tie(spheres[q.a].id, spheres[q.b].id);
  });
}

std::size_t IsolatedSearch::bytes() const {
  return entries_.capacity() * sizeof(Entry) + searched_.capacity() * sizeof(IsolatedSphere) +
         (within_.capacity() + pairs_.capacity()) * sizeof(NearPair);
}

void IsolatedGroups::start(std::size_t n) {
  parent_.resize(n);
  std::iota(parent_.begin(), parent_.end(), 0u);
  wanted_.assign(n, 0);
}

void IsolatedGroups::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t x = root(a), y = root(b), least = std::min(x, y), other = std::max(x, y);
  parent_[other] = least;
  wanted_[least] |= wanted_[other];
}

std::uint32_t IsolatedGroups::root(std::uint32_t a) {
  while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
  return a;
}

bool may_touch(const IsolatedSphere& a, const IsolatedSphere& b, const Vec3& image, double dt) {
  const Vec3 offset = b.position + image - a.position, speed = b.velocity - a.velocity;
  const double contact_distance = a.radius + b.radius, v2 = speed.squaredNorm();
  const double t = v2 > 0 ? std::clamp(-offset.dot(speed) / v2, 0.0, dt) : 0;  // nearest
  return (offset + t * speed).squaredNorm() <= contact_distance * contact_distance;
}

}  // namespace sturz
