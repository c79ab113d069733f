// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/bed/flow_depth.hpp"

#include "engine/effects/fields.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sturz {
namespace {

/// Both neighbours of a place on an axis of nodes, and the weight of the upper one.
struct Between {
  std::int64_t low, high;
  double share;
};

Between nodes_around(double at, double first, double pitch, std::int64_t repeats) {
  const double place = (at - first) / pitch, floor = std::floor(place);
  const auto low = static_cast<std::int64_t>(floor);
  if (repeats == 0) return {low, low + 1, place - floor};
  const auto within = [repeats](std::int64_t k) { return ((k % repeats) + repeats) % repeats; };
  return {within(low), within(low + 1), place - floor};
}

/// Never 0, which is a free place.
std::uint64_t key_of(std::int64_t column, std::int64_t row) {
  return (static_cast<std::uint64_t>(column + 0x40000000) << 32) |
         static_cast<std::uint64_t>(row + 0x40000000);
}

/// The finalizer of MurmurHash3 (Appleby).
std::uint64_t scattered(std::uint64_t k) {
  k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdULL;
  k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return k ^ (k >> 33);
}

}  // namespace

void FlowDepth::lay_grid(const Domain& domain, const MovingSet& p) {
  const double wanted = 2 * spacing_;
  const auto fit = [wanted](const Period& period, double& pitch, std::int64_t& repeats) {
    pitch = wanted, repeats = 0;
    if (!period.active) return;
    repeats = std::max<std::int64_t>(1, std::llround(period.length() / wanted));
    pitch = period.length() / static_cast<double>(repeats);
  };
  fit(domain.x, pitch_x_, columns_);
  fit(domain.y, pitch_y_, rows_);
  west_ = domain.x.active ? domain.x.min : 0;
  south_ = domain.y.active ? domain.y.min : 0;
  // A place for every node of every particle, so that a search ends.
  const std::size_t room = std::bit_ceil(std::max<std::size_t>(64, 8 * p.size()));
  if (nodes_.size() < room) nodes_.resize(room);
  std::fill(nodes_.begin(), nodes_.end(), Node{});
  depth_.resize(p.size());
  beside_.resize(p.size());
}

void FlowDepth::corners_of(const MovingSet& p, std::size_t i, Corner out[4]) const {
  const Between x = nodes_around(p.x[i], west_, pitch_x_, columns_);
  const Between y = nodes_around(p.y[i], south_, pitch_y_, rows_);
  out[0] = {key_of(x.low, y.low), (1 - x.share) * (1 - y.share)};
  out[1] = {key_of(x.high, y.low), x.share * (1 - y.share)};
  out[2] = {key_of(x.low, y.high), (1 - x.share) * y.share};
  out[3] = {key_of(x.high, y.high), x.share * y.share};
}

FlowDepth::Node& FlowDepth::find(std::uint64_t key) {
  const std::size_t mask = nodes_.size() - 1;
  std::size_t at = scattered(key) & mask;
  while (nodes_[at].key != 0 && nodes_[at].key != key) at = (at + 1) & mask;
  nodes_[at].key = key;
  return nodes_[at];
}

void FlowDepth::measure(const Domain& domain, const MovingSet& p, double density) {
  lay_grid(domain, p);
  const Field* share = p.find(fields::grain_share);
  Corner corners[4];
  for (std::size_t i = 0; i < p.size(); ++i) {
    corners_of(p, i, corners);
    const double volume = p.mass[i] / density * (share ? 1 + share->component[0][i] : 1);
    const bool beside = p.boundary.distance[i] < near_;
    for (const Corner& c : corners) {
      Node& node = find(c.key);
      node.volume += c.weight * volume;
      if (beside) node.beside += c.weight * volume;
    }
  }
  const double inv_area = 1 / (pitch_x_ * pitch_y_);
  for (std::size_t i = 0; i < p.size(); ++i) {
    corners_of(p, i, corners);
    double all = 0, beside = 0;
    for (const Corner& c : corners) {
      const Node& node = find(c.key);
      all += c.weight * node.volume;
      beside += c.weight * node.beside;
    }
    depth_[i] = all * inv_area;
    beside_[i] = beside * inv_area;
  }
}

std::size_t FlowDepth::bytes() const {
  return nodes_.capacity() * sizeof(Node) +
         (depth_.capacity() + beside_.capacity()) * sizeof(double);
}

}  // namespace sturz
