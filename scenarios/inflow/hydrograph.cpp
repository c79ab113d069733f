// SPDX-License-Identifier: Apache-2.0
#include "scenarios/inflow/hydrograph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

double linear(const std::vector<double>& time, const std::vector<double>& value, double t,
              double outside) {
  if (t < time.front() || t > time.back()) return outside;
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  if (next == time.end()) return value.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return value[k - 1] + share * (value[k] - value[k - 1]);
}

}  // namespace

double Hydrograph::peak_m3_s() const {
  return *std::max_element(discharge_m3_s.begin(), discharge_m3_s.end());
}

double Hydrograph::total_m3() const { return HydrographVolume(*this).total_m3(); }

double Hydrograph::discharge(double t) const { return linear(time_s, discharge_m3_s, t, 0); }

double Hydrograph::solids(double t) const {
  if (solid_fraction.empty()) return std::numeric_limits<double>::quiet_NaN();
  return linear(time_s, solid_fraction, std::clamp(t, time_s.front(), time_s.back()), 0);
}

HydrographVolume::HydrographVolume(const Hydrograph& h) : hydrograph_(h), volume_{0} {
  for (std::size_t k = 1; k < h.time_s.size(); ++k)
    volume_.push_back(volume_.back() + 0.5 * (h.discharge_m3_s[k - 1] + h.discharge_m3_s[k]) *
                                           (h.time_s[k] - h.time_s[k - 1]));
}

double HydrographVolume::until(double t) const {
  const Hydrograph& h = hydrograph_;
  if (t <= h.time_s.front()) return 0;
  if (t >= h.time_s.back()) return volume_.back();
  const auto next = std::upper_bound(h.time_s.begin(), h.time_s.end(), t);
  const auto k = static_cast<std::size_t>(next - h.time_s.begin()) - 1;
  return volume_[k] + 0.5 * (h.discharge_m3_s[k] + h.discharge(t)) * (t - h.time_s[k]);
}

double HydrographVolume::time_of(double volume) const {
  const Hydrograph& h = hydrograph_;
  if (volume >= volume_.back()) {
    // The end of the flow, not of rows without any.
    const auto first = std::lower_bound(volume_.begin(), volume_.end(), volume_.back());
    return h.time_s[static_cast<std::size_t>(first - volume_.begin())];
  }
  const auto next = std::upper_bound(volume_.begin(), volume_.end(), std::max(0.0, volume));
  const auto k = static_cast<std::size_t>(next - volume_.begin()) - 1;
  const double rest = std::max(0.0, volume - volume_[k]), q = h.discharge_m3_s[k];
  const double rise = (h.discharge_m3_s[k + 1] - q) / (h.time_s[k + 1] - h.time_s[k]);
  // q t + rise t^2 / 2 = rest, without the difference of two large numbers.
  const double root = q + std::sqrt(std::max(0.0, q * q + 2 * rise * rest));
  return root > 0 ? std::min(h.time_s[k] + 2 * rest / root, h.time_s[k + 1]) : h.time_s[k];
}

}  // namespace sturz
