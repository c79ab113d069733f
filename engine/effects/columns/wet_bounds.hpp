// SPDX-License-Identifier: Apache-2.0
/// Where the water of a column is, and the bounds of its pressure: for the files of WetBlock only.
#pragma once

#include "engine/laws/pore_pressure.hpp"

#include <cmath>

namespace sturz {

// By value and with one comparison each, which is what puts them side by side; NaN stays.
inline double lesser(double a, double b) { return a < b ? a : b; }
inline double greater(double a, double b) { return a > b ? a : b; }
inline double within(double value, double low, double high) {
  const double raised = value < low ? low : value;
  return raised > high ? high : raised;
}

/// ColumnWater as far as a kick asks for it.
struct Pores {
  double thickness, level;  // of grains and pores; of the water [m]
  bool airy;

  Pores(double share, double m, double whole)
      : thickness(whole * share / m),
        level(m < share ? whole * (1 - share) / (1 - m) : whole),
        airy(m < share) {}
};

/// Not below zero, not above the weight, and not above what water in half-filled pores can hold.
inline double bounded(double excess, double stress, double still, bool airy) {
  const double room = stress - still;
  const double most = airy && room > 0 ? 0 : room;
  return within(excess, lesser(-still, most), most);
}

/// Elastic energy of what a bound cut off [J].
inline double cut_work(const MixtureLaw& law, double m, double excess, double inside, double stress,
                       double still, double volume) {
  // Beyond twice the weight a rate has run away, not a pressure.
  const double out = within(excess, -still - stress, 2 * stress - still) + still;
  const double in = inside + still;
  const double stiffness = law.stiffness(m, greater(0, stress - in));
  return inside == excess ? 0 : 0.5 * std::abs(out * out - in * in) / stiffness * volume;
}

}  // namespace sturz
