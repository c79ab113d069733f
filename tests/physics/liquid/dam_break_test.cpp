// SPDX-License-Identifier: Apache-2.0
// V4 and V5: a column of water that collapses onto a dry bed, in a slice.
#include "tests/physics/liquid/liquid_books.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz::test {
namespace {

/// A slice of `slice` particles, periodic across; the column stands against a wall at x = 0.
constexpr int slice = 4;

LiquidBox dam(double length, double height, int layers) {
  LiquidBox b;
  b.spacing = height / layers;
  b.n = {static_cast<int>(std::lround(length / b.spacing)), slice, layers};
  b.domain.y = {true, 0, slice * b.spacing, 0};
  b.domain.walls = {Wall{{0, 0, 0}, {1, 0, 0}}};
  b.settings.law = {0, 0.001, 1};
  b.settings.sound_speed = 20 * std::sqrt(gravity_m_s2 * height);  // 10 times the front's speed
  b.settings.least_sound_speed = 0.5 * b.settings.sound_speed;
  return b;
}

/// Thickness at the middles of columns `width` wide, each particle shared by the two nearest [m].
std::vector<double> thickness(const SimulationParts& parts, double width, std::size_t n) {
  const ParticleSet& p = parts.state.sets[0];
  const double dx = parts.facts.spacing_m, each = dx * dx / (width * slice);
  std::vector<double> h(n, 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double at = std::max(0.0, p.x[i] / width - 0.5), share = at - std::floor(at);
    const auto k = static_cast<std::size_t>(at);
    if (k + 1 >= n) continue;
    h[k] += (1 - share) * each;
    h[k + 1] += share * each;
  }
  return h;
}

/// V4 (Ritter 1892): h = (2 c0 - x/t)^2 / 9g, c0 = sqrt(g h0), of a reservoir without end.
/// \return L1 of h over that of Ritter's where 0.3 < x/(c0 t) < 1.5 and h > 2 dx
double ritter_error(const SimulationParts& parts, double dam_x, double h0) {
  const double c0 = std::sqrt(gravity_m_s2 * h0), t = parts.state.time;
  const double dx = parts.facts.spacing_m, width = 2 * dx;
  const std::vector<double> h = thickness(parts, width, 4096);
  double off = 0, all = 0;
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double x = (static_cast<double>(k) + 0.5) * width - dam_x;
    if (x < 0.3 * c0 * t || x > 1.5 * c0 * t) continue;
    const double expected = std::pow(2 * c0 - x / t, 2) / (9 * gravity_m_s2);
    if (expected < 2 * dx) continue;
    off += std::abs(h[k] - expected);
    all += expected;
  }
  return off / all;
}

/// After 6 sqrt(h0/g): Ritter has no vertical acceleration, which the start is made of. At 4 it is
/// told how far that goes.
TEST(LiquidDamBreak, FollowsRittersProfile) {
  constexpr double h0 = 1, length = 7;
  const double unit = std::sqrt(h0 / gravity_m_s2);
  std::vector<double> dx, error;
  for (const int layers : resolutions({8, 10, 12}, {16, 24})) {
    LiquidBox b = dam(length, h0, layers);
    b.half_width = 20;
    double early = 0;
    const Finished f =
        run(simulation_of(b, 6 * unit), {2 * unit, [&](double t, const SimulationParts& parts) {
                                           if (t > 3.9 * unit && t < 4.1 * unit)
                                             early = ritter_error(parts, length, h0);
                                         }});
    const std::string name = fmt::format("V4 liquid, layers {}", layers);
    const double off = ritter_error(f.simulation.parts(), length, h0);
    record({name + ", thickness at 4", "L1", early, 0, early}, f);
    expect_within({name + ", thickness", "L1", off, 0, off, 0.05}, f);
    expect_liquid_books(name, f, {1});
    dx.push_back(std::log(b.spacing)), error.push_back(std::log(off));
  }
  fmt::print("V4 liquid: observed order {:.2f}\n", slope_of(dx, error));
}

/// Dimensionless front over time, T = t sqrt(2g/a), Z = x/a.
struct Front {
  std::vector<double> time, z;

  /// T at which the front passes z, Z at T; linear between.
  double time_at(double at) const { return between(z, time, at); }
  double z_at(double at) const { return between(time, z, at); }

 private:
  static double between(const std::vector<double>& x, const std::vector<double>& y, double at) {
    for (std::size_t k = 1; k < x.size(); ++k)
      if (x[k - 1] <= at && at <= x[k])
        return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
    return std::numeric_limits<double>::quiet_NaN();
  }
};

/// Martin & Moyce (1952), a = 2.25 in, n^2 = 2.
const Front martin_moyce{{0.832, 1.219, 1.997, 2.547, 3.345, 4.034, 4.418, 5.091, 5.685, 6.306,
                          6.822, 7.439, 8.031, 8.633, 9.237},
                         {1.217, 1.474, 2.292, 2.995, 4.134, 4.944, 5.881, 6.980, 7.945, 8.966,
                          9.986, 10.963, 11.977, 13.005, 13.970}};
/// Koshizuka & Oka (1996).
const Front koshizuka_oka{{0, 0.381, 0.769, 1.153, 1.537, 1.935, 2.323, 2.719, 3.096},
                          {1.000, 1.111, 1.252, 1.505, 1.892, 2.241, 2.615, 3.003, 3.624}};

/// The column of both, a = 57.15 mm wide and twice as high, until the front is at Z = 10.5.
struct Collapse {
  Finished finished;
  Front front;
};
Collapse collapse(int across) {
  constexpr double a = 0.05715;
  LiquidBox b = dam(a, 2 * a, 2 * across);
  b.half_width = 20 * a;
  const double unit = std::sqrt(a / (2 * gravity_m_s2));  // seconds of one T
  Front front;
  Finished f = run(simulation_of(b, 7.4 * unit),
                   {0.05 * unit, [&](double t, const SimulationParts& parts) {
                      const ParticleSet& p = parts.state.sets[0];
                      const double tip = *std::max_element(p.x.begin(), p.x.end());
                      if (!front.time.empty() && t / unit <= front.time.back()) return;
                      front.time.push_back(t / unit);
                      front.z.push_back((tip + 0.5 * b.spacing) / a);
                    }});
  return {std::move(f), std::move(front)};
}

TEST(LiquidDamBreak, FrontIsThatOfTheExperiments) {
  for (const int across : resolutions({8, 12, 16}, {24})) {
    const Collapse c = collapse(across);
    const std::string name = fmt::format("liquid, {} across", across);
    std::vector<double> t, z;
    double late = 0, n = 0;
    for (std::size_t k = 0; k < martin_moyce.z.size(); ++k) {
      if (martin_moyce.z[k] < 4 || martin_moyce.z[k] > 10) continue;
      late += c.front.time_at(martin_moyce.z[k]) - martin_moyce.time[k], n += 1;
    }
    for (std::size_t k = 0; k < c.front.z.size(); ++k)
      if (c.front.z[k] > 4 && c.front.z[k] < 10)
        t.push_back(c.front.time[k]), z.push_back(c.front.z[k]);
    expect_within(
        relative("V5 " + name + ", speed of the front", "dZ/dT", slope_of(t, z), 1.69, 0.08),
        c.finished);
    expect_within({"V5 " + name + ", time offset", "T", late / n, 0, late / n, 0.35}, c.finished);
    double squares = 0;
    for (std::size_t k = 1; k < koshizuka_oka.time.size(); ++k)
      squares += std::pow(c.front.z_at(koshizuka_oka.time[k]) - koshizuka_oka.z[k], 2);
    const double rms = std::sqrt(squares / static_cast<double>(koshizuka_oka.time.size() - 1));
    expect_within({"V5b " + name + ", front", "RMS of Z", rms, 0, rms, 0.15}, c.finished);
    expect_liquid_books("V5 " + name, c.finished, {1});
  }
}

}  // namespace
}  // namespace sturz::test
