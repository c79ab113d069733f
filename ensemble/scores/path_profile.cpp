// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/path_profile.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sturz {
namespace {

template <class Value>
double rmse(const PathProfile& a, const PathProfile& b, Value value) {
  std::set<int> bands;
  for (const auto& [k, band] : a.bands()) bands.insert(k);
  for (const auto& [k, band] : b.bands()) bands.insert(k);
  const auto at = [&](const PathProfile& p, int k) {
    const auto found = p.bands().find(k);
    return found == p.bands().end() ? 0.0 : value(found->second);
  };
  double sum = 0;
  for (const int k : bands) {
    const double difference = at(a, k) - at(b, k);
    sum += difference * difference;
  }
  return bands.empty() ? nan_d : std::sqrt(sum / static_cast<double>(bands.size()));
}

}  // namespace

void PathProfile::add(double distance_m, double area_m2, double value) {
  CrossBand& band = bands_[static_cast<int>(std::floor(distance_m / step_m_))];
  band.area_m2 += area_m2;
  band.largest = std::max(band.largest, value);
}

void PathProfile::reach(double distance_m) { runout_m_ = std::fmax(runout_m_, distance_m); }

double width_rmse_m(const PathProfile& a, const PathProfile& b) {
  return rmse(a, b, [&](const CrossBand& band) { return band.area_m2 / a.step_m(); });
}

double largest_rmse(const PathProfile& a, const PathProfile& b) {
  return rmse(a, b, [](const CrossBand& band) { return band.largest; });
}

}  // namespace sturz
