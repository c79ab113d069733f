// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/state_shares.hpp"

#include "engine/effects/fields.hpp"
#include "engine/simulation/member_result.hpp"

#include <algorithm>

namespace sturz {
namespace {

constexpr int n_states = 4;  // numbered as GrainState, dense first

/// Masses [kg] of what shares are taken of, over all sets.
struct Masses {
  double all = 0, dilated = 0, theta_sum = 0, in_state[n_states] = {};
  bool has_density_change = false;
};

void add_set(const MovingSet& set, Masses& sums, StateShares& out) {
  const Field* density_change = set.find(fields::density_change);
  const Flags* state = set.find(fields::state);
  const Field* theta = set.find(fields::granular_temperature);
  sums.has_density_change |= density_change != nullptr;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double m = set.mass[i];
    sums.all += m;
    if (density_change && density_change->component[0][i] < dilated_density_change)
      sums.dilated += m;
    if (state) sums.in_state[std::min<int>(state->value[i], n_states - 1)] += m;
    if (theta) {
      sums.theta_sum += m * theta->component[0][i];
      out.max_theta = std::max(out.max_theta, theta->component[0][i]);
    }
  }
}

}  // namespace

StateShares state_shares(std::span<const MovingSet> sets) {
  StateShares out;
  Masses sums;
  for (const MovingSet& set : sets)
    if (set.reference_fraction > 0) add_set(set, sums, out);
  out.dilated = sums.has_density_change ? 0 : nan_d;
  if (sums.all == 0) return out;
  if (sums.has_density_change) out.dilated = sums.dilated / sums.all;
  out.dense = sums.in_state[0] / sums.all;
  out.transition = sums.in_state[1] / sums.all;
  out.dilute = sums.in_state[2] / sums.all;
  out.ultradilute = sums.in_state[3] / sums.all;
  out.mean_theta = sums.theta_sum / sums.all;
  return out;
}

void StateTimes::add(const StateShares& shares, double span_s) {
  now_ = shares;
  time_s_ += span_s;
  sum_.dilated += span_s * shares.dilated;
  sum_.transition += span_s * shares.transition;
  sum_.dilute += span_s * shares.dilute;
  sum_.ultradilute += span_s * shares.ultradilute;
}

void StateTimes::write(MemberScalars& m) const {
  const double scale = time_s_ > 0 ? 1 / time_s_ : 1;
  const StateShares& s = time_s_ > 0 ? sum_ : now_;
  m.parted_fraction = scale * s.dilated;
  m.transition_fraction = scale * s.transition;
  m.dilute_fraction = scale * s.dilute;
  m.ultradilute_fraction = scale * s.ultradilute;
}

}  // namespace sturz
