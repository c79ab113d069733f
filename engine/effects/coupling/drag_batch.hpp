// SPDX-License-Identifier: Apache-2.0
/// The drag of many grains at once: its powers and exponentials in loops that run over lanes.
#pragma once

#include "engine/core/plain_exp.hpp"
#include "engine/core/plain_log.hpp"
#include "engine/core/vec.hpp"
#include "engine/laws/drag.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace sturz {

/// Grains that wait for their drag, [capacity] each.
class DragBatch {
 public:
  static constexpr std::size_t capacity = 256;

  explicit DragBatch(const GranularDrag& law) : law_(law) {}
  std::size_t size() const { return n_; }
  std::uint32_t row(std::size_t k) const { return row_[k]; }

  /// \param before,now  slip at the start of the step and as forces have left it [m/s]
  /// \param reduced  mass that the slip moves [kg]
  /// \param force  drag per slip and rate of the law, times the kick [m^3 s/kg]
  void add(std::uint32_t row, const Vec3& before, const Vec3& now, double solids, double reduced,
           double force) {
    row_[n_] = row, before_[n_] = before, now_[n_] = now;
    solids_[n_] = std::clamp(solids, 0.0, 1 - GranularDrag::least_pores);
    reduced_[n_] = reduced, force_[n_] = force, slip_[n_] = before.norm();
    ++n_;
  }
  /// With the mean of the slips at both ends: a grain that settles does so at the law's speed
  /// whatever the step.
  void relax() {
    look_up();
    decay();
    for (std::size_t k = 0; k < n_; ++k) slip_[k] = 0.5 * (slip_[k] + (now_[k] - taken(k)).norm());
    decay();
  }
  /// Impulse on the grain [kg m/s].
  Vec3 impulse(std::size_t k) const { return -reduced_[k] * taken(k); }

 private:
  using Column = std::array<double, capacity>;

  /// The law at each share of grains, as GranularDrag::AtShare.
  void look_up() {
    for (std::size_t k = 0; k < n_; ++k) dispersion_[k] = GranularDrag::dispersion(solids_[k]);
    const double d = law_.diameter, mu = law_.viscosity, rho = law_.density;
    for (std::size_t k = 0; k < n_; ++k) {
      const double pores = 1 - solids_[k], phi = dispersion_[k], through = plain_pow(pores, -1.65);
      packed_[k] = (1 - phi) * 150 * solids_[k] * mu / (pores * d * d);
      inertial_[k] = (1 - phi) * 1.75 * rho / d;
      slow_[k] = phi * 18 * mu / (d * d) * through / pores;
      fast_[k] = phi * 0.33 * rho / d * through;
      per_slip_[k] = pores * rho * d / mu;
    }
  }
  void decay() {
    for (std::size_t k = 0; k < n_; ++k) {
      const double reynolds = per_slip_[k] * slip_[k];
      const double slow = slow_[k] * (1 + 0.15 * plain_pow(reynolds, 0.687));
      const double single = reynolds < 1000 ? slow : fast_[k] * slip_[k];
      const double steps = force_[k] * (packed_[k] + inertial_[k] * slip_[k] + single);
      const Decay d = decay_over(steps);
      decayed_[k] = steps * d.mean;
      driven_[k] = steps * d.lag;
    }
  }
  /// Slip that drag takes off, as slip_taken() of laws/phase_drag.hpp.
  Vec3 taken(std::size_t k) const {
    if (before_[k].dot(now_[k]) < 0) return decayed_[k] * now_[k];
    return decayed_[k] * before_[k] + driven_[k] * (now_[k] - before_[k]);
  }

  GranularDrag law_;
  std::size_t n_ = 0;
  std::array<std::uint32_t, capacity> row_{};
  std::array<Vec3, capacity> before_, now_;  // Eigen's leave their numbers open
  Column solids_{}, reduced_{}, force_{}, slip_{}, dispersion_{};
  Column packed_{}, inertial_{}, slow_{}, fast_{}, per_slip_{}, decayed_{}, driven_{};
};

}  // namespace sturz
