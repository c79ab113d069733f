// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/colours.hpp"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sturz {
namespace {

using Lab = Eigen::Vector3d;

double to_linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double to_srgb(double l) {
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

/// Linear sRGB to cone response, and cube roots of it to Oklab; Ottosson (2020), "A perceptual
/// color space for image processing".
const Eigen::Matrix3d& cones() {
  static const Eigen::Matrix3d m{{0.4122214708, 0.5363325363, 0.0514459929},
                                 {0.2119034982, 0.6806995451, 0.1073969566},
                                 {0.0883024619, 0.2817188376, 0.6299787005}};
  return m;
}
const Eigen::Matrix3d& opponents() {
  static const Eigen::Matrix3d m{{0.2104542553, 0.7936177850, -0.0040720468},
                                 {1.9779984951, -2.4285922050, 0.4505937099},
                                 {0.0259040371, 0.7827717662, -0.8086757660}};
  return m;
}

Lab to_lab(Rgb c) {
  const Lab linear(to_linear(c.r / 255.0), to_linear(c.g / 255.0), to_linear(c.b / 255.0));
  Lab response = cones() * linear;
  for (double& v : response) v = std::cbrt(v);
  return opponents() * response;
}

Rgb from_lab(const Lab& lab) {
  static const Eigen::Matrix3d from_opponents = opponents().inverse();
  static const Eigen::Matrix3d from_cones = cones().inverse();
  Lab response = from_opponents * lab;
  for (double& v : response) v = v * v * v;
  const Lab linear = from_cones * response;
  const auto byte = [](double l) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(to_srgb(l), 0.0, 1.0)));
  };
  return {byte(linear[0]), byte(linear[1]), byte(linear[2])};
}

std::span<const Rgb> anchors(Ramp ramp) {
  static constexpr Rgb hazard[] = {{255, 238, 166}, {253, 190, 75}, {240, 125, 45},
                                   {206, 56, 62},   {134, 28, 88},  {52, 10, 70}};
  static constexpr Rgb magnitude[] = {{222, 243, 205}, {138, 211, 188}, {58, 160, 178},
                                      {38, 108, 162},  {41, 60, 132},   {26, 20, 70}};
  static constexpr Rgb arrival[] = {{48, 16, 92}, {104, 62, 152}, {156, 122, 196}, {222, 208, 240}};
  static constexpr Rgb deposit[] = {
      {247, 233, 200}, {219, 184, 122}, {176, 126, 66}, {122, 76, 40}, {62, 34, 24}};
  static constexpr Rgb neutral[] = {{226, 232, 236}, {146, 164, 178}, {72, 94, 114}, {24, 36, 50}};
  switch (ramp) {
    case Ramp::hazard:
      return hazard;
    case Ramp::magnitude:
      return magnitude;
    case Ramp::arrival:
      return arrival;
    case Ramp::deposit:
      return deposit;
    case Ramp::neutral:
      break;
  }
  return neutral;
}

}  // namespace

std::vector<Rgb> ramp_colours(Ramp ramp, int n) {
  const auto stops = anchors(ramp);
  std::vector<Rgb> colours;
  for (int i = 0; i < n; ++i) {
    const double at = n == 1 ? 0.5 : static_cast<double>(i) / (n - 1);
    const double place = at * static_cast<double>(stops.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double t = place - static_cast<double>(k);
    const Lab mixed = (1 - t) * to_lab(stops[k]) + t * to_lab(stops[k + 1]);
    colours.push_back(from_lab(mixed));
  }
  return colours;
}

double lightness(Rgb colour) { return to_lab(colour)[0]; }

std::string hex_text(Rgb c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

}  // namespace sturz
