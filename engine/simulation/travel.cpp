// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/travel.hpp"

#include "engine/effects/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace sturz {
namespace {

constexpr double end_share = 0.01;   // of the mass: front and tail
constexpr double tail_share = 0.05;  // of the mass: left behind

bool by_speed(const ParticleTravel& a, const ParticleTravel& b) { return a.speed < b.speed; }
bool by_displacement(const ParticleTravel& a, const ParticleTravel& b) {
  return a.displacement2 < b.displacement2;
}

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
    std::nth_element(all.begin() + low, all.begin() + middle, all.begin() + high, by_displacement);
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

/// Sums over particles.
struct Moments {
  double mass = 0, mx = 0, my = 0, momentum = 0, front2 = 0;
  double lowest = std::numeric_limits<double>::infinity();
};

void add_set(const MovingSet& p, Moments& sums, std::vector<ParticleTravel>& each) {
  const bool wraps = !p.wrapped_x.empty(), grows = !p.lag_x.empty();
  for (std::size_t i = 0; i < p.size(); ++i) {
    double dx = p.x[i] - p.start_x[p.id[i]], dy = p.y[i] - p.start_y[p.id[i]];
    if (wraps) {
      dx += p.wrapped_x[p.id[i]];
      dy += p.wrapped_y[p.id[i]];
    }
    const double v = std::sqrt(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
    const double displacement2 = dx * dx + dy * dy;
    sums.mass += p.mass[i];
    sums.mx += p.mass[i] * (grows ? dx - p.lag_x[p.id[i]] : dx);
    sums.my += p.mass[i] * (grows ? dy - p.lag_y[p.id[i]] : dy);
    sums.momentum += p.mass[i] * v;
    sums.front2 = std::max(sums.front2, displacement2);
    sums.lowest = std::min(sums.lowest, p.z[i]);
    each.push_back({displacement2, v, p.mass[i]});
  }
}

}  // namespace

Displacement measure(const State& state, std::vector<ParticleTravel>& each) {
  Displacement d;
  each.clear();
  each.reserve(state.n_particles());
  if (state.n_particles() == 0) return d;
  Moments sums;
  for (const MovingSet& set : state.sets) add_set(set, sums, each);
  d.lowest = sums.lowest;
  d.front = std::sqrt(sums.front2);
  d.com = std::hypot(sums.mx, sums.my) / sums.mass;
  d.mean_speed = sums.momentum / sums.mass;
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
  out.tail_travel = std::sqrt(
      std::max_element(all.begin(), all.begin() + behind, by_displacement)->displacement2);
  const std::span<ParticleTravel> tail = all.first(behind);  // holds what is farther back still
  out.tail_speed = mean_speed_of(tail.first(part_rearmost(tail, end_share * mass)));
  return out;
}

}  // namespace sturz
