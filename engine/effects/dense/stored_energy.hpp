// SPDX-License-Identifier: Apache-2.0
/// What one grain's stress stores.
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/effects/fields.hpp"
#include "engine/particles/particle_set.hpp"

#include <cmath>

namespace sturz {

/// Elastic energy [J] of a reference volume: V_0 (p^2/2K + tau^2/2G), p = K max(0, density_change).
inline double elastic_energy(const GrainStressSettings& g, double volume, double density_change,
                             double shear_stress) {
  const double p = g.bulk_modulus() * std::fmax(0.0, density_change);
  return volume *
         (p * p / (2 * g.bulk_modulus()) + shear_stress * shear_stress / (2 * g.shear_modulus()));
}

/// That of particle i, from its fields "density_change" and "stress" [J].
inline double stored_energy(const GrainStressSettings& g, const ParticleSet& set, std::size_t i) {
  const double e = set.scalar(fields::density_change)[i];
  const auto& c = set.components(fields::stress);
  const double p = -(c[0][i] + c[1][i] + c[2][i]) / 3;
  const double xx = c[0][i] + p, yy = c[1][i] + p, zz = c[2][i] + p;
  const double tau = std::sqrt(0.5 * (xx * xx + yy * yy + zz * zz) + c[3][i] * c[3][i] +
                               c[4][i] * c[4][i] + c[5][i] * c[5][i]);
  return elastic_energy(g, set.mass[i] / g.reference_density, e, tau);
}

}  // namespace sturz
