// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/liquid/random_liquids.hpp"

#include "engine/core/constants.hpp"
#include "engine/simulation/parts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace sturz::test {
namespace {

constexpr double gravity = standard_gravity;

/// The same numbers on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t number) : random_(977 * number + 13) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double decades(double low, double high) {
    return std::pow(10, between(std::log10(low), std::log10(high)));
  }
  int whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 random_;
};

/// 60 degrees down to x = 0, level beyond.
double cliff(double x, double) { return std::max(0.0, -std::sqrt(3.0) * x); }

double bumps(double x, double y) { return -0.4 * x + 0.6 * std::sin(0.9 * x) * std::cos(0.7 * y); }

LiquidSettings liquid_of_prior(Draw& draw) {
  LiquidSettings g;
  g.law.consistency = draw.decades(1e-6, 1e3);
  g.law.index = draw.whole(0, 2) == 0 ? 1 : draw.between(0.3, 1);
  g.law.yield_stress = draw.whole(0, 1) == 0 ? 0 : draw.decades(1, 5e3);
  g.reference_density = draw.between(900, 2000);
  return g;
}

void collapse(HardLiquid& m, Draw& draw) {
  m.name = "column on a slope";
  m.box.n = {draw.whole(2, 6), draw.whole(2, 6), draw.whole(1, 10)};
  m.box.slope = std::tan(draw.between(0, 0.25 * 3.14159));
}

void sheet_on_cliff(HardLiquid& m, Draw& draw) {
  m.name = "sheet on a cliff";
  const double dx = m.box.spacing;
  const double along = 0.5 * dx;  // of the slope; half a spacing above it along its normal
  const int rows = draw.whole(3, 10), width = draw.whole(1, 5);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < width; ++j) {
      const double s = (i + 1) * dx;
      m.box.at.emplace_back(-0.5 * s + along * std::sqrt(0.75), (j - 0.5 * width) * dx,
                            std::sqrt(0.75) * s + 0.5 * along);
    }
  m.box.ground = cliff;
}

void falling_drop(HardLiquid& m, Draw& draw) {
  m.name = "drop from 50 m";
  const int n = draw.whole(1, 5);
  const double dx = m.box.spacing;
  const double x = -draw.between(2, 12) * dx;
  for (int k = 0; k < n; ++k)
    m.box.at.emplace_back(x + (k % 2) * dx, (k / 2 % 2) * dx, cliff(x, 0) + 50 + (k / 4) * dx);
  m.box.ground = cliff;
}

void impact(HardLiquid& m, Draw& draw) {
  m.name = "impact at 40 m/s";
  const double dx = m.box.spacing;
  m.box.n = {draw.whole(1, 6), draw.whole(1, 4), draw.whole(1, 6)};
  m.box.velocity = {40, 0, 0};
  m.box.domain.walls = {Wall{{m.box.n[0] * dx + 3 * dx, 0, 0}, {-1, 0, 0}}};
  m.box.hydrostatic = false;
}

void gate(HardLiquid& m, Draw& draw) {
  m.name = "gate";
  const double dx = m.box.spacing;
  m.box.n = {draw.whole(2, 6), draw.whole(2, 5), draw.whole(2, 10)};
  Wall gate{{m.box.n[0] * dx, 0, 0}, {-1, 0, 0}};
  gate.remove_at_s = draw.between(0.1, 1) * std::sqrt(m.box.n[2] * dx / gravity);
  m.box.domain.walls = {Wall{{0, 0, 0}, {1, 0, 0}}, Wall{{0, 0, 0}, {0, 1, 0}},
                        Wall{{0, m.box.n[1] * dx, 0}, {0, -1, 0}}, gate};
}

void sheet_over_bumps(HardLiquid& m, Draw& draw) {
  m.name = "sheet over bumps";
  const double dx = m.box.spacing;
  const int nx = draw.whole(2, 8), ny = draw.whole(1, 8), layers = draw.whole(1, 2);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < layers; ++k) {
        const double x = (i + 0.5) * dx, y = (j + 0.5) * dx;
        m.box.at.emplace_back(x, y, bumps(x, y) + (k + 0.7) * dx);
      }
  m.box.ground = bumps;
  m.box.velocity = {20, 0, 0};
  m.box.hydrostatic = false;
}

}  // namespace

HardLiquid hard_liquid(std::uint64_t number) {
  Draw draw(number);
  HardLiquid m;
  m.box.spacing = draw.decades(0.1, 2);
  m.box.settings = liquid_of_prior(draw);
  constexpr void (*kinds[])(HardLiquid&, Draw&) = {collapse, sheet_on_cliff, falling_drop,
                                                   impact,   gate,           sheet_over_bumps};
  kinds[number % 6](m, draw);
  LiquidBox& b = m.box;
  const double dx = b.spacing;
  m.depth_m = b.at.empty() ? b.n[2] * dx : dx;
  m.top_m = m.depth_m;
  for (const Vec3& p : b.at) m.top_m = std::max(m.top_m, p.z() + 0.5 * dx);
  b.top = m.top_m;
  if (!b.at.empty()) b.hydrostatic = false;
  m.start_speed = b.velocity.norm();
  // What falls, falls this far; then some more of the ground that it runs down in the time.
  const double drop = m.top_m + (b.slope + (number % 6 == 5 ? 0.4 : 0)) * 12 * dx;
  const double fastest = std::sqrt(m.start_speed * m.start_speed + 2 * gravity * drop);
  b.settings.sound_speed = 10 * std::max(fastest, 2 * std::sqrt(gravity * m.depth_m));
  b.settings.least_sound_speed = 10 * std::sqrt(gravity * std::max(m.depth_m, dx));
  m.end_s = 2 * std::sqrt(2 * drop / gravity) + 10 * dx / std::max(1.0, m.start_speed);
  b.half_width = 40 * dx + (m.start_speed + fastest) * 0.5 * m.end_s;
  b.cell = 2 * std::max(dx, b.half_width / 200);
  m.name = fmt::format("liquid, member {}, {}", number, m.name);
  return m;
}

Survival run(const HardLiquid& m) {
  Simulation simulation = simulation_of(m.box, m.end_s);
  const LiquidSettings& g = m.box.settings;
  const double estimate =
      g.courant * 1.3 * m.box.spacing / (1.16 * g.sound_speed + 0.1 * g.sound_speed);
  RunFacts& facts = simulation.parts().facts;
  facts.release.top_m = m.top_m;
  facts.least_dt_s = 1e-3 * estimate;
  return survive(std::move(simulation), m.start_speed, estimate);
}

std::vector<Check> checks_of(const HardLiquid& m, const Survival& s) {
  std::vector<Check> checks = checks_of(s, true);
  const double pushed = 2 * std::sqrt(gravity * m.depth_m);
  checks.push_back(at_most("largest speed / (free fall + 2 sqrt(g H))",
                           s.speed_ratio * s.free_fall / (s.free_fall + pushed), 1.05));
  return checks;
}

}  // namespace sturz::test
