// SPDX-License-Identifier: Apache-2.0
#include "ensemble/risk/return_level.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double round_off = 1e-9;

double share(const ScenarioRate& s, std::size_t hits) {
  return static_cast<double>(hits) / static_cast<double>(s.n_members);
}

}  // namespace

double annual_rate(std::span<const ScenarioRate> scenarios, std::span<const std::size_t> hits) {
  expect(hits.size() == scenarios.size(), "each scenario has its number of hits");
  double rate = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i)
    rate += scenarios[i].frequency * share(scenarios[i], hits[i]);
  return rate;
}

double annual_rate_error(std::span<const ScenarioRate> scenarios,
                         std::span<const std::size_t> hits) {
  double variance = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const double f = scenarios[i].frequency, p = share(scenarios[i], hits[i]);
    variance += f * f * p * (1 - p) / static_cast<double>(scenarios[i].n_members);
  }
  return std::sqrt(variance);
}

bool reaches_rate(double rate, double wanted) { return rate >= wanted * (1 - round_off); }

std::vector<double> return_levels(std::span<const ScenarioRate> scenarios,
                                  std::vector<ScenarioPeak>& peaks,
                                  std::span<const double> periods) {
  std::sort(peaks.begin(), peaks.end(), [](const ScenarioPeak& a, const ScenarioPeak& b) {
    return a.value != b.value ? a.value > b.value : a.scenario < b.scenario;
  });
  std::vector<double> levels(periods.size(), 0.0);
  std::vector<std::size_t> hits(scenarios.size(), 0);
  std::size_t next = 0;  // shorter periods need larger rates, so they come last
  for (std::size_t k = 0; k < peaks.size() && next < periods.size(); ++k) {
    ++hits[peaks[k].scenario];
    if (k + 1 < peaks.size() && peaks[k + 1].value == peaks[k].value) continue;
    const double rate = annual_rate(scenarios, hits);
    for (; next < periods.size(); ++next) {
      const std::size_t period = periods.size() - 1 - next;
      if (!reaches_rate(rate, 1 / periods[period])) break;
      levels[period] = static_cast<double>(peaks[k].value);
    }
  }
  return levels;
}

}  // namespace sturz
