// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/travel.hpp"

#include "engine/simulation/parts.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sturz {
namespace {

constexpr double end_share = 0.01;   // of the mass: front and tail
constexpr double tail_share = 0.05;  // of the mass: left behind

bool by_speed(const ParticleTravel& a, const ParticleTravel& b) { return a.speed < b.speed; }
bool by_way(const ParticleTravel& a, const ParticleTravel& b) { return a.way2 < b.way2; }

double mass_of(std::span<const ParticleTravel> some) {
  double mass = 0;
  for (const ParticleTravel& p : some) mass += p.mass;
  return mass;
}

double mean_speed_of(std::span<const ParticleTravel> some) {
  double momentum = 0;
  for (const ParticleTravel& p : some) momentum += p.mass * p.speed;
  return momentum / mass_of(some);
}

/// Reorders so that the first n particles are the rearmost that hold `wanted` mass together.
/// \return n, at least one
std::size_t part_rearmost(std::span<ParticleTravel> all, double wanted) {
  std::size_t low = 0, high = all.size();
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    std::nth_element(all.begin() + low, all.begin() + middle, all.begin() + high, by_way);
    const double mass = mass_of(all.subspan(low, middle - low));
    if (mass >= wanted) {
      high = middle;
    } else {
      low = middle;
      wanted -= mass;
    }
  }
  return high;
}

}  // namespace

Displacement measure(const SimulationParts& parts, std::vector<ParticleTravel>& each) {
  const ParticleSet& p = parts.state.grains;
  Displacement d;
  each.clear();
  each.reserve(p.size());
  if (p.size() == 0) return d;
  double mass = 0, mx = 0, my = 0, momentum = 0, front2 = 0;
  d.lowest = p.z[0];
  for (std::size_t i = 0; i < p.size(); ++i) {
    double dx = p.x[i] - parts.start_x[p.id[i]], dy = p.y[i] - parts.start_y[p.id[i]];
    if (!parts.state.wrapped_x.empty()) {
      dx += parts.state.wrapped_x[p.id[i]];
      dy += parts.state.wrapped_y[p.id[i]];
    }
    const double v = std::sqrt(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    const double way2 = dx * dx + dy * dy;
    mass += p.mass[i];
    mx += p.mass[i] * dx;
    my += p.mass[i] * dy;
    momentum += p.mass[i] * v;
    front2 = std::max(front2, way2);
    d.lowest = std::min(d.lowest, p.z[i]);
    each.push_back({way2, v, p.mass[i]});
  }
  d.front = std::sqrt(front2);
  d.com = std::hypot(mx, my) / mass;
  d.mean_speed = momentum / mass;
  const auto high = each.end() - 1 - static_cast<std::ptrdiff_t>(each.size() / 1000);
  std::nth_element(each.begin(), high, each.end(), by_speed);
  d.high_speed = high->speed;
  return d;
}

FrontAndTail front_and_tail(std::vector<ParticleTravel>& each) {
  FrontAndTail out;
  if (each.empty()) return out;
  const std::span<ParticleTravel> all(each);
  const double mass = mass_of(all);
  const std::size_t last = part_rearmost(all, (1 - end_share) * mass);
  // Where the cut falls inside a particle, or all mass is in one, the particle counts as front.
  out.front_speed = mean_speed_of(all.subspan(std::min(last, all.size() - 1)));
  const std::size_t behind = part_rearmost(all, tail_share * mass);
  out.tail_travel = std::sqrt(std::max_element(all.begin(), all.begin() + behind, by_way)->way2);
  out.tail_speed = mean_speed_of(all.first(part_rearmost(all, end_share * mass)));
  return out;
}

}  // namespace sturz
