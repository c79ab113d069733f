// SPDX-License-Identifier: Apache-2.0
#include "scenarios/assets/damage_curve.hpp"

#include <algorithm>

namespace sturz {

double damage_at(const DamageCurve& curve, double intensity) {
  const auto& p = curve.points;
  if (intensity < p.front().intensity) return 0;
  if (intensity >= p.back().intensity) return p.back().damage;
  const auto above =
      std::upper_bound(p.begin(), p.end(), intensity,
                       [](double x, const DamageCurve::Point& q) { return x < q.intensity; });
  const auto below = above - 1;
  const double share = (intensity - below->intensity) / (above->intensity - below->intensity);
  return std::min(above->damage, below->damage + share * (above->damage - below->damage));
}

}  // namespace sturz
