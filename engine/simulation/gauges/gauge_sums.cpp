// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/gauges/gauge_sums.hpp"

namespace sturz {
namespace {

void keep_peak(double value, double time_s, GaugePeak& peak) {
  if (value > 0 && !(peak.value >= value)) peak = {value, time_s};
}

}  // namespace

void close_point(const std::vector<double>& time_s, double reached_m, PointSeries& p) {
  for (std::size_t i = 0; i < p.thickness_m.size(); ++i) {
    const double now = p.thickness_m[i], before = i > 0 ? p.thickness_m[i - 1] : 0;
    if (std::isnan(p.arrival_s) && now > reached_m)
      p.arrival_s = i == 0 ? time_s[0]
                           : time_s[i - 1] + (time_s[i] - time_s[i - 1]) * (reached_m - before) /
                                                 (now - before);
    keep_peak(now, time_s[i], p.thickness);
    keep_peak(p.speed_m_s[i], time_s[i], p.speed);
    keep_peak(p.momentum_flux_n_m[i], time_s[i], p.momentum_flux);
  }
  // What never reaches the limit has no peak either: it is the spread of particles beside it.
  if (std::isnan(p.arrival_s)) p.thickness = p.speed = p.momentum_flux = {};
}

void close_line(const std::vector<double>& time_s, LineSeries& line) {
  line.total_m3 = line.volume_m3.back();
  if (line.total_m3 < 0) {
    line.total_m3 = -line.total_m3;
    for (double& v : line.volume_m3) v = v == 0 ? 0 : -v;
  }
  line.discharge_m3_s.assign(time_s.size(), 0);
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    line.discharge_m3_s[i] =
        (line.volume_m3[i] - line.volume_m3[i - 1]) / (time_s[i] - time_s[i - 1]);
    keep_peak(line.discharge_m3_s[i], time_s[i], line.discharge);
  }
}

}  // namespace sturz
