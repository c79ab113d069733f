// SPDX-License-Identifier: Apache-2.0
// I4 and V9: a pile that may stay stays; one that is too steep comes down to its friction angle.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

/// Where a pile is: centre of mass, edge, and every particle by its id.
struct Place {
  MeanMotion centre;
  double edge = 0, edge_99 = 0;  ///< radius of the farthest particle, and of 99 % of them
  std::vector<double> x, y, z;
};

Place place_of(const ParticleSet& p) {
  Place at{mean_motion(p), 0, 0, {}, {}, {}};
  for (auto* column : {&at.x, &at.y, &at.z}) column->resize(p.size());
  std::vector<double> radius;
  for (std::size_t i = 0; i < p.size(); ++i) {
    at.x[p.id[i]] = p.x[i], at.y[p.id[i]] = p.y[i], at.z[p.id[i]] = p.z[i];
    radius.push_back(std::hypot(p.x[i], p.y[i]));
  }
  std::sort(radius.begin(), radius.end());
  at.edge = radius.back();
  at.edge_99 = radius[radius.size() * 99 / 100];
  return at;
}

double centre_moved(const Place& a, const Place& b) {
  return std::hypot(a.centre.x - b.centre.x, a.centre.y - b.centre.y, a.centre.z - b.centre.z);
}

/// The displacement that 99 % of the particles stay below.
double moved_99(const Place& a, const Place& b) {
  std::vector<double> d;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    d.push_back(std::hypot(a.x[i] - b.x[i], a.y[i] - b.y[i], a.z[i] - b.z[i]));
  std::sort(d.begin(), d.end());
  return d[d.size() * 99 / 100];
}

/// Over 10 s after the release has found its elastic balance, for which it has 5 sqrt(H/g).
void rests(double spacing_m) {
  Scenario s = pile(spacing_m);
  const double settled_s = 5 * std::sqrt(4 / gravity_m_s2);
  s.numerics.end_time_s = settled_s + 10;
  Simulation simulation = build(s);
  const Place release = place_of(simulation.parts().state.grains());
  Place start;
  const Finished f = run(std::move(simulation), {0.02, [&](double t, const SimulationParts& p) {
                                                   if (start.x.empty() && t >= settled_s)
                                                     start = place_of(p.state.grains());
                                                 }});
  const Place end = place_of(f.simulation.parts().state.grains());
  const std::string name = fmt::format("I4 pile, dx {} m", spacing_m);
  const double sunk = centre_moved(start, release) / spacing_m;
  record({name + ", centre of mass while it settles", "dx", sunk, 0, sunk}, f);
  const double centre = centre_moved(end, start) / spacing_m;
  const double edge = (end.edge - start.edge) / spacing_m;
  const double most = moved_99(end, start) / spacing_m;
  expect_within({name + ", centre of mass", "dx in 10 s", centre, 0, centre, 0.01}, f);
  expect_within({name + ", front", "dx in 10 s", edge, 0, edge, 0.01}, f);
  record({name + ", 99 % of the particles", "dx in 10 s", most, 0, most}, f);
  expect_conserved(name, f);
}

TEST(PileAtRest, StaysWhereItIs) { rests(1); }

TEST(PileAtRest, FinerPileStaysToo) { rests(0.8); }

/// Mean slope of the tops of rings or slices, between a quarter and three quarters of the height.
double slope_of_tops(const std::vector<double>& top, double spacing_m) {
  const double height = *std::max_element(top.begin(), top.end());
  std::vector<double> r, z;
  for (std::size_t k = 0; k < top.size(); ++k)
    if (top[k] > 0.25 * height && top[k] < 0.75 * height) {
      r.push_back((k + 0.5) * spacing_m);
      z.push_back(top[k]);
    }
  return std::atan(-slope_of(r, z)) / degree;
}

/// Of the highest particles of rings.
double slope_deg(const ParticleSet& p, double spacing_m) {
  std::vector<double> top(200, 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto ring = static_cast<std::size_t>(std::hypot(p.x[i], p.y[i]) / spacing_m);
    if (ring < top.size()) top[ring] = std::max(top[ring], p.z[i] + 0.5 * spacing_m);
  }
  return slope_of_tops(top, spacing_m);
}

class SteepPile : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Angles, SteepPile, testing::Values(25, 35),
                         [](const auto& i) { return fmt::format("Friction{:.0f}Deg", i.param); });

/// 8 m high over a radius of 8 m, up to 63 degrees steep.
TEST_P(SteepPile, ComesDownToItsFrictionAngle) {
  const double dx = 0.8;
  Scenario s = pile(dx);
  s.release.paraboloid = ReleaseParaboloid{{0, 0}, {8, 8}};
  s.release.thickness_m = Uncertain(8);
  s.grains->friction_angle_deg = Uncertain(GetParam());
  s.numerics.end_time_s = 16;
  Place before;
  double from = 0;
  const Finished f = run(s, {4, [&](double t, const SimulationParts& p) {
                               if (t < 11 || from > 0) return;
                               before = place_of(p.state.grains());
                               from = t;
                             }});
  const ParticleSet& p = f.simulation.parts().state.grains();
  const Place end = place_of(p);
  const double seconds = f.result.scalars.end_time_s - from;
  const double slope = slope_deg(p, dx);
  const std::string name = fmt::format("V9 steep pile, friction {} deg", GetParam());
  expect_within({name + ", slope", "deg", slope, GetParam(), slope - GetParam(), 2}, f);
  EXPECT_GT(slope, 0.5 * GetParam());  // a listed miss does not get that far
  const double centre = centre_moved(end, before) / dx / seconds;
  const double edge = (end.edge_99 - before.edge_99) / dx / seconds;
  const double most = moved_99(end, before) / dx / seconds;
  expect_within({name + ", creep of the centre", "dx/s", centre, 0, centre, 0.01}, f);
  expect_within({name + ", creep of the edge", "dx/s", edge, 0, edge, 0.01}, f);
  expect_within({name + ", creep of 99 % of the particles", "dx/s", most, 0, most, 0.01}, f);
  expect_conserved(name, f);
}

class DrainedPile : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Angles, DrainedPile, testing::Values(25, 35),
                         [](const auto& i) { return fmt::format("Friction{:.0f}Deg", i.param); });

/// A slice of grains between a smooth wall and the edge of the terrain, over which they leave: what
/// stays is a wedge at its angle of repose, down to which it drains from above, the bed as rough as
/// it is.
TEST_P(DrainedPile, KeepsItsFrictionAngle) {
  const int slices = 20;
  const double dx = 0.5, length = slices * dx, wide = 4 * dx;
  Scenario s = pile(dx);
  s.terrain.synthetic = SyntheticTerrain{
      "plane", dx, {{"slope_deg", 0}, {"length_m", 2 * length}, {"width_m", wide}}};
  s.release.paraboloid.reset();
  s.release.box = ReleaseBox{{0, length}, {-wide / 2, wide / 2}};
  s.release.thickness_m =
      Uncertain(std::ceil(length / dx * std::tan(GetParam() * degree) + 3) * dx);
  s.grains->friction_angle_deg = Uncertain(GetParam());
  s.basal.friction_coefficient = std::tan(GetParam() * degree);
  s.domain.periodic = {"y"};
  s.domain.walls = {WallSpec{{0, 0, 0}, {1, 0, 0}, 0, std::nullopt}};
  s.numerics.end_time_s = 12;
  Simulation simulation = build(s);
  std::vector<double> before_x(simulation.parts().state.n_particles()), before_z = before_x;
  double from = 0;
  const Finished f = run(std::move(simulation), {1, [&](double t, const SimulationParts& parts) {
                                                   if (t < 9 || from > 0) return;
                                                   const ParticleSet& now = parts.state.grains();
                                                   for (std::size_t i = 0; i < now.size(); ++i)
                                                     before_x[now.id[i]] = now.x[i],
                                                     before_z[now.id[i]] = now.z[i];
                                                   from = t;
                                                 }});
  const ParticleSet& p = f.simulation.parts().state.grains();
  std::vector<double> top(slices, 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto slice = static_cast<std::size_t>(std::max(0.0, p.x[i]) / dx);
    if (slice < top.size()) top[slice] = std::max(top[slice], p.z[i] + 0.5 * dx);
  }
  const double slope = slope_of_tops(top, dx);
  const std::string name = fmt::format("V9 drained pile, friction {} deg", GetParam());
  expect_within({name + ", slope", "deg", slope, GetParam(), slope - GetParam(), 2}, f);
  double x = 0, z = 0;  // of those that are still there
  for (std::size_t i = 0; i < p.size(); ++i) {
    x += (p.x[i] - before_x[p.id[i]]) / p.size();
    z += (p.z[i] - before_z[p.id[i]]) / p.size();
  }
  const double creep = std::hypot(x, z) / dx / (f.result.scalars.end_time_s - from);
  expect_within({name + ", creep of the centre", "dx/s", creep, 0, creep, 0.01}, f);
  expect_conserved(name, f);
}

/// Six layers without end on a rough bed: the steepest slope that stands is the friction angle.
Scenario endless_slope(double slope) {
  Scenario s = thin_sheet(6);
  s.terrain.synthetic->parameters["slope_deg"] = slope;
  s.grains->friction.reset();
  s.grains->friction_angle_deg = Uncertain(30);
  s.basal.friction_coefficient = 1;
  s.numerics.end_time_s = 15;
  return s;
}

TEST(EndlessSlope, StandsTwoDegreesBelowTheFrictionAngle) {
  double at_10 = 0;
  const Finished f = run(endless_slope(28), {10, [&](double t, const SimulationParts& p) {
                                               if (t > 9 && t < 14)
                                                 at_10 = mean_motion(p.state.grains()).speed;
                                             }});
  const std::string name = "V9 endless slope 28 deg, friction 30";
  expect_within({name, "mean speed dx/s at 10 s", at_10, 0, at_10, 0.01}, f);
  expect_conserved(name, f);
}

/// One friction at all rates: whatever the shear's profile, g (sin - mu cos) is left over for the
/// mean. With viscosity the shear is spread over the six layers; the bed, which holds the lowest
/// ones, gives them no more than that friction.
TEST(EndlessSlope, FlowsTwoDegreesAboveTheFrictionAngle) {
  const double sliding =
      15 * gravity_m_s2 * (std::sin(32 * degree) - std::tan(30 * degree) * std::cos(32 * degree));
  for (const double viscosity : {0.1, 0.05}) {
    Scenario s = endless_slope(32);
    s.numerics.artificial_viscosity = viscosity;
    const Finished f = run(s);
    const double speed = mean_motion(f.simulation.parts().state.grains()).speed;
    const std::string name =
        fmt::format("V9 endless slope 32 deg, friction 30, viscosity {}", viscosity);
    expect_within(relative(name, "mean speed m/s at 15 s", speed, sliding, 0.05), f);
    expect_conserved(name, f);
  }
}

}  // namespace
}  // namespace sturz::test
