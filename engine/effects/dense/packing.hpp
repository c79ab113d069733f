// SPDX-License-Identifier: Apache-2.0
/// How density and the pressure of contacts follow from strain: for masses that stay dense, and for
/// those whose grains may disperse and meet again.
#pragma once

#include "engine/effects/dense/settings.hpp"
#include "engine/laws/grain_states.hpp"

#include <cmath>
#include <cstdint>

namespace sturz {

/// p = K e above the reference density, nothing below (docs/physics.md B.5 step 1).
struct DensePacking {
  static constexpr bool dilates = false;
  double bulk;  ///< K [Pa]

  /// How much dilation is remembered: the sums of few far neighbours drift, and a grain that must
  /// first lose a drifted 90 % of its volume would carry nothing when it is buried again.
  static double bounded(double e) { return e > -0.2 ? e : -0.2; }
  double pressure(double e) const { return e > 0 ? bulk * e : 0; }
  static const MuIRheology& yielding(const MuIRheology& law, double) { return law; }
  /// Whether the stress ratio of a grain that starts the step at e under p is smoothed.
  static bool smooths(double, double p, const MuIRheology&) { return p > 0; }
  /// Dilated grains carry no shear.
  static bool carries_shear(double e) { return !(e < GrainStressSettings::separation_threshold); }
};

/// p = K e + p_fric(alpha): one continuous law from dense to dilated (docs/physics.md B.9).
///
/// The density of the continuity equation drifts where neighbours are few. It is kept between what
/// the support completeness allows: not under 0.85 of it where that is nearly full (so a grain that
/// is packed in again counts as such), and not over eight times of it (so a grain that has lost its
/// neighbours does not count as dense: the surface of a dense mass has a support completeness of
/// about a half, a corner 0.3, a row of grains 0.1). In between the few neighbours of a cloud make
/// it too uneven to correct by. Few neighbours do not hold a grain under pressure either: see
/// held(). A grain that lies on the ground with hardly any neighbours is a sheet thinner than a
/// spacing, not a cloud: it stays dense, without load, so that it carries at once when others run
/// up on it.
struct DilatantPacking {
  static constexpr bool dilates = true;
  static constexpr double sparse = 0.12;  ///< support completeness below which no grain is dense
  static constexpr double surface =
      0.45;                   ///< support completeness from which a grain bears any load
  double bulk;                ///< K [Pa]
  double reference_fraction;  ///< alpha where e = 0
  FrictionalPressure friction;
  bool paper_switch;  ///< the paper's switch between laws instead of the sum
  double kept;        ///< exp(-dt/tau_r) of the switch's relaxation

  double fraction(double e) const { return reference_fraction * (1 + e); }
  /// e after dt of the continuity equation; never -1. \param strain  dt tr L
  static double carried(double e, double strain) {
    return strain > 0 ? (1 + e) / (1 + strain) - 1 : (1 + e) * (1 - strain) - 1;
  }
  /// Largest e that so few neighbours hold: 0 up to `sparse`, 0.017 at a support completeness of
  /// 0.2, 0.13 in a corner (0.3), any from `surface` on; grains at rest stay below. Without it a
  /// handful of grains that hits the ground bounces as one elastic body and throws one of them off
  /// with what the others lose. What the bound takes is accounted with density diffusion, as a
  /// loss.
  static double held(double completeness) {
    const double closed = smoothstep((completeness - sparse) / (surface - sparse));
    return 0.1 * closed / (1 - closed);
  }
  /// \param touching  whether it lies on the ground
  static double bounded(double e, double completeness, bool touching) {
    const double packed = touching ? 1 : 0.85 * completeness * smoothstep(2 * (completeness - 0.3));
    const double least = std::fmin(packed - 1, GrainStressSettings::separation_threshold);
    const double lifted = std::fmax(e, least);
    const double most =
        completeness < sparse && !touching ? completeness / sparse - 1 : held(completeness);
    return std::fmax(std::fmin(lifted, most), -0.999);
  }
  /// \param before  contact pressure at n [Pa]; \param state  GrainState at n
  double pressure(double e, double before, std::uint8_t state) const {
    const double squeezed = e > 0 ? bulk * e : 0;
    if (!paper_switch) return squeezed + friction.at(fraction(e));
    const bool dense = state == static_cast<std::uint8_t>(GrainState::dense);
    const double target = dense ? squeezed : friction.at(fraction(e));
    return target + (before - target) * kept;
  }
  /// Cohesion ends where grains separate, over the two percent after it ends in a mass that stays
  /// dense. Held on to through the transition it would be shear without pressure, that is tension,
  /// and pull grains into clumps (docs/physics.md B.13, I1).
  static MuIRheology yielding(const MuIRheology& law, double e) {
    MuIRheology faded = law;
    faded.cohesion *= smoothstep((e - GrainStressSettings::separation_threshold + 0.02) / 0.02);
    return faded;
  }
  /// Not where cohesion alone holds a grain: the ratio is that to p_c there, which is thousands of
  /// Pa, and a loaded neighbour's would flow into grains that only hang on (a bank bulged by an
  /// eighth of its height). The trace of pressure that such a grain keeps is no load.
  static bool smooths(double e, double p, const MuIRheology& law) {
    return law.cohesion > 0 ? e > 0 : p > 0;
  }
  static bool carries_shear(double) { return true; }  // as much as the frictional pressure allows
};

}  // namespace sturz
