// SPDX-License-Identifier: Apache-2.0
// V2 and V21: a mass slides down a smooth ramp, and it does not matter which way the ramp points.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz::test {
namespace {

/// The ramp's ground along the fall line: z(s), its slope and curvature.
struct Ramp {
  double fall = std::tan(30 * degree), half = 20;
  double z(double s) const {
    return s <= -half ? -fall * s : s >= half ? 0 : fall * (s - half) * (s - half) / (4 * half);
  }
  double slope(double s) const {
    return s <= -half ? -fall : s >= half ? 0 : fall * (s - half) / (2 * half);
  }
  double bend(double s) const { return std::abs(s) < half ? fall / (2 * half) : 0; }
};

/// A mass point on the ramp: energy height z + v^2/2g over the map distance from `start`.
///
/// Friction is mu N and N = m (g cos + v^2 kappa): with kappa = 0 this is the straight energy line
/// z_0 - mu (s - s_0); the bend of the ramp presses the mass on and takes exp(-2 mu 30 deg) of v^2.
class EnergyLine {
 public:
  EnergyLine(double start, double friction, bool bend) : start_(start) {
    const Ramp ramp;
    double u = 0, s = start;  // u = v^2
    for (; s < 400; s += step) {
      heights_.push_back(ramp.z(s) + u / (2 * gravity_m_s2));
      const double middle = s + 0.5 * step, p = ramp.slope(middle), q = 1 + p * p;
      const double pressed = bend ? ramp.bend(middle) / q * u : 0;
      u -= step * 2 * (gravity_m_s2 * p + friction * (gravity_m_s2 + pressed));
      if (u <= 0) break;
    }
    end_ = s;
  }
  double at(double s) const {
    const auto i = static_cast<std::size_t>(std::max(0.0, (s - start_) / step));
    return heights_[std::min(i, heights_.size() - 1)];
  }
  double end() const { return end_; }
  /// Angle from start to end.
  double angle_deg() const {
    return std::atan((heights_.front() - heights_.back()) / (end_ - start_)) / degree;
  }

 private:
  static constexpr double step = 0.002;
  double start_, end_ = 0;
  std::vector<double> heights_;
};

struct Descent {
  Finished finished;
  double s0 = 0, z0 = 0;        ///< centre of mass at the start
  std::vector<double> s, energy;  ///< its way and mean energy height
  double angle_deg() const {
    return std::atan((z0 - energy.back()) / (s.back() - s0)) / degree;
  }
  /// Root mean square over the way, as a share of the 100 m drop.
  double rmse(const EnergyLine& line) const {
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double off = (energy[i] - z0) - (line.at(s[i]) - line.at(s0));
      sum += off * off;
    }
    return std::sqrt(sum / s.size()) / 100;
  }
};

Descent descend(const Scenario& scene, double azimuth_deg = 90) {
  const double east = std::sin(azimuth_deg * degree), north = std::cos(azimuth_deg * degree);
  Simulation simulation = build(scene);
  const MeanMotion start = mean_motion(simulation.parts().state.grains);
  std::vector<double> s, energy;
  Finished f = run(std::move(simulation), {0.25, [&](double, const SimulationParts& p) {
                                             const MeanMotion m = mean_motion(p.state.grains);
                                             s.push_back(m.x * east + m.y * north);
                                             energy.push_back(m.z + m.energy_height);
                                           }});
  return {std::move(f), start.x * east + start.y * north, start.z, std::move(s), std::move(energy)};
}

Scenario block_like(Scenario s) {
  s.grains->cohesion_pa = 1e7;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(89);
  return s;
}

TEST(EnergyLine, Probe) {
  const double mu = std::tan(20 * degree);
  for (int k = 0; k < 6; ++k) {
    Scenario s = ramp_slide(90, k < 4 ? 3 : 2);
    if (k == 1 || k == 3) s.numerics.artificial_viscosity = 0.05;
    if (k >= 2 && k != 5) s = block_like(s);
    const Descent d = descend(s);
    const EnergyLine bent(d.s0, mu, true), straight(d.s0, mu, false);
    fmt::print("{} n {} wall {:.2f} | angle {:.3f} bent {:.3f} straight {:.3f} | end {:.2f} bent {:.2f} straight {:.2f} | rmse bent {:.4f} straight {:.4f} | resid {:.4f} plastic {:.3f} num {:.3f} fric {:.3f} damp {:.3f} out {}\n", k,
               d.finished.result.scalars.n_particles, d.finished.result.scalars.wall_s, d.angle_deg(), bent.angle_deg(), straight.angle_deg(), d.s.back(), bent.end(), straight.end(), d.rmse(bent), d.rmse(straight), d.finished.result.scalars.energy_residual,
               d.finished.simulation.parts().state.ledger.plastic/d.finished.simulation.parts().state.ledger.released_energy(),
               d.finished.simulation.parts().state.ledger.numerical()/d.finished.simulation.parts().state.ledger.released_energy(),
               d.finished.simulation.parts().state.ledger.friction/d.finished.simulation.parts().state.ledger.released_energy(),
               d.finished.simulation.parts().state.ledger.damping()/d.finished.simulation.parts().state.ledger.released_energy(), to_string(d.finished.result.outcome));
  }
}
TEST(EnergyLine, Rotation) {
  for (double dx : {3., 2.})
  for (double a : {90., 60., 45.}) {
    const Descent d = descend(ramp_slide(a, dx), a);
    const auto& m = d.finished.result.scalars;
    const double e = std::sin(a * degree), n = std::cos(a * degree);
    std::vector<double> r; const auto& p = d.finished.simulation.parts();
    for (size_t i = 0; i < p.state.grains.size(); ++i) r.push_back(p.state.grains.x[i] * e + p.state.grains.y[i] * n);
    std::sort(r.begin(), r.end());
    fmt::print("dx {} az {} n {} end com {:.3f} travel {:.3f} q99 {:.3f} q999 max {:.3f} front_travel {:.3f} runout {:.3f} out {}\n", dx, a, m.n_particles, d.s.back(), d.s.back() - d.s0, r[r.size() * 99 / 100] - d.s0, r.back() - d.s0, m.front_travel_m, m.runout_m, to_string(d.finished.result.outcome));
  }
}

}  // namespace
}  // namespace sturz::test
