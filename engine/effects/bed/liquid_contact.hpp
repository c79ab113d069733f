// SPDX-License-Identifier: Apache-2.0
/// A liquid on the ground and beside walls.
///
/// The ground pushes along its normal as it does grains. Along it,
///   slip      nothing
///   no_slip   the images in the ground carry the shear stress (sweep/no_slip_sums.hpp); their push
///             along the ground is in the kick like that of any pair. Its work stays in
///             Ledger::stress_work: bed at rest and first layer are a layer of half a spacing whose
///             strain is in the particle's own velocity gradient, force and gradient are adjoint,
///             and so what this push takes from the motion is in stress_power, as viscous
///             dissipation of the liquid. As friction of the bed it would count twice.
///   film      the shear stress of a steady film, laws/liquid_film.hpp, on the whole depth alike: a
///             film of one to three layers moves as one, and its bed's stress divided by its mass
///             is what brakes it. Where the flow is deeper than the support, the layer within the
///             support is braked by the stress that its own mean speed has in the flow's profile,
///             and the pairs bear the rest. What it takes is Ledger::friction. Among grains the
///             stress inside acts on the liquid's share 1/(1 + X) of every face, and so does this:
///             a mixture that moves as one has tau_b = 3 mu v/((1 + X) H), as with no_slip.
#pragma once

#include "engine/effects/bed/contact_sums.hpp"
#include "engine/effects/bed/effect.hpp"

#include <cmath>

namespace sturz {

/// Deceleration of what is beside a surface: what can stop it, and what grows with its speed.
struct SurfaceDrag {
  double plastic = 0;  ///< [m/s^2]
  double rate = 0;     ///< [1/s]
};

/// Shear stress mu v/d of the liquid between a particle and a wall at rest. As the mirrored
/// pressure (WallPressure) it acts on all particles within the support by 2 W_plane(d): in even
/// shear they bear the wall's traction together.
/// Among grains the stress acts on the liquid's share of the wall, 1/(1 + X).
class WallShear {
 public:
  WallShear(const ContactSettings& c, double distance, double grain_share = 0)
      : law_(c.liquid->law),
        gap_(std::fmax(distance, 0.25 * c.spacing)),
        weight_(2 * plane_integral(distance, c.smoothing_length) /
                (c.reference_density * (1 + grain_share))) {}
  bool even() const { return law_.newtonian(); }
  SurfaceDrag operator()(double speed) const {
    if (law_.newtonian()) return {0, weight_ * law_.consistency / gap_};
    const double v = std::fmax(speed, 1e-9);
    return {weight_ * law_.yield_stress, weight_ * (law_.stress(v / gap_) - law_.yield_stress) / v};
  }

 private:
  HerschelBulkley law_;
  double gap_, weight_;
};

/// Adds the ground's contact of a set with ContactSettings::liquid.
void add_liquid_contact(Step&, std::size_t set, const ContactSettings&);

}  // namespace sturz
