// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/gauges/gauge_recorder.hpp"

#include "engine/effects/fields.hpp"
#include "engine/simulation/gauges/gauge_sums.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sturz {
namespace {

/// Bulk volume of a particle; of a mixture that of its grains and water.
class BulkVolume {
 public:
  explicit BulkVolume(const MovingSet& p)
      : mass_(p.mass.data()), per_kg_(p.filled_share / p.bulk_density) {
    if (const Field* solids = p.find(fields::solids_volume)) solids_ = solids->component[0].data();
    if (const Field* water = p.find(fields::water_volume)) water_ = water->component[0].data();
  }
  double operator()(std::size_t i) const {
    return solids_ && water_ ? solids_[i] + water_[i] : mass_[i] * per_kg_;
  }

 private:
  const double *mass_, *solids_ = nullptr, *water_ = nullptr;
  double per_kg_;
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Crossing {
  double share = 0;  ///< of the way
  bool to_left = false;
};

/// Of the way from a to b with the stretch from p to q; its ends belong to it.
std::optional<Crossing> crossing(const Vec2& a, const Vec2& b, const Vec2& p, const Vec2& q) {
  const Vec2 line = q - p;
  const double before = cross(line, a - p), after = cross(line, b - p);
  if ((before >= 0) == (after >= 0)) return std::nullopt;
  const double share = before / (before - after);
  const double along = (a + share * (b - a) - p).dot(line);
  if (along < 0 || along >= line.squaredNorm()) return std::nullopt;
  return Crossing{share, after >= 0};
}

}  // namespace

GaugeRecorder::GaugeRecorder(GaugeSettings settings, const State& s)
    : settings_(std::move(settings)), crossed_(settings_.lines.size()) {
  result_.interval_s = settings_.interval_s;
  for (const auto& point : settings_.points) {
    PointSeries& series = result_.points.emplace_back();
    series.name = point.name, series.at = point.at;
  }
  for (const auto& line : settings_.lines) {
    LineSeries& series = result_.lines.emplace_back();
    series.name = line.name, series.points = line.points;
  }
  last_s_ = s.time;
  remember(s);
  sample(s, s.time, 1);
}

/// New particles are where they entered: their first way begins there.
void GaugeRecorder::remember(const State& s) {
  if (first_of_set_.empty()) first_of_set_.assign(s.sets.size(), 0);
  std::size_t all = 0;
  for (const MovingSet& p : s.sets) all += p.n_created();
  if (last_x_.size() != all) {  // the numbers of later sets move up
    std::vector<double> x(all), y(all);
    std::size_t first = 0;
    for (std::size_t k = 0; k < s.sets.size(); ++k) {
      const MovingSet& p = s.sets[k];
      const std::size_t end = k + 1 < first_of_set_.size() ? first_of_set_[k + 1] : last_x_.size();
      const std::size_t known = last_x_.empty() ? 0 : end - first_of_set_[k];
      for (std::size_t id = 0; id < p.n_created(); ++id) {
        const bool old = id < known;
        x[first + id] = old ? last_x_[first_of_set_[k] + id] : p.start_x[id];
        y[first + id] = old ? last_y_[first_of_set_[k] + id] : p.start_y[id];
      }
      first += p.n_created();
    }
    first = 0;
    for (std::size_t k = 0; k < s.sets.size(); first += s.sets[k++].n_created())
      first_of_set_[k] = first;
    last_x_ = std::move(x), last_y_ = std::move(y);
  }
  for (std::size_t k = 0; k < s.sets.size(); ++k) {
    const MovingSet& p = s.sets[k];
    for (std::size_t i = 0; i < p.size(); ++i)
      last_x_[first_of_set_[k] + p.id[i]] = p.x[i], last_y_[first_of_set_[k] + p.id[i]] = p.y[i];
  }
}

void GaugeRecorder::count(std::size_t line, double volume, double time_s) {
  LineSeries& series = result_.lines[line];
  // Not fmin: NaN is what it is until the first.
  if (!(series.arrival_s <= time_s)) series.arrival_s = time_s;
  crossed_[line].push_back({volume, time_s});
}

void GaugeRecorder::follow_lines(const State& s, double since) {
  for (std::size_t k = 0; k < s.sets.size(); ++k) {
    const MovingSet& p = s.sets[k];
    const BulkVolume volume(p);
    const std::size_t first = first_of_set_[k];
    const std::size_t end = k + 1 < first_of_set_.size() ? first_of_set_[k + 1] : last_x_.size();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (first + p.id[i] >= end) continue;  // entered at the end of this step
      const Vec2 a(last_x_[first + p.id[i]], last_y_[first + p.id[i]]), b(p.x[i], p.y[i]);
      if (a == b) continue;
      for (std::size_t line = 0; line < settings_.lines.size(); ++line) {
        const auto& corners = settings_.lines[line].points;
        for (std::size_t c = 0; c + 1 < corners.size(); ++c)
          if (const auto met = crossing(a, b, corners[c], corners[c + 1]))
            count(line, met->to_left ? volume(i) : -volume(i), last_s_ + met->share * since);
      }
    }
  }
}

void GaugeRecorder::after_step(const State& s) {
  const double since = s.time - last_s_;
  if (!(since > 0)) return;
  if (!settings_.lines.empty()) follow_lines(s, since);
  for (;;) {
    const double next = settings_.interval_s * static_cast<double>(result_.time_s.size());
    if (next > s.time) break;
    sample(s, next, (next - last_s_) / since);
  }
  remember(s);
  last_s_ = s.time;
}

/// \param share of the way that the particles have come in the last step
void GaugeRecorder::sample(const State& s, double time_s, double share) {
  result_.time_s.push_back(time_s);
  if (settings_.points.empty()) return;
  std::vector<GaugeSums> sums(settings_.points.size());
  for (std::size_t k = 0; k < s.sets.size(); ++k) {
    const MovingSet& p = s.sets[k];
    const BulkVolume volume(p);
    const SpreadWidth width(p);
    const std::size_t first = first_of_set_[k];
    const std::size_t end = k + 1 < first_of_set_.size() ? first_of_set_[k + 1] : last_x_.size();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::size_t id = first + p.id[i];
      Vec2 at(p.x[i], p.y[i]);
      if (id < end && share < 1)
        at = Vec2(last_x_[id], last_y_[id]) + share * (at - Vec2(last_x_[id], last_y_[id]));
      for (std::size_t g = 0; g < sums.size(); ++g) {
        const double weight = width.weight(i, settings_.points[g].at - at);
        if (weight > 0) sums[g].add(weight, volume(i), p.mass[i], Vec3(p.vx[i], p.vy[i], p.vz[i]));
      }
    }
  }
  for (std::size_t g = 0; g < sums.size(); ++g) {
    PointSeries& series = result_.points[g];
    series.thickness_m.push_back(static_cast<float>(sums[g].volume));
    series.speed_m_s.push_back(static_cast<float>(sums[g].speed()));
    series.momentum_flux_n_m.push_back(static_cast<float>(sums[g].momentum_flux()));
  }
}

GaugeResult GaugeRecorder::finish(const State& s) {
  if (s.time > result_.time_s.back()) sample(s, s.time, 1);
  for (PointSeries& point : result_.points) close_point(result_.time_s, settings_.reached_m, point);
  for (std::size_t k = 0; k < crossed_.size(); ++k) {
    LineSeries& line = result_.lines[k];
    std::stable_sort(crossed_[k].begin(), crossed_[k].end(),
                     [](const Crossed& a, const Crossed& b) { return a.time_s < b.time_s; });
    line.volume_m3.assign(result_.time_s.size(), 0);
    double passed = 0;
    auto next = crossed_[k].begin();
    for (std::size_t i = 0; i < result_.time_s.size(); ++i) {
      const bool last = i + 1 == result_.time_s.size();
      for (; next != crossed_[k].end() && (last || next->time_s <= result_.time_s[i]); ++next)
        passed += next->volume;
      line.volume_m3[i] = passed;
    }
    close_line(result_.time_s, line);
  }
  return std::move(result_);
}

}  // namespace sturz
