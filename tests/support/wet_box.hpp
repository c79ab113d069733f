// SPDX-License-Identifier: Apache-2.0
/// One column of a mixture by itself, with imposed speed or sliding down an even slope: what
/// columns must equal where nothing happens between them. It swells with the water that it takes
/// up, as the integrations have it that its reference numbers come from.
#pragma once

#include "engine/core/constants.hpp"
#include "engine/laws/pore_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sturz::test {

/// Mixture of the debris-flow flume of the U.S. Geological Survey.
inline MixtureLaw flume_mixture() {
  MixtureLaw law;
  law.fluid_density = 1100;
  return law;
}

/// One metre of mixture whose mass over area stays.
struct WetBox {
  MixtureLaw law = flume_mixture();
  double gravity = standard_gravity, tan_phi = std::tan(40 * std::numbers::pi / 180),
         slope_gravity = 0;
  double m = 0.6, excess = 0, mass = 0;
  double speed = 0, path = 0;

  explicit WetBox(const MixtureLaw& with, double solid_fraction, double slope_deg = 0)
      : law(with), m(solid_fraction) {
    const double slope = slope_deg * std::numbers::pi / 180;
    mass = law.density(m), gravity = standard_gravity * std::cos(slope),
    slope_gravity = standard_gravity * std::sin(slope);
  }
  WetColumn column() const {
    const double h = mass / law.density(m);
    return {m, excess, h, mass * gravity, law.fluid_density * gravity * h, gravity};
  }
  double lambda() const {
    const WetColumn c = column();
    return (c.hydrostatic + excess) / c.normal_stress;
  }
  PoreRates rates(double speed_now, bool tangent) const {
    const WetColumn c = column();
    const auto law_of = tangent ? tangent_rates : pore_rates;
    return law_of(law, c, law.permeability_at(m), speed_now,
                  dilatancy(law, m, 2 * speed_now / c.thickness, c.effective_stress()));
  }
  void drain(double speed_now, double dt, bool tangent = true) {
    const PoreRates r = rates(speed_now, tangent);
    const PoreChange change = advance(r, excess, dt);
    m *= std::exp(r.compaction * change.mean_excess * dt);
    const WetColumn c = column();
    excess = std::clamp(change.excess, -c.hydrostatic, c.normal_stress - c.hydrostatic);
  }
  /// Down the slope, friction last.
  void slide(double dt) {
    const auto brake = [&] {
      const WetColumn c = column();
      const auto d = dilatancy(law, m, 2 * speed / c.thickness, c.effective_stress());
      return c.effective_stress() * mixture_friction(tan_phi, d.tangent) / mass;
    };
    const double before = speed, first = brake();
    const double guess = std::max(0.0, before + dt * (slope_gravity - first));
    drain(0.5 * (before + guess), dt);
    speed = guess;
    const double mean = 0.5 * (first + brake());
    const double h = mass / law.density(m);
    speed = std::max(0.0, before + dt * (slope_gravity - mean)) *
            std::exp(-(1 - m) * 2 * law.fluid_viscosity * dt / (h * mass));
    path += 0.5 * (before + speed) * dt;
  }
};

/// Speed, path, p_b over total stress and solid fraction of a sheet 1 m thick that starts from rest
/// on 31 degrees with hydrostatic pressure; by an independent program with steps of 0.1 ms.
struct WetSlide {
  double u, x, lambda, m;
};
struct WetSheet {
  double m;
  std::array<WetSlide, 4> at;  // 1, 2, 5, 10 s
};
inline const WetSheet wet_sheets[] = {{.55,
                                       {{{4.059, 1.757, .9999, .5504},
                                         {9.111, 8.342, .9998, .5509},
                                         {24.264, 58.41, .9998, .5526},
                                         {49.52, 242.9, 1.0, .5552}}}},
                                      {.60,
                                       {{{3.242, 1.351, .9743, .6001},
                                         {8.282, 7.110, .9990, .6003},
                                         {23.398, 54.64, .9972, .6008},
                                         {48.51, 234.5, .9945, .6018}}}},
                                      {.62,
                                       {{{2.549, 1.105, .8121, .6200},
                                         {7.250, 5.903, .9961, .6201},
                                         {22.235, 50.18, .9876, .6205},
                                         {46.80, 223.0, .9727, .6211}}}},
                                      {.64,
                                       {{{1.623, .8184, .5059, .6400},
                                         {3.022, 3.172, .4526, .6400},
                                         {3.086, 14.20, .1193, .6399},
                                         {0, 17.52, .0639, .6395}}}},
                                      {.66,
                                       {{{.691, .5321, .2166, .6600},
                                         {0, .7278, .0747, .6599},
                                         {0, .7278, .0788, .6598},
                                         {0, .7278, .0856, .6596}}}}};

}  // namespace sturz::test
