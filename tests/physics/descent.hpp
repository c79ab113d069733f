// SPDX-License-Identifier: Apache-2.0
/// V2: a mass point and a mass on the ramp of catalogue.hpp's ramp_slide.
#pragma once

#include "tests/physics/verification.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sturz::test {

inline constexpr double drop_m = 100;
inline const double tan20 = std::tan(20 * degree);

/// The ramp's ground along the fall line: z(s), its slope and curvature.
struct Ramp {
  double fall = std::tan(30 * degree), half = 20;
  double z(double s) const {
    return s <= -half ? -fall * s : s >= half ? 0 : fall * (s - half) * (s - half) / (4 * half);
  }
  double slope(double s) const {
    return s <= -half ? -fall : s >= half ? 0 : fall * (s - half) / (2 * half);
  }
  double curvature(double s) const { return std::abs(s) < half ? fall / (2 * half) : 0; }
};

/// A mass point on the ramp: energy height z + v^2/2g over the path from `start`, on the map.
///
/// Friction is mu N with N = m (g cos + v^2 kappa). Without the second part this is the straight
/// line z_0 - mu (s - s_0) of depth-averaged codes; with it the bend presses the mass on and takes
/// 1 - exp(-2 mu 30 deg) = 32 % of v^2, whatever the bend's radius.
class EnergyLine {
 public:
  EnergyLine(double start, bool centripetal) : start_(start) {
    const Ramp ramp;
    double u = 0, s = start;  // u = v^2
    for (; s < 400; s += step) {
      heights_.push_back(ramp.z(s) + u / (2 * gravity_m_s2));
      const double middle = s + 0.5 * step, p = ramp.slope(middle), q = 1 + p * p;
      const double pressed = centripetal ? ramp.curvature(middle) / q * u : 0;
      u -= step * 2 * (gravity_m_s2 * p + tan20 * (gravity_m_s2 + pressed));
      if (u <= 0) break;
    }
    end_ = s;
  }
  double at(double s) const {
    const auto i = static_cast<std::size_t>(std::max(0.0, (s - start_) / step));
    return heights_[std::min(i, heights_.size() - 1)];
  }
  /// From start to end.
  double angle_deg() const {
    return std::atan((heights_.front() - heights_.back()) / (end_ - start_)) / degree;
  }

 private:
  static constexpr double step = 0.002;
  double start_, end_ = 0;
  std::vector<double> heights_;
};

/// The path of the centre of mass and the mean energy height over it.
struct Descent {
  Finished finished;
  double s0 = 0, z0 = 0;
  std::vector<double> s, energy;

  double angle_deg() const { return std::atan((z0 - energy.back()) / (s.back() - s0)) / degree; }
  /// Root mean square deviation, as a share of the drop.
  double rmse(const EnergyLine& line) const {
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double off = (energy[i] - z0) - (line.at(s[i]) - line.at(s0));
      sum += off * off;
    }
    return std::sqrt(sum / s.size()) / drop_m;
  }
};

inline Descent descend(const Scenario& scene, double azimuth_deg = 90) {
  const double east = std::sin(azimuth_deg * degree), north = std::cos(azimuth_deg * degree);
  Simulation simulation = build(scene);
  const MeanMotion start = mean_motion(simulation.parts().state.grains());
  std::vector<double> s, energy;
  Finished f = run(std::move(simulation), {0.25, [&](double, const SimulationParts& p) {
                                             const MeanMotion m = mean_motion(p.state.grains());
                                             s.push_back(m.x * east + m.y * north);
                                             energy.push_back(m.z + m.energy_height);
                                           }});
  return {std::move(f), start.x * east + start.y * north, start.z, std::move(s), std::move(energy)};
}

}  // namespace sturz::test
