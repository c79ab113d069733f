// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/wet_profile.hpp"

#include "engine/effects/columns/wet_bounds.hpp"

#include <algorithm>
#include <numbers>

namespace sturz {
namespace {

/// Bounds at a height over the bed: grains and water above it are the weight there.
struct AtHeight {
  double stress, still;  // [Pa]
  bool airy;

  /// \param above share of the thickness that lies above; \param room weight less still water at
  /// the base [Pa]; \param still_at_base of still water [Pa]; \param water of as much of it as the
  /// pores are thick [Pa]
  AtHeight(double above, double room, double still_at_base, double water, bool has_air)
      : still(greater(0, still_at_base - (1 - above) * water)), airy(has_air) {
    stress = still + room * above;
  }
  double cut(double wanted) const { return bounded(wanted, stress, still, airy); }
};

/// The base's response to its own change beyond which a step does without it: pressure that feeds
/// itself grows in parts instead.
constexpr double most_response = 0.5;

}  // namespace

void WetProfile::load(WetBlock& b, const MixtureSettings& settings) {
  const MixtureLaw law = settings.law;
  const double ratio = settings.pressure_ratio, kick = b.time;
  const ProfileMesh at = mesh;
#pragma omp simd
  for (std::size_t i = 0; i < b.n; ++i) {
    const double h = b.thickness[i], g = b.normal_gravity[i], seen = b.gravity_seen[i];
    const double volume = b.solids[i] + b.water[i], bulk = b.mass[i] / volume;
    const Pores pores(b.share_[i], b.fraction[i], h);
    const double still = law.fluid_density * g * pores.level;
    const double half = within(0.5 * b.strain_rate[i] * kick, -0.5, 0.5);
    const double change = h * (g * (1 - half) - seen * (1 + half));
    const double released = ratio < 0 ? 0 : ratio * b.stress_[i] - still;
    const double gained = seen < 0 ? released : (bulk - law.fluid_density) * change;
    const double carried = seen < 0 ? 0 : 1, room = b.stress_[i] - still;
    const double water = law.fluid_density * g * pores.thickness;
    double work = 0;
    for (int j = 0; j < at.nodes; ++j) {
      const double above = 1 - at.height(j);
      const AtHeight bounds(above, room, still, water, pores.airy);
      const double wanted = carried * excess[j][i] + gained * above, inside = bounds.cut(wanted);
      work += cut_work(law, b.fraction[i], wanted, inside, bounds.stress, bounds.still,
                       at.weight(j) * pores.thickness * b.area_[i]);
      excess[j][i] = inside;
    }
    b.clipped_work[i] = work;
    b.excess[i] = at.drained_bed ? 0 : excess[0][i];
  }
}

WetProfile::Lanes WetProfile::lanes_of(const WetBlock& b, std::size_t first) const {
  Lanes c;
  for (std::size_t l = 0; l < width; ++l) {
    const std::size_t i = std::min(first + l, b.n - 1);  // the last one stands in for none
    c.m[l] = b.fraction[i], c.permeability[l] = b.permeability_[i];
    c.per_thickness[l] = 1 / b.grains_[i], c.room[l] = b.stress_[i] - b.still_[i];
    c.speed[l] = b.speed_[i], c.time[l] = b.time_[i];
  }
  return c;
}

/// One implicit step (backward Euler) along the tangent: p = A + (change at the base) B, both of
/// the same three-diagonal matrix; B is how a profile answers a change at its own base.
void WetProfile::step(const MixtureLaw& given, const Lanes& c, double part, const Lane* from,
                      Lane* to) const {
  const MixtureLaw law = given;
  const int n = mesh.nodes, last = n - 1;
  const bool tight = !mesh.drained_bed;
  const double per_spacing = 1 / mesh.spacing();
  Lane spread, gained, spread_slope, gained_slope, ratio[most_nodes], answer[most_nodes];
#pragma omp simd
  for (std::size_t l = 0; l < width; ++l) {
    const double borne = greater(0, c.room[l] - (tight ? from[0][l] : 0));
    const ProfileRates rates =
        profile_rates(law, c.m[l], c.permeability[l], borne, c.speed[l], c.per_thickness[l]);
    const double time = part * c.time[l], per_dz = per_spacing * c.per_thickness[l];
    const double per_area = time * per_dz * per_dz;
    spread[l] = rates.diffusivity * per_area, gained[l] = rates.source * time;
    spread_slope[l] = tight ? rates.diffusivity_slope * per_area : 0;
    gained_slope[l] = tight ? rates.source_slope * time : 0;
  }
  for (int j = 0; j < n; ++j) {
    // Across a tight bed the profile is mirrored; half a spacing beyond a node it is zero where it
    // drains, so that its mirror image is negative.
    const bool mirrored = j == 0 && tight, drains = j == last || (j == 0 && !tight);
    const double diagonal = drains ? 3 : 2, upper = mirrored ? 2 : 1;
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) {
      const double here = from[j][l], r = spread[l], lower = j > 0 ? r : 0;
      const double below = j > 0 ? from[j - 1][l] : tight ? from[1][l] : -here;
      const double above = j < last ? from[j + 1][l] : -here;
      const double pivot = 1 / (1 + diagonal * r - lower * (j > 0 ? ratio[j - 1][l] : 0));
      ratio[j][l] = upper * r * pivot;
      to[j][l] = (here + gained[l] + lower * (j > 0 ? to[j - 1][l] : 0)) * pivot;
      answer[j][l] = (gained_slope[l] + spread_slope[l] * (below - 2 * here + above) +
                      lower * (j > 0 ? answer[j - 1][l] : 0)) *
                     pivot;
    }
  }
  for (int j = last - 1; j >= 0; --j)
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) {
      to[j][l] += ratio[j][l] * to[j + 1][l];
      answer[j][l] += ratio[j][l] * answer[j + 1][l];
    }
  if (!tight) return;
  Lane base;
#pragma omp simd
  for (std::size_t l = 0; l < width; ++l) {
    const double response = answer[0][l];
    const double kept = response > most_response ? most_response / response : 1;
    base[l] = kept * (to[0][l] - from[0][l]) / (1 - kept * response);
  }
  for (int j = 0; j < n; ++j)
#pragma omp simd
    for (std::size_t l = 0; l < width; ++l) to[j][l] += base[l] * answer[j][l];
}

/// Second order in time and without a limit of the step: twice two halves less one whole. What
/// decays within a step is left over by a thirtieth at most.
void WetProfile::look_ahead(WetBlock& b, const MixtureLaw& law) {
  const int n = mesh.nodes, last = n - 1;
  const bool tight = !mesh.drained_bed;
  const double per_spacing = 1 / mesh.spacing();
  constexpr double slowest = std::numbers::pi * std::numbers::pi / 4;  // first mode of a tight bed
  Lane start[most_nodes], whole[most_nodes], half[most_nodes], two[most_nodes];
  for (std::size_t first = 0; first < b.n; first += width) {
    const Lanes c = lanes_of(b, first);
    for (int j = 0; j < n; ++j)
      for (std::size_t l = 0; l < width; ++l) start[j][l] = excess[j][std::min(first + l, b.n - 1)];
    step(law, c, 1, start, whole);
    step(law, c, 0.5, start, half);
    step(law, c, 0.5, half, two);
    const auto mean = [&](int j, std::size_t l) { return half[j][l] + two[j][l] - whole[j][l]; };
    for (std::size_t l = 0; l < std::min(width, b.n - first); ++l) {
      const std::size_t i = first + l;
      for (int j = 0; j < n; ++j) ahead_[j][i] = 2 * two[j][l] - whole[j][l];
      b.change_[i] = tight ? ahead_[0][i] : 0;
      b.mean_[i] = tight ? mean(0, l) : 0;
      b.rising_[i] = ahead_[tight ? 0 : n / 2][i];
      // Darcy's flow through what lies half a spacing below the surface, or above a drained bed.
      const double water = law.fluid_density * b.normal_gravity[i] * b.grains_[i];
      const AtHeight bounds(1 - mesh.height(last), c.room[l], b.still_[i], water,
                            b.fraction[i] < b.share_[i]);
      double drains = bounds.cut(mean(last, l));
      if (!tight) {
        const AtHeight low(1 - mesh.height(0), c.room[l], b.still_[i], water, bounds.airy);
        drains += low.cut(mean(0, l));
      }
      const double mobility = c.permeability[l] / law.fluid_viscosity;
      const double per_h2 = c.per_thickness[l] * c.per_thickness[l];
      b.squeezed_[i] = 2 * per_spacing * mobility * drains * per_h2 * c.time[l];
      const double borne = greater(0, c.room[l] - (tight ? start[0][l] : 0));
      b.decay_[i] =
          (tight ? 1 : 4) * slowest * mobility * law.stiffness(c.m[l], borne) * per_h2 * c.time[l];
    }
  }
}

void WetProfile::settle(WetBlock& b, const MixtureLaw& given) {
  const MixtureLaw law = given;
  const ProfileMesh at = mesh;
  const int first = at.drained_bed ? 0 : 1;
#pragma omp simd
  for (std::size_t i = 0; i < b.n; ++i) {
    const double m = b.fraction[i], g = b.normal_gravity[i];
    const Pores pores(b.share_[i], m, b.thickness[i]);
    const double still = law.fluid_density * g * pores.level, room = b.stress_[i] - still;
    const double water = law.fluid_density * g * pores.thickness;
    double work = 0;
    for (int j = first; j < at.nodes; ++j) {
      const AtHeight bounds(1 - at.height(j), room, still, water, pores.airy);
      const double wanted = ahead_[j][i], inside = bounds.cut(wanted);
      work += cut_work(law, m, wanted, inside, bounds.stress, bounds.still,
                       at.weight(j) * pores.thickness * b.area_[i]);
      excess[j][i] = inside;
    }
    b.clipped_work[i] += work;
    if (first == 1) excess[0][i] = b.excess[i];
  }
}

}  // namespace sturz
