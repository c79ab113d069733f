// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/phases/nodes.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Weights of the nodes before, at and after the nearest one. \param off  from it, -0.5 ... 0.5
std::array<double, 3> spline(double off) {
  const double before = 0.5 - off, after = 0.5 + off;
  return {0.5 * before * before, 0.75 - off * off, 0.5 * after * after};
}

/// Nearest whole number of what no map is beyond; plain arithmetic, for it is in the inner loop.
std::int64_t nearest(double value) {
  constexpr double beyond = 1LL << 30;
  return static_cast<std::int64_t>(value + (beyond + 0.5)) - static_cast<std::int64_t>(beyond);
}

struct Span {
  double low = 1e300, high = -1e300;
  void add(const std::vector<double>& values) {
    for (double v : values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
};

}  // namespace

DragNodes::Axis DragNodes::axis_of(const Period& period, double low, double high, double distance) {
  Axis axis;
  axis.distance = distance;
  if (period.active) {
    axis.periodic = true;
    axis.n = std::max<std::int64_t>(1, std::llround(period.length() / distance));
    axis.distance = period.length() / static_cast<double>(axis.n);
    axis.origin = period.min;
  } else if (low <= high) {
    axis.first = std::llround(low / distance) - 2;
    axis.n = std::llround(high / distance) + 3 - axis.first;
  }
  return axis;
}

void DragNodes::clear(const ParticleSet& a, const ParticleSet& b, const Domain& domain,
                      double distance) {
  Span x, y;
  x.add(a.x), x.add(b.x), y.add(a.y), y.add(b.y);
  x_ = axis_of(domain.x, x.low, x.high, distance);
  y_ = axis_of(domain.y, y.low, y.high, distance);
  tile_cols_ = (x_.n + edge - 1) / edge;
  tiles_.assign(static_cast<std::size_t>(tile_cols_ * ((y_.n + edge - 1) / edge)), -1);
  for (std::size_t set : {0, 1}) sums_[set].clear(), seats_[set].clear(), change[set].clear();
}

std::uint32_t DragNodes::node_at(std::int64_t col, std::int64_t row) {
  std::int32_t& tile = tiles_[static_cast<std::size_t>(row / edge * tile_cols_ + col / edge)];
  if (tile < 0) {
    tile = static_cast<std::int32_t>(sums_[0].size() / (edge * edge));
    for (auto& sums : sums_) sums.resize(sums.size() + edge * edge);
  }
  return static_cast<std::uint32_t>(tile * edge * edge + row % edge * edge + col % edge);
}

void DragNodes::add(std::size_t set, double x, double y, const NodeSums& column) {
  const double u = (x - x_.origin) / x_.distance, v = (y - y_.origin) / y_.distance;
  const std::int64_t col = nearest(u), row = nearest(v);
  Seat& seat = seats_[set].emplace_back();
  seat.across = spline(u - static_cast<double>(col)),
  seat.up = spline(v - static_cast<double>(row));
  const std::array<std::int64_t, 3> cols{x_.at(col - 1), x_.at(col), x_.at(col + 1)};
  const std::array<std::int64_t, 3> rows{y_.at(row - 1), y_.at(row), y_.at(row + 1)};
  const double mass = column.mass();
  Eigen::Array<double, 8, 1> whole = mass * column.values;
  whole[0] = mass;
  for (std::size_t r = 0; r < 3; ++r) {
    const Eigen::Array<double, 8, 1> in_row = seat.up[r] * whole;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t node = node_at(cols[c], rows[r]);
      seat.node[3 * r + c] = node;
      sums_[set][node].values += seat.across[c] * in_row;
    }
  }
}

Vec3 DragNodes::change_of(std::size_t set, std::size_t n) const {
  const Seat& seat = seats_[set][n];
  const Eigen::Array<double, 4, 1>* from = change[set].data();
  Eigen::Array<double, 4, 1> sum = Eigen::Array<double, 4, 1>::Zero();
  for (std::size_t r = 0; r < 3; ++r) {
    const std::uint32_t* node = &seat.node[3 * r];
    sum += seat.up[r] * (seat.across[0] * from[node[0]] + seat.across[1] * from[node[1]] +
                         seat.across[2] * from[node[2]]);
  }
  return {sum[0], sum[1], sum[2]};
}

std::size_t DragNodes::bytes() const {
  std::size_t total = tiles_.capacity() * sizeof(std::int32_t);
  for (std::size_t set : {0, 1})
    total += sums_[set].capacity() * sizeof(NodeSums) + seats_[set].capacity() * sizeof(Seat) +
             change[set].capacity() * sizeof(change[set][0]);
  return total;
}

}  // namespace sturz
