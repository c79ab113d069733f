// SPDX-License-Identifier: Apache-2.0
// What the thickness of one set is to the other: pressure, buoyancy, depth of the liquid.
#include "engine/core/parallel.hpp"
#include "engine/effects/phases/shared.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

constexpr std::size_t grains = 0, liquid = 1;

struct Fastest {
  double wave2 = 0, approach2 = 0;
};

/// Sweeps across the sets, then gives the records of each set its pressure in the mixture.
class AcrossPass final : public Pass {
 public:
  explicit AcrossPass(std::shared_ptr<TwoPhases> both) : both_(std::move(both)) {}
  std::string_view name() const override { return "sweep across phases"; }
  std::string_view effect() const override { return EffectName::column_pressure; }
  Stage stage() const override { return Stage::gather; }

  void apply(State& s, double) override {
    Fastest fastest;
    for (std::size_t set : {grains, liquid}) sweep(s, set);
    for (std::size_t set : {grains, liquid}) {
      const Fastest found = accumulate(s, set);
      fastest.wave2 = std::max(fastest.wave2, found.wave2);
      fastest.approach2 = std::max(fastest.approach2, found.approach2);
    }
    both_->fastest_wave = std::sqrt(fastest.wave2);
    both_->fastest_approach = std::sqrt(fastest.approach2);
    press_grains(s);
    deepen_liquid(s);
  }
  std::size_t bytes() const override {
    std::size_t total = 0;
    for (const Across& a : both_->across)
      total += a.groups.capacity() * sizeof(ColumnGroup) + a.runs.capacity() * sizeof(ColumnRun) +
               a.results.size() * a.results[0].capacity() * sizeof(float) +
               6 * a.thickness.capacity() * sizeof(double);
    return total;
  }

 private:
  void sweep(const State& s, std::size_t set) {
    ColumnFlow &mine = *both_->flow[set], &theirs = *both_->flow[1 - set];
    Across& a = both_->across[set];
    theirs.cells.list_across(mine.cells, s.sets[set], s.sets[set].scalar(fields::support_radius),
                             a.groups, a.runs);
    for (auto& r : a.results) r.resize(mine.cells.size());
    const ColumnView own = mine.cells.view();
    const AcrossView view{own.records, theirs.cells.view().records, a.groups.data(), a.runs.data(),
                          own.unit_m};
    const AcrossOutput out{a.results[0].data(), a.results[1].data(), a.results[2].data(),
                           a.results[3].data(), a.results[4].data()};
    const bool steep = mine.steep || theirs.steep;
    const Sweeps& loops = sweeps(mine.settings.instruction_set);
    constexpr std::size_t groups_per_range = 16;
    parallel_ranges(
        a.groups.size(), groups_per_range, s.threads,
        [&](std::size_t begin, std::size_t end) { loops.across(view, steep, out, begin, end); });
  }

  Fastest accumulate(State& s, std::size_t set) {
    MovingSet& p = s.sets[set];
    ColumnFlow& flow = *both_->flow[set];
    Across& a = both_->across[set];
    for (auto* v : {&a.thickness, &a.gravity, &a.wave2, &a.ax, &a.ay, &a.az}) v->resize(p.size());
    const auto& thickness = p.scalar(fields::thickness);
    const auto& support_radius = p.scalar(fields::support_radius);
    const GroundColumns ground(p);
    const double factor = set == grains ? both_->settings.drag.density_ratio() : 1;
    const bool walls = !s.domain.walls.empty();
    return ordered_reduce(
        flow.cells.size(), s.threads, Fastest{},
        [&](std::size_t begin, std::size_t end, Fastest& most) {
          for (std::size_t c = begin; c < end; ++c) {
            if (flow.cells.is_image(c)) continue;
            const std::size_t i = flow.cells.source(c);
            const double whole =
                walls ? flow.walls.thickness_factor(s.domain, s.time, {p.x[i], p.y[i], p.z[i]},
                                                    support_radius[i])
                      : 1;
            const double known = thickness[i] / thinned(flow.share[i], ground[i].slope2());
            const double g = flow.lateral_gravity[i], per_h = 2 / support_radius[i];
            a.thickness[i] = whole * a.results[0][c];
            a.gravity[i] = g;
            a.wave2[i] = g * (known + a.thickness[i]);
            a.ax[i] = factor * a.results[1][c];
            a.ay[i] = factor * a.results[2][c];
            a.az[i] = factor * a.results[3][c];
            most.wave2 = std::max(most.wave2, a.wave2[i] * per_h * per_h);
            most.approach2 = std::max(most.approach2, a.results[4][c] * per_h * per_h);
          }
        },
        [](Fastest& total, const Fastest& block) {
          total.wave2 = std::max(total.wave2, block.wave2);
          total.approach2 = std::max(total.approach2, block.approach2);
        });
  }

  /// The weight that liquid does not carry presses grains apart over the whole depth, and on the
  /// bed; what liquid carries comes to them as the gradient of its thickness.
  void press_grains(State& s) {
    MovingSet& p = s.sets[grains];
    ColumnFlow& flow = *both_->flow[grains];
    const Across& a = both_->across[grains];
    const GroundColumns ground(p);
    const auto& thickness = p.scalar(fields::thickness);
    auto& normal_gravity = p.scalar(fields::normal_gravity);
    const double ratio = both_->settings.drag.density_ratio();
    const double densest = both_->settings.densest_fraction;
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const double known = thickness[i] / thinned(flow.share[i], ground[i].slope2());
        const double liquid_share = known > 0 ? a.thickness[i] / known : 0;
        const double filled = std::min(1.0, liquid_share * densest / (1 - densest));
        flow.lateral_gravity[i] *= 1 + (1 - ratio) * liquid_share;
        normal_gravity[i] *= 1 - ratio * filled;
      }
    });
    renew_records(s, grains);
  }

  void deepen_liquid(State& s) {
    MovingSet& p = s.sets[liquid];
    ColumnFlow& flow = *both_->flow[liquid];
    const Across& a = both_->across[liquid];
    const GroundColumns ground(p);
    const auto& thickness = p.scalar(fields::thickness);
    flow.bed_thickness.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      flow.bed_thickness[i] =
          thickness[i] + a.thickness[i] * thinned(flow.share[i], ground[i].slope2());
    renew_records(s, liquid);
  }

  void renew_records(const State& s, std::size_t set) {
    ColumnFlow& flow = *both_->flow[set];
    const Across& a = both_->across[set];
    ColumnRecord* records = flow.cells.records();
    parallel_ranges(flow.cells.size(), reduction_block, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t c = begin; c < end; ++c) {
                        const std::size_t i = flow.cells.source(c);
                        records[c].lateral = static_cast<float>(flow.lateral_gravity[i]);
                        records[c].wave_speed = static_cast<float>(std::sqrt(a.wave2[i]));
                      }
                    });
  }

  std::shared_ptr<TwoPhases> both_;
};

/// Adds the pressure of the other set, its mirror images at walls too.
class AddPass final : public Pass {
 public:
  explicit AddPass(std::shared_ptr<TwoPhases> both) : both_(std::move(both)) {}
  std::string_view name() const override { return "pressure across phases"; }
  std::string_view effect() const override { return EffectName::column_pressure; }
  Stage stage() const override { return Stage::force; }

  void limits(const State&, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const double wave = both_->fastest_wave, approach = both_->fastest_approach;
    const double c = both_->settings.grains.courant;
    out.push_back({"thickness wave", wave > 0 ? c / wave : none});
    out.push_back({"approach", approach > 0 ? c / approach : none});
  }

  void apply(State& s, double) override {
    for (std::size_t set : {grains, liquid}) {
      MovingSet& p = s.sets[set];
      const Across& a = both_->across[set];
      parallel_ranges(p.size(), reduction_block, s.threads,
                      [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i) {
                          p.ax[i] += static_cast<float>(a.ax[i]);
                          p.ay[i] += static_cast<float>(a.ay[i]);
                          p.az[i] += static_cast<float>(a.az[i]);
                        }
                      });
      if (!s.domain.walls.empty()) mirror_at_walls(s, set);
    }
  }

 private:
  void mirror_at_walls(State& s, std::size_t set) const {
    MovingSet& p = s.sets[set];
    const ColumnFlow& flow = *both_->flow[set];
    const Across& a = both_->across[set];
    const double factor = set == grains ? both_->settings.drag.density_ratio() : 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
      ColumnAtWall column = flow.at_wall(p, i);
      column.thickness = a.thickness[i], column.lateral = factor * a.gravity[i];
      for (const Wall& wall : s.domain.walls) {
        if (s.time >= wall.remove_at_s) continue;
        const Vec3 push = flow.walls.pressure(s.domain, s.time, wall, column);
        p.ax[i] += static_cast<float>(push.x());
        p.ay[i] += static_cast<float>(push.y());
        p.az[i] += static_cast<float>(push.z());
      }
    }
  }

  std::shared_ptr<TwoPhases> both_;
};

}  // namespace

void add_phase_pressure(Step& step, const std::shared_ptr<TwoPhases>& both) {
  step.add(std::make_unique<AcrossPass>(both));
  step.add(std::make_unique<AddPass>(both));
}

}  // namespace sturz
