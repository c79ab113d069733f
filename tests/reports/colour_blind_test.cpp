// SPDX-License-Identifier: Apache-2.0
// Colours as readers see them who lack one kind of cone: Machado, Oliveira & Fernandes (2009), "A
// physiologically-based model for simulation of color vision deficiency", severity 1, linear RGB.
#include "reports/figures/colours.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sturz {
namespace {

using Matrix = std::array<double, 9>;
struct Sight {
  const char* name;
  Matrix m;
};
constexpr Sight sights[] = {
    {"all cones", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
    {"protanopia",
     {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998}},
    {"deuteranopia",
     {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881}},
    {"tritanopia",
     {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900}}};

double to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double to_srgb(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

Rgb seen(Rgb c, const Matrix& m) {
  const std::array<double, 3> in{to_linear(c.r / 255.0), to_linear(c.g / 255.0),
                                 to_linear(c.b / 255.0)};
  const auto channel = [&](std::size_t row) {
    const double l = m[3 * row] * in[0] + m[3 * row + 1] * in[1] + m[3 * row + 2] * in[2];
    return static_cast<std::uint8_t>(std::lround(255 * to_srgb(std::clamp(l, 0.0, 1.0))));
  };
  return {channel(0), channel(1), channel(2)};
}

/// Lightness steps of Oklab between neighbours; about 0.02 can just be told apart.
double smallest_step(const std::vector<Rgb>& colours, const Matrix& m, bool& rises_or_falls) {
  double least = 1;
  rises_or_falls = true;
  const double whole = lightness(seen(colours.back(), m)) - lightness(seen(colours.front(), m));
  for (std::size_t i = 1; i < colours.size(); ++i) {
    const double step = lightness(seen(colours[i], m)) - lightness(seen(colours[i - 1], m));
    rises_or_falls = rises_or_falls && step * whole > 0;
    least = std::min(least, std::abs(step));
  }
  return least;
}

TEST(ColourBlind, EveryRampOrdersItsClassesForEverySight) {
  constexpr double told_apart = 0.05;
  for (const Ramp ramp :
       {Ramp::hazard, Ramp::magnitude, Ramp::arrival, Ramp::deposit, Ramp::neutral}) {
    const int classes = ramp == Ramp::arrival ? 9 : 7;  // as many as legends have
    for (const Sight& sight : sights) {
      bool ordered = false;
      EXPECT_GT(smallest_step(ramp_colours(ramp, classes), sight.m, ordered), told_apart)
          << sight.name << ", ramp " << static_cast<int>(ramp);
      EXPECT_TRUE(ordered) << sight.name << ", ramp " << static_cast<int>(ramp);
    }
  }
}

TEST(ColourBlind, TheSimulationTellsARampOfHuesAlone) {
  const std::vector<Rgb> green_to_red = {{0, 150, 0}, {120, 120, 0}, {200, 60, 0}};
  bool ordered = false;
  EXPECT_LT(smallest_step(green_to_red, sights[2].m, ordered), 0.05);
}

}  // namespace
}  // namespace sturz
