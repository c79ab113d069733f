// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/steep_ground.hpp"

#include "engine/core/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace sturz::test {
namespace {

constexpr int n_cols = 120, n_rows = 80;
constexpr double cell_m = 10;

/// Numbers between 0 and 1 of one member.
class Dice {
 public:
  explicit Dice(std::uint64_t member) : member_(member) {}
  double operator()() {
    const RandomWords w = random_words(7, {static_cast<std::uint32_t>(member_), n_++, 0, 0});
    return unit_from(w[0]);
  }
  double between(double a, double b) { return a + (b - a) * (*this)(); }
  double log_between(double a, double b) { return a * std::pow(b / a, (*this)()); }
  bool often(double share) { return (*this)() < share; }

 private:
  std::uint64_t member_;
  std::uint32_t n_ = 0;
};

double pit(double x, double y, double x0, double y0, double radius, double depth) {
  const double r = std::hypot(x - x0, y - y0) / radius;
  return r < 1 ? -depth * (1 - r) : 0;  // a cone: its tip is a kink
}

double height(double x, double y) {
  const double slope = std::tan(50 * 0.017453292519943295);
  // Steep upper half, a terrace, then ground that rolls gently.
  double z = x < 500 ? slope * (500 - x) + 80 : x < 650 ? 80 : 80 - 0.12 * (x - 650);
  if (x < 300) z += 60;                                        // a cliff of 60 m
  z += 25 * std::abs(std::sin(y / 60)) * std::exp(-x / 900);   // sharp gullies between ridges
  if (x > 650) z += 12 * std::sin(x / 70) * std::cos(y / 90);  // saddles and hollows
  z += pit(x, y, 420, 300, 60, 50) + pit(x, y, 800, 450, 90, 40) + pit(x, y, 580, 520, 40, 60);
  if (std::abs(x - 720) < 12) z += 15;  // a wall-like sharp ridge
  return z;
}

void choose_source(Dice& dice, Scenario& s, SceneInputs& in) {
  auto release = std::make_shared<Raster<double>>(in.elevation->grid, 0.0);
  const double x0 = dice.between(80, 700), y0 = dice.between(120, 680);
  const double a = dice.between(25, 90), b = dice.between(25, 90), h = dice.log_between(0.3, 30);
  const Grid& g = release->grid;
  for (int r = 0; r < g.n_rows; ++r)
    for (int c = 0; c < g.n_cols; ++c) {
      const double u = (g.x_center(c) - x0) / a, v = (g.y_center(r) - y0) / b;
      release->at(r, c) = std::max(0.0, h * (1 - u * u - v * v));
    }
  in.release = release;
  in.pattern = ReleasePattern::thickness;
  s.release.surface = dice.often(0.5) ? ReleaseSurface::pre_failure : ReleaseSurface::bed;
  if (dice.often(0.2)) s.release.velocity_m_s = {dice.between(-20, 40), dice.between(-20, 20), 0};
}

void choose_bed(Dice& dice, Scenario& s) {
  s.basal.friction_coefficient = dice.often(0.1) ? 0.0 : dice.between(0.0, 1.2);
  s.basal.pore_pressure_ratio = dice.often(0.3) ? 0.0 : dice.between(0.0, 0.99);
  s.basal.cohesion_pa = dice.often(0.6) ? 0.0 : dice.log_between(10, 50000);
  if (dice.often(0.25)) s.basal.turbulent_coefficient_m_s2 = Uncertain(dice.log_between(50, 3000));
  if (dice.often(0.25)) s.basal.viscosity_pa_s = Uncertain(dice.log_between(0.1, 1e5));
  if (s.basal.viscosity_pa_s && dice.often(0.5))
    s.basal.yield_stress_pa = Uncertain(dice.log_between(1, 20000));
}

}  // namespace

Raster<double> steep_ground() {
  Raster<double> z(Grid{n_cols, n_rows, 0, n_rows * cell_m, cell_m, ""});
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) z.at(r, c) = height(z.grid.x_center(c), z.grid.y_center(r));
  return z;
}

HardMember hard_member(std::uint64_t number) {
  static const auto ground = std::make_shared<const Raster<double>>(steep_ground());
  Dice dice(number);
  HardMember m;
  Scenario& s = m.scenario;
  m.inputs.elevation = ground;
  m.inputs.hazard_grid = ground->grid;
  s.grains.emplace().solid_fraction = dice.between(0.3, 0.8);
  s.grains->friction_angle_deg = Uncertain(dice.between(5, 55));
  s.grains->earth_pressure =
      dice.often(0.3) ? LateralPressure::active_passive : LateralPressure::isotropic;
  s.formulation = Formulation::depth_averaged;
  s.terrain.nodata = dice.often(0.2) ? TerrainEdge::wall : TerrainEdge::outflow;
  choose_source(dice, s, m.inputs);
  choose_bed(dice, s);
  s.numerics.spacing_m = dice.log_between(2.5, 25);
  s.numerics.end_time_s = 90;
  return m;
}

int hard_members(int usual) {
  const char* asked = std::getenv("STURZ_HARD_MEMBERS");
  return asked ? std::max(1, std::atoi(asked)) : usual;
}

}  // namespace sturz::test
