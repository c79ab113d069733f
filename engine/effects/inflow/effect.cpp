// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/inflow/effect.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sturz {
namespace {

/// Of the longest first step: so much too early a release may start, rather than after a tiny step.
constexpr double early_share = 0.02;

class InflowPass final : public Pass {
 public:
  InflowPass(std::size_t set, InflowSettings settings)
      : set_(set), settings_(std::move(settings)) {}
  std::string_view name() const override { return "inflow"; }
  Stage stage() const override { return Stage::move; }

  /// Steps grow shorter towards the start of a release, and start it as a run starts.
  void limits(const State& s, std::vector<StepLimit>& out) const override {
    if (none_waits() || !settings_.columns[next_].arrival.released) return;
    const double left = settings_.columns[next_].time_s - s.time, start = settings_.start_dt_s;
    const double to_it = left <= start ? left : std::max(0.5 * left, 0.5 * start);
    // What is nearly there starts at the end of any short step.
    out.push_back({"start of a release", left <= early_share * start ? start : to_it});
  }

  void apply(State& s, double dt) override {
    if (none_waits()) return;
    MovingSet& p = s.sets[set_];
    const double now = s.time + dt, early = early_share * settings_.start_dt_s;
    const std::size_t before = next_;
    for (; !none_waits(); ++next_) {
      const TimedArrival& c = settings_.columns[next_];
      if (c.time_s > now + (c.arrival.released ? early : 0)) break;
      p.arrivals.push_back(c.arrival.released ? c.arrival : on_its_way(s, c, now - c.time_s));
    }
    p.to_come -= next_ - before;
  }

  /// What a member that was stopped never saw.
  void warnings(const State& s, std::vector<std::string>& out) const override {
    if (none_waits()) return;
    double volume = 0;
    for (std::size_t k = next_; k < settings_.columns.size(); ++k)
      volume += settings_.columns[k].arrival.mass / s.sets[set_].bulk_density;
    out.push_back((settings_.columns[next_].arrival.released ? "release: " : "inflow: ") +
                  std::to_string(std::llround(volume)) + " m3 were still to " +
                  (settings_.columns[next_].arrival.released ? "start" : "enter") +
                  " when the member was stopped: its results are those of the part before");
  }

  std::size_t bytes() const override { return settings_.columns.size() * sizeof(TimedArrival); }

 private:
  bool none_waits() const { return next_ == settings_.columns.size(); }

  /// Along the ground below it at its own speed, so that nothing of it is lost on entry.
  static Arrival on_its_way(const State& s, const TimedArrival& c, double since) {
    Arrival a = c.arrival;
    const double speed = a.velocity.norm();
    if (!(speed > 0)) return a;
    const Vec2 way = Vec2(a.velocity.x(), a.velocity.y()).normalized();
    const auto along = [&](double x, double y) {
      const CurvedSurface g = s.terrain.curved(x, y);
      const double rise = g.east * way.x() + g.north * way.y();
      return Vec3(speed / std::sqrt(1 + rise * rise) * Vec3(way.x(), way.y(), rise));
    };
    const Vec3 v = along(a.position.x(), a.position.y());
    const double x = a.position.x() + since * v.x(), y = a.position.y() + since * v.y();
    if (s.terrain.inside(x, y)) a.position.x() = x, a.position.y() = y;
    a.velocity = along(a.position.x(), a.position.y());
    return a;
  }

  std::size_t set_;
  InflowSettings settings_;
  std::size_t next_ = 0;  ///< of the columns that wait
};

}  // namespace

void add_inflow(Step& step, State& state, std::size_t set, InflowSettings settings) {
  expect(std::is_sorted(settings.columns.begin(), settings.columns.end(),
                        [](const auto& a, const auto& b) { return a.time_s < b.time_s; }),
         "columns enter in the order of their times");
  state.sets[set].to_come += settings.columns.size();
  step.add(std::make_unique<InflowPass>(set, std::move(settings)));
}

std::size_t waiting_column_bytes() { return sizeof(TimedArrival); }

}  // namespace sturz
