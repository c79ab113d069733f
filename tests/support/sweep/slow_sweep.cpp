// SPDX-License-Identifier: Apache-2.0
#include "tests/support/sweep/slow_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::test {
namespace {

using Eigen::Matrix3d;

/// dW/dr of Wendland C2, B.1: -105/(16 pi h^4) q (1 - q/2)^3, scaled to the factor in use.
double derivative(double r, const SweepConstants& c) {
  const double h = c.h, q = r / h;
  if (q >= 2) return 0;
  const double rest = 1 - 0.5 * q, h2 = h * h;
  const double normal = c.gradient_factor * 16 * std::numbers::pi * h2 * h2 * h / 105;
  return -normal * 105 / (16 * std::numbers::pi * h2 * h2) * q * rest * rest * rest;
}

/// Wendland C2 but for a factor.
double w(double r, double h) {
  const double q = r / h, t = 1 - 0.5 * q;
  return t * t * t * t * (2 * q + 1);
}

/// s/(p + p_c)
Matrix3d pressure_ratio(const Matrix3d& stress, const SweepConstants& c) {
  return stress / (c.ratio_floor - stress.trace() / 3);
}

/// B = M^-1, or the identity for det M < 0.15 or |B| > 5.
Matrix3d correction(const Matrix3d& moment, bool& corrected) {
  corrected = moment.determinant() >= 0.15;
  if (!corrected) return Matrix3d::Identity();
  const Matrix3d b = moment.inverse();
  corrected = b.norm() <= 5;
  return corrected ? b : Matrix3d::Identity();
}

/// The same in units of the mean diagonal, for clouds.
Matrix3d correction_in_a_cloud(const Matrix3d& moment, double dilation_ratio, bool& corrected) {
  const double least = std::max(1 / (dilation_ratio * dilation_ratio), 0.5);
  const double mean = std::min(1.0, std::max(moment.trace() / 3, least));
  return correction(moment / mean, corrected) / mean;
}

/// The image of b in a bed that holds it, by the traces that it leaves in a continuum: velocity odd
/// about the bed along its normal, stress as that of b.
struct HeldImage {
  const SlowParticle &a, &b;
  Vec3 r, image, grad;     ///< offsets of b and of its image, grad W there with both weights
  double damped, holding;  ///< artificial viscosity over distance^2, how much of it is held

  Matrix3d across() const { return a.ground_normal * a.ground_normal.transpose(); }
  Matrix3d along() const { return Matrix3d::Identity() - across(); }
  Matrix3d gradient() const {
    return -b.volume * ((a.velocity + b.velocity) * (across() * grad).transpose() +
                        (a.velocity - b.velocity) * (along() * grad).transpose());
  }
  Matrix3d moment() const {
    const double f = -grad.dot(image) / image.squaredNorm() * b.volume;
    return f * (r * r.transpose() + 4 * a.ground_distance * b.ground_distance * across());
  }
  Vec3 force() const {
    const Vec3 sum = a.velocity + b.velocity, difference = a.velocity - b.velocity;
    const double normal = sum.dot(across() * image);
    const double slips = difference.dot(along() * image) + normal;
    const double holds = sum.dot(along() * image);
    const Vec3 noise = (1 - holding) * damped * slips * grad;
    const Vec3 held = holding * damped * (holds * along() * grad + normal * across() * grad);
    return (a.stress + b.stress) * grad + noise + held;
  }
};

}  // namespace

std::vector<SlowRates> slow_sweep(const std::vector<SlowParticle>& particles,
                                  const std::vector<SlowParticle>& images, const SweepConstants& c,
                                  bool clouds, bool no_slip) {
  std::vector<SlowRates> out(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const SlowParticle& a = particles[i];
    const double density_a = c.reference_density * (1 + a.density_change);
    Matrix3d gradient = Matrix3d::Zero(), moment = Matrix3d::Zero();
    Vec3 force(0, 0, 0), density_gradient(0, 0, 0);
    double laplace = 0;
    SlowRates& rates = out[i];
    Matrix3d image_gradient = Matrix3d::Zero(), image_moment = Matrix3d::Zero();
    const Matrix3d reflection =
        Matrix3d::Identity() - 2 * a.ground_normal * a.ground_normal.transpose();
    const auto add_image = [&](const SlowParticle& b) {
      const double da = a.ground_distance, db = b.ground_distance;
      if (da >= 2 * c.h || db >= 2 * c.h) return;
      const Vec3 r = a.position - b.position, image = r + 2 * db * a.ground_normal;
      const double distance =
          std::sqrt(std::max(r.squaredNorm() + 4 * da * db, (da + db) * (da + db)));
      if (distance >= 2 * c.h) return;
      const double both = a.ground_weight * b.ground_weight;
      const Vec3 grad = both * derivative(distance, c) * image / distance;
      const double share = 0.5 * (a.viscosity_share + b.viscosity_share);
      const double damped = share * c.viscosity * c.sound_speed * c.h * c.reference_density /
                            (distance * distance + 0.01 * c.h * c.h);
      if (no_slip) {
        const double holding = 0.5 * (a.held_viscosity + b.held_viscosity) / share;
        const HeldImage held{a, b, r, image, grad, damped, holding};
        image_gradient += held.gradient(), image_moment += held.moment();
        rates.from_ground += b.volume / density_a * held.force();
        return;
      }
      const Vec3 u = a.velocity - reflection * b.velocity;
      image_gradient -= b.volume * u * grad.transpose();
      image_moment -= b.volume * image * grad.transpose();
      const double q = damped * u.dot(image);
      rates.from_ground +=
          b.volume / density_a *
          ((a.stress + reflection * b.stress * reflection + q * Matrix3d::Identity()) * grad);
    };
    const auto add = [&](const SlowParticle& b) {
      const Vec3 r = a.position - b.position;
      const double distance = r.norm();
      if (distance == 0 || distance >= 2 * c.h) return;
      const Vec3 grad = derivative(distance, c) * r / distance;  // of W_ij at i
      const Vec3 u = a.velocity - b.velocity;
      const double density_b = c.reference_density * (1 + b.density_change);
      const double mass_b = b.volume * density_b;
      gradient += b.volume * (b.velocity - a.velocity) * grad.transpose();
      moment += b.volume * (b.position - a.position) * grad.transpose();
      // Bilateral viscosity; the mean density of a pair is taken as rho_a rho_b / rho_ref.
      const double phi = c.h * u.dot(r) / (r.squaredNorm() + 0.01 * c.h * c.h);
      const double share = 0.5 * (a.viscosity_share + b.viscosity_share);
      const double pi = -share * c.viscosity * c.sound_speed * phi * c.reference_density /
                        (density_a * density_b);
      force += mass_b *
               ((a.stress + b.stress) / (density_a * density_b) - pi * Matrix3d::Identity()) * grad;
      force += b.volume * a.weight * b.weight / density_a *
               ((a.kinetic_stress + b.kinetic_stress) * grad);
      if (c.tension) {
        const double near = w(distance, c.h) / w(c.spacing, c.h), near2 = near * near;
        force -= b.volume / density_a * (a.tension + b.tension) * near2 * near2 * grad;
      }
      ++rates.neighbors;
      const double rise = b.density_change - a.density_change;
      const double weight = -grad.dot(r) / r.squaredNorm();  // F_ij without the 0.01 h^2
      laplace +=
          b.volume * weight * (rise + 0.5 * (a.density_gradient + b.density_gradient).dot(r));
      const double conduction = 4 / (1 / a.conductivity + 1 / b.conductivity);
      const double shared = b.volume * a.weight * b.weight / a.dilation_ratio;
      rates.conducted += shared * conduction * weight * (b.theta - a.theta);
      const Matrix3d seen = -shared * u * grad.transpose();
      rates.pair_gradient += 0.5 * (seen + seen.transpose());
      density_gradient += b.volume * rise * grad;
      rates.smoothing +=
          b.volume * weight * (pressure_ratio(b.stress, c) - pressure_ratio(a.stress, c));
    };
    for (const SlowParticle& b : particles)
      if (&b != &a) add(b);
    for (const SlowParticle& b : images) add(b);
    for (const SlowParticle& b : particles) add_image(b);
    for (const SlowParticle& b : images) add_image(b);
    bool own_corrected = true;
    // n.M.n / 0.25 with n n from the walls' moment: without grains above there is no mirror
    // contribution.
    rates.density_gradient = correction(moment, own_corrected) * density_gradient;
    rates.ground_weight =
        std::clamp(4 * a.dilation_ratio * a.ground_normal.dot(moment * a.ground_normal), 0.0, 1.0);
    gradient += image_gradient, moment += image_moment;
    rates.pair_sums = gradient;
    rates.support_completeness = moment.trace() / 3;
    gradient *= a.dilation_ratio;  // neighbours that dilated alike leave too little
    const Matrix3d grown = a.dilation_ratio * moment;
    const double along = grown.cwiseProduct(a.wall_moment).sum();
    rates.mirror_weight = std::clamp(4 * along / std::max(a.wall_moment.trace(), 1e-6), 0.0, 1.0);
    const Matrix3d mirrored = grown + rates.mirror_weight * a.wall_moment;
    rates.gradient = (gradient + rates.mirror_weight * a.wall_gradient) *
                     (clouds ? correction_in_a_cloud(mirrored, a.dilation_ratio, rates.corrected)
                             : correction(mirrored, rates.corrected));
    rates.support_completeness +=
        rates.mirror_weight * a.wall_moment.trace() / (3 * a.dilation_ratio);
    const Vec3& n = a.ground_normal;
    rates.acceleration = force + rates.from_ground - rates.from_ground.dot(n) * n;
    rates.diffusion = 2 * c.density_diffusion * c.h * c.sound_speed * laplace;
    rates.smoothing *= 2 * c.stress_smoothing * c.h * c.sound_speed;
    rates.smoothing -= rates.smoothing.trace() / 3 * Matrix3d::Identity();
    rates.corrected = rates.corrected && own_corrected;
  }
  return out;
}

}  // namespace sturz::test
