// SPDX-License-Identifier: Apache-2.0
// Walls are mirrors to a liquid: what stands before one does what it does before its own image.
#include "engine/effects/fields.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sturz::test {
namespace {

constexpr double dx = 0.1;
constexpr std::size_t quarter_size = 160;  // 5 x 4 x 8

/// Particles of a lattice around the middle (x, y) of the ground, each a little aside, the same in
/// all four quadrants.
std::vector<Vec3> quarter(int nx, int ny, int nz) {
  std::vector<Vec3> at;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        const double a = 0.1 * std::sin(7 * i + 3 * j + 5 * k);
        at.emplace_back((i + 0.5 + a) * dx, (j + 0.5 - a) * dx, (k + 0.5 + 0.5 * a) * dx);
      }
  return at;
}

std::vector<Vec3> mirrored(const std::vector<Vec3>& at, bool in_x, bool in_y) {
  std::vector<Vec3> all;
  for (const double sx : {1.0, -1.0})
    for (const double sy : {1.0, -1.0}) {
      if ((sx < 0 && !in_x) || (sy < 0 && !in_y)) continue;
      for (const Vec3& p : at) all.emplace_back(sx * p.x(), sy * p.y(), p.z());
    }
  return all;
}

LiquidBox scene(std::vector<Vec3> at, std::vector<Wall> walls) {
  LiquidBox b;
  b.spacing = dx;
  b.at = std::move(at);
  b.top = 0.8;
  b.settings.sound_speed = 30;
  b.settings.law = {30, 2, 1};
  b.domain.walls = std::move(walls);
  b.half_width = 6;
  return b;
}

/// What the pair sweep says of every particle, by id.
struct Seen {
  std::vector<Vec3> push;     ///< acceleration [m/s^2]
  std::vector<double> e, xx;  ///< density change, deviator across the first wall [Pa]
  double strongest = 0;
};

/// One step with velocities, stresses and density gradients of their own, mirrored where the
/// particles are. Contact comes after the sweep and has no part in it.
/// \param turn  of the scene about z [rad]
Seen swept(const LiquidBox& b, double turn = 0) {
  using Eigen::Matrix3d;
  HandMade made = liquid_of(b);
  MovingSet& p = made.state.sets[0];
  const Matrix3d frame = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  auto& before = p.components(fields::velocity_before);
  auto& t = p.components(fields::stress);
  auto& gradient = p.components(fields::density_gradient);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto k = static_cast<double>(p.id[i] % quarter_size);
    const Vec3 at = frame.transpose() * Vec3(p.x[i], p.y[i], p.z[i]);
    const Matrix3d local = Vec3(at.x() < 0 ? -1 : 1, at.y() < 0 ? -1 : 1, 1).asDiagonal();
    const Matrix3d r = frame * local;
    const Vec3 v = r * Vec3(0.3 * std::sin(k), 0.2 * std::cos(3 * k), 0.2 * std::sin(5 * k));
    const Vec3 g = r * Vec3(0.01 * std::sin(2 * k), 0.02 * std::sin(7 * k), 0.01);
    Matrix3d shear;
    shear << 0, 20 * std::sin(k), 10, 20 * std::sin(k), 15, 30 * std::cos(k), 10, 30 * std::cos(k),
        -15;
    const Matrix3d turned = r * shear * r.transpose();
    p.vx[i] = v.x(), p.vy[i] = v.y(), p.vz[i] = v.z();
    for (int c = 0; c < 3; ++c) before[c][i] = v[c], gradient[c][i] = g[c];
    for (int c = 0; c < 3; ++c) t[c][i] += turned(c, c), t[3 + c][i] = turned(c, (c + 1) % 3);
  }
  made.step.apply(made.state, 2e-4);
  Seen out{std::vector<Vec3>(p.n_created()), std::vector<double>(p.n_created()),
           std::vector<double>(p.n_created()), 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::uint32_t id = p.id[i];
    out.push[id] = frame.transpose() * Vec3(p.ax[i], p.ay[i], p.az[i]);
    out.e[id] = p.scalar(fields::density_change)[i];
    const Vec3 n = frame.col(0);
    const double mean = (t[0][i] + t[1][i] + t[2][i]) / 3;
    out.xx[id] =
        n.x() * n.x() * t[0][i] + 2 * n.x() * n.y() * t[3][i] + n.y() * n.y() * t[1][i] - mean;
    out.strongest = std::max(out.strongest, out.push[id].norm());
  }
  return out;
}

void expect_alike(const Seen& a, const Seen& b) {
  ASSERT_GT(a.strongest, 20);
  for (std::size_t i = 0; i < a.push.size(); ++i) {
    EXPECT_LT((a.push[i] - b.push[i]).norm(), 1e-4 * a.strongest) << i;
    EXPECT_NEAR(a.e[i], b.e[i], 1e-7) << i;
    EXPECT_NEAR(a.xx[i], b.xx[i], 0.02) << i;
  }
}

const Wall facing_east{{0, 0, 0}, {1, 0, 0}}, facing_north{{0, 0, 0}, {0, 1, 0}};

TEST(LiquidWalls, AreMirrors) {
  const auto at = quarter(5, 4, 8);
  expect_alike(swept(scene(at, {facing_east})), swept(scene(mirrored(at, true, false), {})));
  expect_alike(swept(scene(at, {facing_north})), swept(scene(mirrored(at, false, true), {})));
}

TEST(LiquidWalls, TheirCornersAreMirrorsOfMirrors) {
  const auto at = quarter(5, 4, 8);
  expect_alike(swept(scene(at, {facing_east, facing_north})),
               swept(scene(mirrored(at, true, true), {})));
}

TEST(LiquidWalls, MayStandAskew) {
  const auto at = quarter(5, 4, 8);
  const double turn = 0.5, c = std::cos(turn), s = std::sin(turn);
  std::vector<Vec3> turned;
  for (const Vec3& p : at) turned.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  const std::vector<Wall> walls{Wall{{0, 0, 0}, {c, s, 0}}, Wall{{0, 0, 0}, {-s, c, 0}}};
  expect_alike(swept(scene(at, {facing_east, facing_north})), swept(scene(turned, walls), turn));
}

/// It has no pressure field to be mirrored: the wall's contact takes it as the ground's would.
TEST(LiquidWalls, ALoneParticleDoesNotBounceOffItsOwnImage) {
  for (const double c0 : {50.0, 100.0}) {
    LiquidBox b = scene({{0, 0, 5}}, {Wall{{0.6, 0, 0}, {-1, 0, 0}}});
    b.hydrostatic = false;
    b.velocity = {5, 0, 0};
    b.settings.sound_speed = c0;
    HandMade made = liquid_of(b);
    made.state.gravity = 0;
    while (made.state.time < 0.4) made.advance();
    EXPECT_LT(made.state.sets[0].vx[0], 0);
    EXPECT_GT(made.state.sets[0].vx[0], -0.4 * 5);
  }
}

/// A gate that goes is no mirror any more from that moment on: the column behind it starts to run.
TEST(LiquidWalls, DoNotMirrorOnceTheyAreGone) {
  Wall gate{{0.8, 0, 0}, {-1, 0, 0}};
  gate.remove_at_s = 0.2;
  LiquidBox b;
  b.n = {8, 4, 8};
  b.domain.y = {true, 0, 0.4, 0};
  b.domain.walls = {Wall{{0, 0, 0}, {1, 0, 0}}, gate};
  b.settings.sound_speed = 30;
  b.half_width = 6;
  HandMade made = liquid_of(b);
  const MovingSet& p = made.state.sets[0];
  while (made.state.time < 0.2) made.advance();
  EXPECT_LT(p.motion.max_speed, 0.02);
  EXPECT_LT(*std::max_element(p.x.begin(), p.x.end()), 0.8);
  made.advance();
  made.advance();
  // Nothing bursts: no faster than the pressure behind the gate drives its last row.
  const double driven = 2 * made.state.gravity * 0.8 / dx * (made.state.time - 0.2);
  EXPECT_LT(p.motion.max_speed, driven + 0.02);
  while (made.state.time < 0.6) made.advance();
  EXPECT_GT(*std::max_element(p.x.begin(), p.x.end()), 1.2);
  EXPECT_LT(std::abs(p.ledger.residual()), 0.01 * p.ledger.released_energy());
}

}  // namespace
}  // namespace sturz::test
