// SPDX-License-Identifier: Apache-2.0
// V6: Poiseuille and Couette flow from rest (Morris et al. 1997) on a bed that holds the liquid. A
// film on a slope is half of a channel, its free surface the centre line.
#include "tests/physics/liquid/film_flow.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace sturz::test {
namespace {

/// Wave number of the n-th term of a film's series, times H.
double wave(int n) { return (n + 0.5) * std::numbers::pi; }

double decay(int n, double t) {
  const double k = wave(n) / FilmFlow::depth;
  return std::exp(-FilmFlow::viscosity * k * k * t);
}

/// From rest under a pull along the bed.
double poiseuille(double z, double t) {
  const double h = FilmFlow::depth, scale = FilmFlow::pull * h * h / FilmFlow::viscosity;
  double u = 0.5 * scale * z / h * (2 - z / h);
  for (int n = 0; n < 60; ++n)
    u -= 2 * scale / std::pow(wave(n), 3) * std::sin(wave(n) * z / h) * decay(n, t);
  return u;
}

/// From rest under a traction at the surface whose steady flow is `top` there.
double driven_from_above(double z, double t, double top) {
  const double h = FilmFlow::depth;
  double u = top * z / h;
  for (int n = 0; n < 400; ++n)
    u -= top * (n % 2 ? -2 : 2) / (wave(n) * wave(n)) * std::sin(wave(n) * z / h) * decay(n, t);
  return u;
}

/// Least-squares order over 5, 10 and 20 layers.
void expect_order(const std::string& name, const std::vector<double>& error) {
  std::vector<double> fineness, accuracy;
  for (std::size_t k = 0; k < error.size(); ++k) {
    fineness.push_back(static_cast<double>(k) * std::log(2));
    accuracy.push_back(-std::log(error[k]));
  }
  const double order = slope_of(fineness, accuracy);
  put({name + ", order", "over 5, 10, 20 layers", order, 1.5, std::max(0.0, 1.5 - order), 0});
}

TEST(ViscousFilm, FollowsTheSeriesOfPoiseuilleFlow) {
  EXPECT_NEAR(poiseuille(FilmFlow::depth, 0.0225), 2.2327e-6, 1e-10) << "of docs/physics.md V6";
  EXPECT_NEAR(poiseuille(FilmFlow::depth, 0.225), 1.1100e-5, 1e-9);
  const std::vector<double> times{0.0225, 0.045, 0.1125, 0.225, 0.45};
  std::vector<double> steady;
  for (const int layers : {5, 10, 20}) {
    FilmFlow film;
    film.layers = layers;
    HandMade made = liquid_of(film.box());
    for (const double time : times) {
      advance_to(made, time);
      const double t = velocity_time(made.state);
      const double error =
          film.profile_error(made.state.grains(), [t](double z) { return poiseuille(z, t); });
      const std::string name = fmt::format("V6 Poiseuille, {} layers, t = {} s", layers, time);
      put({name, "L2 of the profile", error, 0, error, layers == 20 ? 0.01 : reported_only});
      if (time == times.back()) steady.push_back(error);
    }
    const Ledger l = made.state.ledger();
    EXPECT_LT(std::abs(l.residual()), 0.01 * l.gravity_work) << layers;
    put({fmt::format("V6 Poiseuille, {} layers, numerical", layers), "work / released",
         l.numerical() / l.gravity_work, 0, std::abs(l.numerical()) / l.gravity_work, 0.02});
    EXPECT_EQ(l.friction, 0) << "what the bed takes is viscous";
  }
  expect_order("V6 Poiseuille", steady);
}

/// Pulls the particles of the uppermost layer, as wind would: mean shear stress `traction`.
class Wind final : public Pass {
 public:
  Wind(std::vector<std::uint8_t> by_id, double acceleration)
      : by_id_(std::move(by_id)), acceleration_(acceleration) {}
  std::string_view name() const override { return "wind"; }
  std::string_view effect() const override { return "wind"; }
  Stage stage() const override { return Stage::force; }
  void apply(State& s, double) override {
    MovingSet& p = s.grains();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (by_id_[p.id[i]]) p.ax[i] += static_cast<float>(acceleration_);
  }

 private:
  std::vector<std::uint8_t> by_id_;
  double acceleration_;
};

TEST(ViscousFilm, FollowsTheSeriesOfCouetteFlow) {
  const double top = 1.25e-5;
  std::vector<double> steady;
  for (const int layers : {5, 10, 20}) {
    FilmFlow film;
    film.layers = layers;
    film.level = true;
    HandMade made = liquid_of(film.box());
    const MovingSet& p = made.state.grains();
    std::vector<std::uint8_t> uppermost(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      uppermost[p.id[i]] = p.z[i] > FilmFlow::depth - film.spacing();
    const double traction = FilmFlow::density * FilmFlow::viscosity * top / FilmFlow::depth;
    made.step.add(
        std::make_unique<Wind>(uppermost, traction / (FilmFlow::density * film.spacing())));
    for (const double time : {0.0225, 0.1125, 0.45}) {
      advance_to(made, time);
      const double t = velocity_time(made.state);
      const double error =
          film.profile_error(p, [&](double z) { return driven_from_above(z, t, top); });
      put({fmt::format("V6 Couette, {} layers, t = {} s", layers, time), "L2 of the profile", error,
           0, error, layers == 20 ? 0.01 : reported_only});
      if (time == 0.45) steady.push_back(error);
    }
  }
  expect_order("V6 Couette", steady);
}

/// Fewer than about four layers do not resolve the shear beside the bed.
TEST(ViscousFilm, OfOneToThreeLayersHasTheSpeedOfItsDepth) {
  const double nusselt = 2.0 / 3 * FilmFlow::free_speed();
  for (const int layers : {1, 2, 3, 5}) {
    for (const LiquidBed bed : {LiquidBed::film, LiquidBed::no_slip}) {
      FilmFlow film;
      film.layers = layers;
      film.bed = bed;
      HandMade made = liquid_of(film.box());
      advance_to(made, 0.6);
      const MovingSet& p = made.state.grains();
      const bool is_film = bed == LiquidBed::film;
      const std::string name =
          fmt::format("V6 {}, {} layers", is_film ? "film" : "held film", layers);
      put(relative(name, "mean speed m/s", film.mean_speed(p), nusselt,
                   is_film ? 0.1 : reported_only));
      const Ledger l = made.state.ledger();
      EXPECT_LT(std::abs(l.residual()), 0.01 * l.gravity_work) << name;
    }
  }
}

TEST(ViscousFilm, OnABedThatSlipsFallsFreely) {
  FilmFlow film;
  film.layers = 5;
  film.bed = LiquidBed::slip;
  HandMade made = liquid_of(film.box());
  advance_to(made, 0.2);
  const double t = velocity_time(made.state);
  EXPECT_NEAR(film.mean_speed(made.state.grains()), FilmFlow::pull * t, 1e-3 * FilmFlow::pull * t);
  EXPECT_EQ(made.state.ledger().friction, 0);
}

}  // namespace
}  // namespace sturz::test
