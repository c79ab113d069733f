// SPDX-License-Identifier: Apache-2.0
// Liquids with a yield stress on a slope: plug flow in closed form, and mud that stops.
#include "engine/laws/liquid_film.hpp"
#include "tests/physics/liquid/film_flow.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sturz::test {
namespace {

/// Steady film of a Herschel-Bulkley liquid whose bed bears more than its yield stress.
double plug_flow(const HerschelBulkley& law, double z) {
  const double over = FilmFlow::bed_stress() - law.yield_stress, power = 1 + 1 / law.index;
  const double sheared = FilmFlow::depth * over / FilmFlow::bed_stress();
  const double top = sheared / power * std::pow(over / law.consistency, 1 / law.index);
  return top * (1 - std::pow(std::max(0.0, 1 - z / sheared), power));
}

/// Mean speed of what lies higher than a height, and its scatter over that speed.
struct Plug {
  double mean = 0, scatter = 0;
};
Plug plug_of(const FilmFlow& film, const ParticleSet& p, double from) {
  Plug plug;
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto at = film.place(p, i);
    if (at.height < from) continue;
    n += 1, sum += at.speed, squares += at.speed * at.speed;
  }
  plug.mean = sum / n;
  plug.scatter = std::sqrt(std::max(0.0, squares / n - plug.mean * plug.mean)) / plug.mean;
  return plug;
}

TEST(YieldStressFilm, OfABinghamLiquidHasItsPlug) {
  std::vector<double> errors;
  for (const int layers : {5, 10, 20}) {
    FilmFlow film;
    film.layers = layers;
    film.law.yield_stress = 0.5 * FilmFlow::bed_stress();
    HandMade made = liquid_of(film.box());
    advance_to(made, 0.45);
    const MovingSet& p = made.state.grains();
    const double error = film.profile_error(p, [&](double z) { return plug_flow(film.law, z); });
    put({fmt::format("V6 Bingham film, {} layers", layers), "L2 of the profile", error, 0, error,
         layers == 20 ? 0.02 : reported_only});
    errors.push_back(error);
    if (layers < 20) continue;
    const Plug plug = plug_of(film, p, 0.6 * FilmFlow::depth);
    put(relative("V6 Bingham film, plug", "m/s", plug.mean, plug_flow(film.law, FilmFlow::depth),
                 0.02));
    EXPECT_LT(plug.scatter, 0.01);
  }
  EXPECT_LT(errors[2], errors[1]);
}

TEST(YieldStressFilm, OfAShearThinningLiquidFollowsItsProfile) {
  FilmFlow film;
  // Sheared at the bed at 0.05/s, as the Newtonian film is; at the plug it is more viscous by far,
  // and takes longer to become steady.
  film.law = {0.3 * FilmFlow::bed_stress(), 0, 0.6};
  film.law.consistency = 0.7 * FilmFlow::bed_stress() / std::pow(0.05, 0.6);
  film.sound_speed = 0.08;
  HandMade made = liquid_of(film.box());
  advance_to(made, 0.8);
  const double error =
      film.profile_error(made.state.grains(), [&](double z) { return plug_flow(film.law, z); });
  put({"V6 Herschel-Bulkley film, 20 layers", "L2 of the profile", error, 0, error, 0.02});
}

/// Mean speed of a film that starts with half the speed of a Newtonian one.
double speed_after(FilmFlow film, double time) {
  LiquidBox box = film.box();
  const double cosine = 1 / std::hypot(1, FilmFlow::slope), u = 0.5 * FilmFlow::free_speed();
  box.velocity = u * Vec3(cosine, 0, -FilmFlow::slope * cosine);
  HandMade made = liquid_of(box);
  advance_to(made, time);
  return film.mean_speed(made.state.grains());
}

TEST(YieldStressFilm, StopsWhereItsYieldStressBearsTheWeightAndFlowsWhereNot) {
  for (const int layers : {3, 8, 16}) {
    FilmFlow film;
    film.layers = layers;
    film.bed = layers == 3 ? LiquidBed::film : LiquidBed::no_slip;
    film.law.yield_stress = 1.2 * FilmFlow::bed_stress();
    // It stops at once and then rings as the elastic body that it is below its yield stress.
    const double stopped = speed_after(film, 0.8) / FilmFlow::free_speed();
    put({fmt::format("V6 mud that stops, {} layers", film.layers), "speed / free speed", stopped, 0,
         std::abs(stopped), 1e-3});
    film.law.yield_stress = 0.8 * FilmFlow::bed_stress();
    const LiquidFilm law{film.law};
    // The mean speed under which the bed bears the weight.
    double low = 0, high = FilmFlow::free_speed();
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      (law.bed_stress(middle, FilmFlow::depth) > FilmFlow::bed_stress() ? high : low) = middle;
    }
    put(relative(fmt::format("V6 mud that flows, {} layers", film.layers), "mean speed m/s",
                 speed_after(film, 0.6), low, 0.1));
  }
}

}  // namespace
}  // namespace sturz::test
