// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/state_shares.hpp"

#include "engine/simulation/member_result.hpp"

#include <algorithm>

namespace sturz {
namespace {

constexpr int n_states = 4;  // numbered as GrainState, dense first

const double* column(const ParticleSet& grains, const char* name) {
  const Field* field = grains.find_field(name);
  return field ? field->component[0].data() : nullptr;
}

}  // namespace

StateShares state_shares(const ParticleSet& grains) {
  StateShares out;
  const double* compression = column(grains, "compression");
  const double* state = column(grains, "state");
  const double* theta = column(grains, "granular_temperature");
  double mass = 0, parted = 0, heat = 0, in_state[n_states] = {};
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double m = grains.mass[i];
    mass += m;
    if (compression && compression[i] < parted_compression) parted += m;
    if (state) in_state[std::clamp(static_cast<int>(state[i]), 0, n_states - 1)] += m;
    if (theta) {
      heat += m * theta[i];
      out.max_theta = std::max(out.max_theta, theta[i]);
    }
  }
  out.parted = compression ? 0 : nan_d;
  if (mass == 0) return out;
  if (compression) out.parted = parted / mass;
  out.dense = in_state[0] / mass;
  out.transition = in_state[1] / mass;
  out.dilute = in_state[2] / mass;
  out.ultradilute = in_state[3] / mass;
  out.mean_theta = heat / mass;
  return out;
}

void StateTimes::add(const StateShares& shares, double span_s) {
  now_ = shares;
  time_s_ += span_s;
  sum_.parted += span_s * shares.parted;
  sum_.transition += span_s * shares.transition;
  sum_.dilute += span_s * shares.dilute;
  sum_.ultradilute += span_s * shares.ultradilute;
}

void StateTimes::write(MemberScalars& m) const {
  const double scale = time_s_ > 0 ? 1 / time_s_ : 1;
  const StateShares& s = time_s_ > 0 ? sum_ : now_;
  m.parted_fraction = scale * s.parted;
  m.transition_fraction = scale * s.transition;
  m.dilute_fraction = scale * s.dilute;
  m.ultradilute_fraction = scale * s.ultradilute;
}

}  // namespace sturz
