// SPDX-License-Identifier: Apache-2.0
/// What the passes between grains and liquid hold together, in the order of the pairs' rows.
///
/// With W_ij the smoothing kernel between grain i (mass m_i, bulk volume V_i = m_i/(rho_p alpha_i))
/// and liquid j (mass m_j, density rho_j = rho_0 (1 + e_j), which counts the air in pores that it
/// does not fill):
///   share of j's mass that i meets   mu_ij = V_i q_j W_ij, q_j = m_j/max(1, sum_i V_i W_ij)
///   all that i meets                 M_i = sum_j mu_ij, weights b_ij = mu_ij/M_i
///   how wet i is                     omega_i = min(1, sum_j (m_j/rho_j) W_ij/(wet (1 - alpha_i)))
///   grains' volume in j's            X_j = (rho_j/m_j) sum_i omega_i b_ij m_i/rho_p
/// V_i, q_j, M_i, omega_i and X_j/rho_j stay as long as the weights do (CrossPairs).
/// sum_i mu_ij <= m_j, so that grains that take momentum of a liquid particle one by one cannot
/// take more than it has; sum_j (m_j/rho_j) X_j is the wet grains' volume.
#pragma once

#include "engine/effects/coupling/settings.hpp"
#include "engine/effects/step.hpp"
#include "engine/neighbors/cross_pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

namespace sturz {

/// Four doubles that are summed side by side.
using Quad = double __attribute__((vector_size(32)));

template <int n>
struct Quads {
  Quad quad[n] = {};
  double operator[](int k) const { return quad[k / 4][k % 4]; }
  Vec3 vector(int first) const { return {(*this)[first], (*this)[first + 1], (*this)[first + 2]}; }
  void add(int first, const Vec3& v) {
    for (int k = 0; k < 3; ++k) quad[(first + k) / 4][(first + k) % 4] += v[k];
  }
};

/// A grain of the last gather, by row.
struct MetLiquid {
  double volume = 0;       ///< V_i [m^3]
  double met = 0;          ///< M_i/V_i: liquid's mass per volume at the grain [kg/m^3]; 0: dry
  double wet = 0;          ///< omega_i
  Vec3 velocity{0, 0, 0};  ///< mean of the liquid it meets, at n-1/2 [m/s]
};

struct Coupling {
  static constexpr int grain_side = 0, liquid_side = 1;

  CouplingSettings settings;
  std::size_t grains, liquid;  ///< indices in State::sets
  CrossPairs pairs;
  double largest_share = 0;      ///< of X_j now
  std::vector<MetLiquid> met;    ///< [grains' rows]
  std::vector<double> take;      ///< q_j [liquid's rows, kg]
  std::vector<double> share;     ///< X_j, not cut [liquid's rows]
  std::vector<double> filled;    ///< X_j/rho_j [liquid's rows, m^3/kg]
  std::vector<Vec3> lift, drag;  ///< changes of a grain's velocity in this step [grains' rows]
  std::vector<Vec3> drawn;       ///< of a liquid particle's, by drag [liquid's rows]
  std::vector<Vec3> held;        ///< the same by ground and walls, before the drag
  std::vector<Vec3> walled;      ///< a grain's by walls, before the drag; empty without walls
  // What sums over neighbours read, by source.
  std::vector<double> volume;          ///< V_i
  std::vector<Quads<2>> liquid_start;  ///< q, q v at n-1/2, pore volume, q v at n+1/2
  std::vector<double> room;            ///< omega_i m_i/(rho_p sum W q)
  std::vector<Quads<1>> flux;          ///< f = omega_i m_i/rho_p times slip, f.x
  std::vector<Quads<2>> liquid_now;    ///< q v, q/(1 + X), q kappa rho a, q S
  std::vector<Quads<1>> impulse;       ///< of drag on the grain, over met

  Coupling(std::size_t grain_set, std::size_t liquid_set, const CouplingSettings& c)
      : settings(c),
        grains(grain_set),
        liquid(liquid_set),
        pairs(c.smoothing_length, c.skin * c.smoothing_length, liquid_side) {}
  const PairSide& of_grains() const { return pairs.side(grain_side); }
  const PairSide& of_liquid() const { return pairs.side(liquid_side); }
};

/// Sum of weights times what a row's sources have. Two sums side by side: an addition need not wait
/// for the one before.
template <int n>
Quads<n> gather(const PairSide::Pairs& pairs, const float* weights,
                const std::vector<Quads<n>>& values) {
  Quads<n> even, odd;
  const Quads<n>* value = values.data();
  std::size_t k = 0;
  for (; k + 1 < pairs.n; k += 2) {
    const double w = weights[k], next = weights[k + 1];
    const Quads<n>&a = value[pairs.source[k]], &b = value[pairs.source[k + 1]];
    for (int c = 0; c < n; ++c) even.quad[c] += w * a.quad[c], odd.quad[c] += next * b.quad[c];
  }
  if (k < pairs.n)
    for (int c = 0; c < n; ++c)
      even.quad[c] += static_cast<double>(weights[k]) * value[pairs.source[k]].quad[c];
  for (int c = 0; c < n; ++c) even.quad[c] += odd.quad[c];
  return even;
}
/// The same of single numbers.
inline double gather(const PairSide::Pairs& pairs, const std::vector<double>& values) {
  double sum[4] = {};
  const double* value = values.data();
  std::size_t k = 0;
  for (; k + 3 < pairs.n; k += 4)
    for (int c = 0; c < 4; ++c) sum[c] += pairs.weight[k + c] * value[pairs.source[k + c]];
  for (; k < pairs.n; ++k) sum[0] += pairs.weight[k] * value[pairs.source[k]];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Images move as in a mirror: what a sum over all sources has of their vectors is turned, so that
/// nothing seems to go through ground or walls. \param firsts  where the vectors start
template <int n>
void turn_images(const PairSide& side, std::size_t row, const std::vector<Quads<n>>& values,
                 std::initializer_list<int> firsts, Quads<n>& sum) {
  for (std::size_t m = 0; m < side.n_mirrors(); ++m) {
    const PairSide::Pairs pairs = side.image_pairs(row, m);
    if (pairs.n == 0) continue;
    const Quads<n> images = gather(pairs, pairs.weight, values);
    const Vec3 normal = side.normal(row, m);
    for (const int first : firsts) sum.add(first, -2 * normal.dot(images.vector(first)) * normal);
  }
}

/// rho_j/rho_0 of a liquid particle; one that has thinned out counts no less than a fiftieth.
inline double relative_density(const Field* density_change, std::size_t j) {
  return density_change ? std::max(0.02, 1 + density_change->component[0][j]) : 1;
}

/// Passes that find what grains and liquid are to each other at x_n.
void add_shares(Step&, const std::shared_ptr<Coupling>&);
/// Passes that let them act on each other.
void add_exchange(Step&, const std::shared_ptr<Coupling>&);

}  // namespace sturz
