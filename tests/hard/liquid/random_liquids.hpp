// SPDX-License-Identifier: Apache-2.0
/// Members of liquid that want to blow up: water to stiff mud, from one particle to ten layers.
#pragma once

#include "tests/hard/survival.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace sturz::test {

/// One random scene. By its number modulo six:
///   0  a column of 1 to 10 layers collapses on a slope of up to 45 degrees
///   1  a sheet one particle thick on a cliff of 60 degrees
///   2  a drop of 1 to 5 particles falls from 50 m onto the cliff
///   3  a block hits a wall at 40 m/s
///   4  a column behind a gate that is taken away
///   5  a sheet of one or two layers runs at 20 m/s over bumps
/// Viscosity 1e-6 to 1e3 Pa s^n, index 0.3 to 1, yield stress 0 or 1 Pa to 5 kPa, 900 to
/// 2,000 kg/m^3, particles 0.1 to 2 m apart.
struct HardLiquid {
  std::string name;
  LiquidBox box;
  double top_m = 0;        ///< of the release
  double depth_m = 0;      ///< of its liquid
  double start_speed = 0;  ///< [m/s]
  double end_s = 0;
};
HardLiquid hard_liquid(std::uint64_t number);

/// Runs it on one thread.
Survival run(const HardLiquid&);

/// checks_of() with a bound of its own for the speed: pressure may push a front ahead at 2 sqrt(g
/// H) (Ritter 1892) on top of what it has fallen.
std::vector<Check> checks_of(const HardLiquid&, const Survival&);

}  // namespace sturz::test
