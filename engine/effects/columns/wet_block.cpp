// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/wet_block.hpp"

#include "engine/effects/columns/wet_bounds.hpp"
#include "engine/effects/columns/wet_profile.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Change of pressure over weight that one part of a step may bring, and parts at most.
constexpr double largest_change = 0.05;
constexpr int most_parts = 16;
/// Change of the solid fraction in one part.
constexpr double most_dilation = 0.02;
/// Films without weight must not divide by it.
constexpr double least_stress = 1e-12;

}  // namespace

/// What the weight did to the pressure while no water could move. At the first step the column
/// learns how thick it is among the others. Later the summed thickness moves by its own noise too;
/// still water takes that, the excess follows the strain alone.
void WetBlock::load(const MixtureSettings& settings) {
  const MixtureLaw law = settings.law;
  const double ratio = settings.pressure_ratio, kick = time;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double m = fraction[i], h = thickness[i], g = normal_gravity[i], seen = gravity_seen[i];
    const double volume = solids[i] + water[i], bulk = mass[i] / volume;
    const double share = solids[i] / volume, stress = bulk * g * h, area = volume / h;
    const Pores pores(share, m, h);
    const double still = law.fluid_density * g * pores.level;
    const double released = ratio < 0 ? 0 : ratio * stress - still;
    // The thickness at the kick is that of its middle.
    const double half = within(0.5 * strain_rate[i] * kick, -0.5, 0.5);
    const double change = h * (g * (1 - half) - seen * (1 + half));
    const double carried = excess[i] + (law.undrained(bulk, change) - law.fluid_density * change);
    const double wanted = seen < 0 ? released : carried;
    const double inside = bounded(wanted, stress, still, pores.airy);
    clipped_work[i] = cut_work(law, m, wanted, inside, stress, still, pores.thickness * area);
    excess[i] = inside;
    share_[i] = share, stress_[i] = stress, area_[i] = area, per_load_[i] = 1 / (bulk * h);
    permeability_[i] = law.permeability_at(m);
    touching_[i] = 1;
    time_[i] = kick;
  }
}

/// Grains that hardly touch; rare.
void WetBlock::let_go() {
  if (*std::min_element(fraction, fraction + n) >= touching_fraction) return;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) touching_[i] = grains_touching(fraction[i]);
}

/// The speed in the middle of the next part, and what the pressure does at it.
template <bool resolved>
void WetBlock::look_ahead(const MixtureLaw& given) {
  const MixtureLaw law = given;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double m = fraction[i], p = excess[i], dt = time_[i];
    const Pores pores(share_[i], m, thickness[i]);
    const double still = law.fluid_density * normal_gravity[i] * pores.level;
    const WetColumn c{m, p, pores.thickness, stress_[i], still, normal_gravity[i]};
    const double borne = c.effective_stress(), per_h = 1 / pores.thickness;
    const double x = vx[i], y = vy[i], z = vz[i];
    const double ax = pull_x[i], ay = pull_y[i], az = pull_z[i];
    const double v2 = x * x + y * y + z * z, start = std::sqrt(v2);
    const double tangent = dilatancy(law, m, 2 * start * per_h, borne).tangent;
    const double plastic =
        (borne * mixture_friction(friction[i], tangent, touching_[i]) + cohesion[i]) * per_load_[i];
    const double rate =
        2 * law.fluid_viscosity * (1 - m) * per_h * per_load_[i] + drag[i] * start / thickness[i];
    const Decay d = decay_over(rate * dt);
    const double reach = d.mean * dt;
    const double trial2 = d.left * d.left * v2 + 2 * d.left * reach * (x * ax + y * ay + z * az) +
                          reach * reach * (ax * ax + ay * ay + az * az);
    const double ends = greater(0, std::sqrt(greater(0, trial2)) - plastic * reach);
    const double speed = 0.5 * (start + ends);
    const Dilatancy ahead = dilatancy(law, m, 2 * speed * per_h, borne);
    grains_[i] = pores.thickness, still_[i] = still, speed_[i] = speed;
    steady_[i] = ahead.steady_fraction;
    if constexpr (!resolved) {
      const PoreRates rates = tangent_rates(law, c, permeability_[i], speed, ahead);
      const PoreChange change = advance(rates, p, dt);
      change_[i] = change.excess, mean_[i] = change.mean_excess;
      compaction_[i] = rates.compaction, decay_[i] = rates.decay * dt;
    }
  }
  if constexpr (resolved) profile->look_ahead(*this, given);
}

/// Goes through the part that was looked ahead over.
template <bool resolved>
void WetBlock::finish(const MixtureLaw& given) {
  const MixtureLaw law = given;
  const double loosest = law.loosest_fraction();
  double base_share = 1;  // of the volume that the pressure at the base stands for
  if constexpr (resolved) base_share = profile->base_share();
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double m = fraction[i], dt = time_[i], share = share_[i], stress = stress_[i];
    const double still = still_[i], speed = speed_[i], per_h = 1 / grains_[i];
    const bool airy = m < share;
    const double mean = bounded(mean_[i], stress, still, airy);
    double compacted;
    if constexpr (resolved)
      compacted = m / (1 - within(squeezed_[i], -1, 0.5));
    else
      compacted = m * plain_exp(within(compaction_[i] * mean * dt, -1, 1));
    const double capped =
        greater(within(compacted, m - most_dilation, m + most_dilation), lesser(m, loosest));
    // Thin fast films would swing about their steady fraction: they stop at it.
    const double steady = steady_[i];
    const bool swings = decay_[i] > 1 && speed > 0 && (m - steady) * (capped - steady) < 0;
    const double settled = swings ? steady : capped;
    // Pores with air in them close as fast as shear closes them: the air leaves freely.
    const double target = lesser(steady, share);
    const double closed = target + (m - target) * plain_exp(-2 * speed * per_h * dt * m);
    const double rises = resolved ? rising_[i] : change_[i];
    const double least = airy && rises > 0 ? (target > m ? closed : m) : 0;
    const double next = within(greater(settled, least), 1e-3, 0.99);

    const double borne = greater(0, stress - still - mean);
    const double tangent = dilatancy(law, m, 2 * speed * per_h, borne).tangent;
    const double plastic =
        (borne * mixture_friction(friction[i], tangent, touching_[i]) + cohesion[i]) * per_load_[i];
    const double rate =
        2 * law.fluid_viscosity * (1 - m) * per_h * per_load_[i] + drag[i] * speed / thickness[i];
    const Decay d = decay_over(rate * dt);
    const double reach = d.mean * dt;
    const double x = d.left * vx[i] + reach * pull_x[i], y = d.left * vy[i] + reach * pull_y[i],
                 z = d.left * vz[i] + reach * pull_z[i];
    const double trial = std::sqrt(x * x + y * y + z * z), stop = plastic * reach;
    const double kept = trial <= stop ? 0 : 1 - stop / trial;  // NaN is no rest
    vx[i] = kept * x, vy[i] = kept * y, vz[i] = kept * z;

    const Pores after(share, next, thickness[i]);
    const double level = law.fluid_density * normal_gravity[i] * after.level;
    const double wanted = change_[i], inside = bounded(wanted, stress, level, after.airy);
    double volume = after.thickness * area_[i];
    if constexpr (resolved) volume *= base_share;
    clipped_work[i] += cut_work(law, next, wanted, inside, stress, level, volume);
    fraction[i] = next, excess[i] = inside;
    pressure[i] = greater(0, inside + level);
  }
  if constexpr (resolved) profile->settle(*this, given);
}

int WetBlock::parts_of(std::size_t i) const {
  const double inside = bounded(change_[i], stress_[i], still_[i], fraction[i] < share_[i]);
  const double parts = std::abs(inside - excess[i]) / (largest_change * stress_[i] + least_stress);
  return parts > 1 ? static_cast<int>(std::ceil(std::min<double>(parts, most_parts))) : 1;
}

void WetBlock::copy(std::size_t to, const WetBlock& from, std::size_t i) {
  static constexpr Row WetBlock::*rows[] = {&WetBlock::thickness,
                                            &WetBlock::normal_gravity,
                                            &WetBlock::pull_x,
                                            &WetBlock::pull_y,
                                            &WetBlock::pull_z,
                                            &WetBlock::friction,
                                            &WetBlock::cohesion,
                                            &WetBlock::drag,
                                            &WetBlock::vx,
                                            &WetBlock::vy,
                                            &WetBlock::vz,
                                            &WetBlock::fraction,
                                            &WetBlock::excess,
                                            &WetBlock::clipped_work,
                                            &WetBlock::share_,
                                            &WetBlock::stress_,
                                            &WetBlock::per_load_,
                                            &WetBlock::area_,
                                            &WetBlock::permeability_,
                                            &WetBlock::touching_,
                                            &WetBlock::time_};
  for (const auto row : rows) (this->*row)[to] = (from.*row)[i];
}

/// Columns that were sorted by falling numbers of parts.
template <bool resolved>
void WetBlock::slide_in_parts(const MixtureLaw& law, const int* parts, const std::size_t* source) {
  const std::size_t all = n;
  for (std::size_t k = 0; k < all; ++k) time_[k] /= parts[source[k]];
  for (int part = 0; part < most_parts; ++part) {
    while (n > 0 && parts[source[n - 1]] <= part) --n;
    if (n == 0) break;
    look_ahead<resolved>(law);
    finish<resolved>(law);
  }
  n = all;
}

void WetBlock::slide(const MixtureSettings& settings) {
  load(settings);
  if (profile) {
    profile->load(*this, settings);
    WetProfile more(settings.profile);
    slide_loaded<true>(settings, &more);
  } else {
    slide_loaded<false>(settings, nullptr);
  }
}

/// \param inside_more room for the profiles of columns that are taken out
template <bool resolved>
void WetBlock::slide_loaded(const MixtureSettings& settings, WetProfile* inside_more) {
  let_go();
  look_ahead<resolved>(settings.law);
  int parts[capacity];
  std::size_t source[capacity], n_more = 0;
  for (std::size_t i = 0; i < n; ++i)
    if ((parts[i] = parts_of(i)) > 1) source[n_more++] = i;
  if (n_more == 0) return finish<resolved>(settings.law);
  std::stable_sort(source, source + n_more,
                   [&](std::size_t a, std::size_t b) { return parts[a] > parts[b]; });
  WetBlock more;
  more.n = n_more;
  for (std::size_t k = 0; k < n_more; ++k) more.copy(k, *this, source[k]);
  if constexpr (resolved) {
    more.profile = inside_more;
    for (std::size_t k = 0; k < n_more; ++k) inside_more->copy(k, *profile, source[k]);
  }
  if (n_more < n) finish<resolved>(settings.law);
  more.slide_in_parts<resolved>(settings.law, parts, source);
  for (std::size_t k = 0; k < n_more; ++k) {
    const std::size_t i = source[k];
    vx[i] = more.vx[k], vy[i] = more.vy[k], vz[i] = more.vz[k];
    fraction[i] = more.fraction[k], excess[i] = more.excess[k], pressure[i] = more.pressure[k];
    clipped_work[i] = more.clipped_work[k];
    if constexpr (resolved) profile->copy(i, *inside_more, k);
  }
}

}  // namespace sturz
