// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measure/memory.hpp"

namespace sturz::bench {
namespace {

template <class T>
std::size_t bytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

std::size_t state_bytes(const State& s) {
  std::size_t sum = bytes(s.grains().fate) + bytes(s.grains().boundary.mirror_weight);
  sum += bytes(s.grains().wrapped_x) + bytes(s.grains().wrapped_y);
  const BoundarySupport& b = s.grains().boundary;
  for (const auto* v :
       {&s.grains().ax, &s.grains().ay, &s.grains().az, &b.distance, &b.nx, &b.ny, &b.nz})
    sum += bytes(*v);
  for (const auto& v : b.from_ground) sum += bytes(v);
  for (int k = 0; k < 6; ++k) sum += bytes(b.moment[k]) + bytes(b.gradient[k]);
  return sum;
}

}  // namespace

MemoryPerParticle memory_per_particle(const State& state, const Step& step) {
  const double n = static_cast<double>(state.grains().size());
  return {static_cast<double>(state.grains().bytes_per_particle()),
          static_cast<double>(step.bytes()) / n, static_cast<double>(state_bytes(state)) / n};
}

}  // namespace sturz::bench
