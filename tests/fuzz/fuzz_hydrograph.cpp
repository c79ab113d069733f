// SPDX-License-Identifier: Apache-2.0
// Any bytes as a hydrograph: a table or SetupError; what was accepted rises in time, holds no
// negative discharge, and its integral can be asked both ways.
#include "engine/core/error.hpp"
#include "io/site/flow/hydrograph_csv.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool good) {
  if (!good) std::abort();
}

void check(const sturz::Hydrograph& h) {
  const std::size_t n = h.time_s.size();
  require(n >= 2 && h.discharge_m3_s.size() == n);
  require(h.solid_fraction.empty() || h.solid_fraction.size() == n);
  for (std::size_t i = 0; i < n; ++i) {
    require(h.discharge_m3_s[i] >= 0);
    require(i == 0 || h.time_s[i] > h.time_s[i - 1]);
  }
  const sturz::HydrographVolume volume(h);
  require(volume.total_m3() > 0 && std::isfinite(volume.total_m3()));
  double last = h.time_s.front();
  for (int k = 0; k <= 32; ++k) {
    const double wanted = volume.total_m3() * k / 32, t = volume.time_of(wanted);
    require(t >= last && t <= h.time_s.back());
    require(std::abs(volume.until(t) - wanted) <= 1e-6 * volume.total_m3());
    last = t;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sturz::Hydrograph h;
  try {
    h = sturz::parse_hydrograph({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
  } catch (const sturz::SetupError&) {
    return 0;
  }
  check(h);
  return 0;
}
