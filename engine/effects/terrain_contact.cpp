// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/terrain_contact.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "engine/core/parallel.hpp"
#include "engine/laws/contact_impulse.hpp"

namespace sturz {
namespace {

struct ContactSums {
  double pressure_work = 0, contact_work = 0, friction = 0, spring = 0;

  void add(const ContactEnergy& e, double mass) {
    pressure_work += mass * e.pressure_work;
    contact_work += mass * e.contact_work;
    friction += mass * e.friction;
    spring += mass * e.spring;
  }
};

void combine(ContactSums& total, const ContactSums& block) {
  total.pressure_work += block.pressure_work;
  total.contact_work += block.contact_work;
  total.friction += block.friction;
  total.spring += block.spring;
}

/// Integral of the smoothing kernel over a plane at distance d (SmoothingKernel::plane_integral),
/// once per step and particle in the hot path.
double plane_integral(double d, double h) {
  const double y = 1 - std::fmax(d, 0.0) / (2 * h), y2 = y * y, y5 = y2 * y2 * y;
  return y > 0 ? 10.5 / h * y5 * (1 + y * (-1.5 + y * (4.0 / 7.0))) : 0;
}

/// The mirrored half's share of the pressure force: a = 2 p_n W_plane(d) / rho along n. With it
/// the bottom layers carry the pressure of the column above, and the spring only guards the gap.
class WallPressure {
 public:
  WallPressure(const State& s, const ContactSettings& c) {
    const Field* stress = s.grains.find_field("stress");
    if (!stress) return;
    for (int k = 0; k < 6; ++k) stress_[k] = stress->component[k].data();
    compression_ = s.grains.find_field("compression")->component[0].data();
    density_ = c.reference_density;
    share_ = s.boundary.share.data();
  }
  /// \param plane  plane_integral at the particle's distance [1/m]
  double acceleration(std::size_t i, double plane, double nx, double ny, double nz) const {
    if (!compression_) return 0;
    const double snn = nx * nx * stress_[0][i] + ny * ny * stress_[1][i] +
                       nz * nz * stress_[2][i] +
                       2 * (nx * ny * stress_[3][i] + ny * nz * stress_[4][i] +
                            nz * nx * stress_[5][i]);
    if (snn >= 0) return 0;
    return -2 * snn * plane * share_[i] / (density_ * (1 + compression_[i]));
  }

 private:
  double density_ = 1;
  const float* share_ = nullptr;
  const double* stress_[6] = {};
  const double* compression_ = nullptr;
};

/// Velocities at the start of the step, as the pack pass left them.
class StartVelocity {
 public:
  explicit StartVelocity(const State& s) : set_(s.grains), before_(set_.find_field("velocity_before")) {}
  std::array<double, 3> operator()(std::size_t i) const {
    if (!before_) return {set_.vx[i], set_.vy[i], set_.vz[i]};
    return {before_->component[0][i], before_->component[1][i], before_->component[2][i]};
  }

 private:
  const ParticleSet& set_;
  const Field* before_;
};

/// Looks up the ground under every particle and what the mirrored halves add to its gradients.
class BoundaryPass final : public Pass {
 public:
  explicit BoundaryPass(const ContactSettings& c) : settings_(c) {}
  std::string_view name() const override { return "ground and wall support"; }
  Stage stage() const override { return Stage::boundary; }

  void limits(const State& s, std::vector<StepLimit>& out) const override {
    const double v = s.motion.max_speed, cell = s.terrain.grid().cell_m;
    out.push_back(
        {"terrain cell", v > 0 ? 0.5 * cell / v : std::numeric_limits<double>::infinity()});
  }

  void apply(State& s, double dt) override {
    BoundarySupport& b = s.boundary;
    for (auto* column : {&b.distance, &b.nx, &b.ny, &b.nz, &b.plane})
      column->resize(s.grains.size());
    s.outside.resize(s.grains.size());
    const Mirror mirror(s, dt);
    const Found found = ordered_reduce(
        s.grains.size(), s.threads, Found{},
        [&](std::size_t begin, std::size_t end, Found& out) {
          for (std::size_t i = begin; i < end; ++i) {
            locate(s, i, out);
            mirror.set(b, i, b.plane[i], b.distance[i], b.nx[i], b.ny[i], b.nz[i]);
            for (const Wall& wall : s.domain.walls)
              if (s.time < wall.remove_at_s) add_wall(s, mirror, wall, i);
          }
        },
        [](Found& total, const Found& block) {
          total.any_outside |= block.any_outside;
          total.leaked += block.leaked;
        });
    s.any_outside = found.any_outside;
    s.ledger.leaked_mass += found.leaked;
  }

 private:
  struct Found {
    bool any_outside = false;
    double leaked = 0;
  };

  /// The ground's share of State::boundary's moment and gradient, and what walls add to it.
  class Mirror {
   public:
    Mirror(const State& s, double dt) : set_(s.grains), ahead_(s.extrapolation(dt)) {
      const Field* before = set_.find_field("velocity_before");
      if (!before) return;
      for (int k = 0; k < 3; ++k) before_[k] = before->component[k].data();
    }
    void set(BoundarySupport& b, std::size_t i, double plane, double d, double nx, double ny,
             double nz) const {
      put<false>(b, i, plane, d, nx, ny, nz);
    }
    void add(BoundarySupport& b, std::size_t i, double plane, double d, double nx, double ny,
             double nz) const {
      put<true>(b, i, plane, d, nx, ny, nz);
    }

   private:
    template <bool accumulate>
    void put(BoundarySupport& b, std::size_t i, double plane, double d, double nx, double ny,
             double nz) const {
      if (!before_[0]) return;  // nobody sums gradients
      const double vx = set_.vx[i] + ahead_ * (set_.vx[i] - before_[0][i]);
      const double vy = set_.vy[i] + ahead_ * (set_.vy[i] - before_[1][i]);
      const double vz = set_.vz[i] + ahead_ * (set_.vz[i] - before_[2][i]);
      const double moment = 2 * plane * (d > 0 ? d : 0);
      const double gradient = 2 * plane * (vx * nx + vy * ny + vz * nz);
      const double nn[6] = {nx * nx, ny * ny, nz * nz, nx * ny, ny * nz, nz * nx};
      for (int c = 0; c < 6; ++c) {
        const auto m = static_cast<float>(moment * nn[c]), g = static_cast<float>(gradient * nn[c]);
        b.moment[c][i] = accumulate ? b.moment[c][i] + m : m;
        b.gradient[c][i] = accumulate ? b.gradient[c][i] + g : g;
      }
    }

    const ParticleSet& set_;
    double ahead_;
    const double* before_[3] = {};
  };

  void locate(State& s, std::size_t i, Found& out) const {
    BoundarySupport& b = s.boundary;
    Vec3 at(s.grains.x[i], s.grains.y[i], s.grains.z[i]);
    s.domain.wrap(at.x(), at.y(), at.z());
    s.outside[i] = !s.terrain.inside(at.x(), at.y());
    b.plane[i] = 0;
    if (!s.outside[i]) {
      const SurfaceDistance gap = s.terrain.distance(at, 0.5 * settings_.spacing);
      b.distance[i] = gap.distance;
      b.nx[i] = gap.normal.x(), b.ny[i] = gap.normal.y(), b.nz[i] = gap.normal.z();
      b.plane[i] = plane_integral(gap.distance, settings_.smoothing_length);
      if (gap.distance < -2 * settings_.spacing) {  // lost underground: booked, never repaired
        s.outside[i] = 2;
        out.leaked += s.grains.mass[i];
      }
    }
    out.any_outside |= s.outside[i] != 0;
  }

  void add_wall(State& s, const Mirror& mirror, const Wall& wall, std::size_t i) const {
    const Vec3& n = wall.normal;
    const double d = (Vec3(s.grains.x[i], s.grains.y[i], s.grains.z[i]) - wall.point).dot(n);
    const double plane = plane_integral(d, settings_.smoothing_length);
    if (plane > 0) mirror.add(s.boundary, i, plane, d, n.x(), n.y(), n.z());
  }

  ContactSettings settings_;
};

void book(State& s, const ContactSums& sums) {
  s.ledger.stress_work += sums.pressure_work;
  s.ledger.contact_work += sums.contact_work;
  s.ledger.friction += sums.friction;
}

class GroundContact final : public Pass {
 public:
  explicit GroundContact(const ContactSettings& c) : settings_(c) {
    for (const GroundFriction& zone : c.base) {
      ContactLaw& law = laws_.emplace_back();
      law.stiffness = c.stiffness;
      law.damping = 2 * damping_ratio(c.restitution) * std::sqrt(c.stiffness);
      law.reach = 0.5 * c.spacing;
      law.friction = zone.friction_coefficient * (1 - zone.pore_pressure_ratio);
      // A particle in the first layer stands on an area of V/dx.
      law.cohesion_rate = zone.cohesion_pa / (c.reference_density * c.spacing);
      law.cohesion_reach = zone.cohesion_pa > 0 ? c.spacing : -1;
    }
  }
  std::string_view name() const override { return "terrain contact"; }
  Stage stage() const override { return Stage::contact; }

  void limits(const State&, std::vector<StepLimit>& out) const override {
    out.push_back({"terrain spring", 0.2 / std::sqrt(settings_.stiffness)});
  }

  void apply(State& s, double dt) override {
    ParticleSet& p = s.grains;
    const BoundarySupport& b = s.boundary;
    const WallPressure pressure(s, settings_);
    const StartVelocity start(s);
    const double reach = 2 * settings_.smoothing_length;
    const bool zoned = settings_.zones.any();
    const ContactSums sums = ordered_reduce(
        p.size(), s.threads, ContactSums{},
        [&](std::size_t begin, std::size_t end, ContactSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            if (s.outside[i] || b.distance[i] >= reach) continue;
            const double support =
                pressure.acceleration(i, b.plane[i], b.nx[i], b.ny[i], b.nz[i]);
            const ContactLaw& law = laws_[zoned ? zone_of(s, i) : 0];
            out.add(apply_contact(law, b.distance[i], b.nx[i], b.ny[i], b.nz[i], support, dt,
                                  start(i).data(), p.vx[i], p.vy[i], p.vz[i]),
                    p.mass[i]);
          }
        },
        combine);
    book(s, sums);
    s.ledger.spring = sums.spring;
  }

 private:
  std::size_t zone_of(const State& s, std::size_t i) const {
    double x = s.grains.x[i], y = s.grains.y[i], z = 0;
    s.domain.wrap(x, y, z);
    return static_cast<std::size_t>(settings_.zones.at(x, y));
  }

  ContactSettings settings_;
  std::vector<ContactLaw> laws_;  // by zone
};

/// The domain's analytic planes, each until it is removed.
class WallContact final : public Pass {
 public:
  explicit WallContact(const ContactSettings& c) : settings_(c) {}
  std::string_view name() const override { return "wall contact"; }
  Stage stage() const override { return Stage::contact; }

  void apply(State& s, double dt) override {
    for (const Wall& wall : s.domain.walls) {
      if (s.time >= wall.remove_at_s) continue;
      ContactLaw law;
      law.stiffness = settings_.stiffness;
      law.damping = 2 * damping_ratio(settings_.restitution) * std::sqrt(settings_.stiffness);
      law.reach = 0.5 * settings_.spacing;
      law.friction = wall.friction_coefficient;
      law.cohesion_reach = -1;
      press(s, wall, law, dt);
    }
  }

 private:
  void press(State& s, const Wall& wall, const ContactLaw& law, double dt) const {
    ParticleSet& p = s.grains;
    const WallPressure pressure(s, settings_);
    const StartVelocity start(s);
    const double reach = 2 * settings_.smoothing_length;
    const Vec3 n = wall.normal;
    const ContactSums sums = ordered_reduce(
        p.size(), s.threads, ContactSums{},
        [&](std::size_t begin, std::size_t end, ContactSums& out) {
          for (std::size_t i = begin; i < end; ++i) {
            const double d = (Vec3(p.x[i], p.y[i], p.z[i]) - wall.point).dot(n);
            if (d >= reach) continue;
            const double support =
                pressure.acceleration(i, plane_integral(d, settings_.smoothing_length), n.x(),
                                      n.y(), n.z());
            out.add(apply_contact(law, d, n.x(), n.y(), n.z(), support, dt, start(i).data(),
                                  p.vx[i], p.vy[i], p.vz[i]),
                    p.mass[i]);
          }
        },
        combine);
    book(s, sums);
    s.ledger.spring += sums.spring;
  }

  ContactSettings settings_;
};

}  // namespace

void add_terrain_contact(Step& step, State& state, const ContactSettings& settings) {
  step.add(std::make_unique<BoundaryPass>(settings));
  step.add(std::make_unique<GroundContact>(settings));
  if (!state.domain.walls.empty()) step.add(std::make_unique<WallContact>(settings));
}

}  // namespace sturz
