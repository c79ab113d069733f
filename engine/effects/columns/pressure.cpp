// SPDX-License-Identifier: Apache-2.0
// Cells, records and the sweep over neighbouring columns.
#include "engine/core/constants.hpp"
#include "engine/core/parallel.hpp"
#include "engine/effects/columns/shared.hpp"
#include "engine/effects/motion/wrapping.hpp"
#include "engine/particles/column_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

class CellPass final : public Pass {
 public:
  explicit CellPass(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column cells"; }
  std::string_view effect() const override { return EffectName::column_pressure; }
  Stage stage() const override { return Stage::neighbors; }

  void apply(State& s, double) override {
    MovingSet& p = s.sets[flow_->set];
    wrap_particles(s.domain, p);
    const auto& support_radius = p.scalar(fields::support_radius);
    if (flow_->frame)
      flow_->cells.build(p, s.domain, support_radius, *flow_->frame);
    else
      flow_->cells.build(p, s.domain, support_radius);
    for (auto& r : flow_->results) r.resize(flow_->cells.size());
    p.order_changed = false;
  }
  void entered(State& s, std::size_t set, std::size_t first) override {
    if (set == flow_->set) enter_columns(s, *flow_, s.sets[set], first);
  }
  std::size_t bytes() const override { return flow_->cells.bytes(); }

 private:
  std::shared_ptr<ColumnFlow> flow_;
};

/// Gathers the neighbour records and finds how hard the ground presses.
///
/// The reaction of the ground is g cos + v.kappa.v, spread along the path over the column's own
/// thickness or the smoothing length: a flow thicker than a corner's radius goes round it, and
/// still takes the whole momentum of the turn, q' = v.kappa.v - q |v|/l.
///
/// Pressure knows steep ground flatter than it is (ADR 0026): the mass between a wall and a floor
/// has one pressure, however little of it lies on the wall.
class GatherPass final : public Pass {
 public:
  explicit GatherPass(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column gather"; }
  std::string_view effect() const override { return EffectName::column_pressure; }
  Stage stage() const override { return Stage::gather; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[flow_->set];
    const GroundColumns ground(p);
    const double kick = kick_interval(s, dt);
    flow_->share.resize(p.size());
    flow_->lateral_gravity.resize(p.size());
    const Pressed pressed = ordered_reduce(
        p.size(), s.threads, Pressed{},
        [&](std::size_t begin, std::size_t end, Pressed& out) {
          press(p, ground, s.gravity, kick, begin, end, out);
        },
        [](Pressed& total, const Pressed& block) {
          total.off += block.off;
          total.least_share = std::min(total.least_share, block.least_share);
          total.highest = std::max(total.highest, block.highest);
        });
    p.ledger.detachment += pressed.off;
    flow_->steep = pressed.least_share < 1;
    flow_->highest_surface = std::max(flow_->highest_surface, pressed.highest);
    gather_records(p, s.threads);
  }

 private:
  struct Pressed {
    double off = 0;           // mass times time of columns that the ground lets go of [kg s]
    double least_share = 1;   // of a slope that pressure knows [-]
    double highest = -1e300;  // surface [m]
  };

  /// How hard the ground presses on columns [begin, end). Plain loops over plain arrays, so that
  /// the compiler puts four columns side by side.
  void press(ParticleSet& p, const GroundColumns& ground, double gravity, double kick,
             std::size_t begin, std::size_t end, Pressed& out) {
    const double *east = ground.component[0], *north = ground.component[1];
    const double *ee = ground.component[2], *en = ground.component[3], *nn = ground.component[4];
    const double *vx = p.vx.data(), *vy = p.vy.data(), *vz = p.vz.data(), *mass = p.mass.data();
    auto& before = p.components(fields::velocity_before);
    double *bx = before[0].data(), *by = before[1].data(), *bz = before[2].data();
    double* normal_gravity = p.scalar(fields::normal_gravity).data();
    double* centripetal = p.scalar(fields::centripetal_momentum).data();
    const double* support_radius = p.scalar(fields::support_radius).data();
    const double* thickness = p.scalar(fields::thickness).data();
    const double* height = p.z.data();
    double *shares = flow_->share.data(), *lateral = flow_->lateral_gravity.data();
    double airborne = 0, least = 1, highest = -1e300;
#pragma omp simd reduction(+ : airborne) reduction(min : least) reduction(max : highest)
    for (std::size_t i = begin; i < end; ++i) {
      const double x = vx[i], y = vy[i], z = vz[i];
      bx[i] = x, by[i] = y, bz[i] = z;
      const double upright = 1 / std::sqrt(1 + east[i] * east[i] + north[i] * north[i]);
      const double half_radius = 0.5 * support_radius[i], h = thickness[i];
      const double per_s = std::sqrt(x * x + y * y + z * z) / (h > half_radius ? h : half_radius);
      const double curvature = ee[i] * x * x + 2 * en[i] * x * y + nn[i] * y * y;
      const double turned = (centripetal[i] + kick * upright * curvature) / (1 + kick * per_s);
      centripetal[i] = turned;
      const double reaction = upright * gravity + per_s * turned;
      const double presses = reaction > 0 ? reaction : 0;
      normal_gravity[i] = presses;
      airborne += reaction < 0 ? mass[i] * kick : 0;
      const double slope2 = east[i] * east[i] + north[i] * north[i];
      const double share = known_share(slope2);
      const double level = 1 / std::sqrt(1 + share * share * slope2);
      const double flatter = reaction + gravity * (level - upright);
      shares[i] = share;
      lateral[i] = share < 1 ? (flatter > 0 ? flatter : 0) : presses;
      least = share < least ? share : least;
      const double top = height[i] + h * (1 + slope2) * upright;
      // On a wall the smoothed thickness is that of the floor below it.
      highest = share == 1 && top > highest ? top : highest;
    }
    out.off += airborne;
    out.least_share = std::min(out.least_share, least);
    out.highest = std::max(out.highest, highest);
  }

  void gather_records(MovingSet& p, int threads) {
    const auto& support_radius = p.scalar(fields::support_radius);
    const auto& thickness = p.scalar(fields::thickness);
    const auto &g = flow_->lateral_gravity, &share = flow_->share;
    const GroundColumns ground(p);
    const Field* k_field = p.find(fields::earth_pressure);
    const double* k = k_field ? k_field->component[0].data() : nullptr;
    const bool wet = flow_->settings.mixture.has_value();
    const double* solids = wet ? p.scalar(fields::solids_volume).data() : nullptr;
    const double* water = wet ? p.scalar(fields::water_volume).data() : nullptr;
    ColumnCells& cells = flow_->cells;
    ColumnRecord* records = cells.records();
    parallel_ranges(
        cells.size(), reduction_block, threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t c = begin; c < end; ++c) {
            const std::size_t i = cells.source(c);
            ColumnRecord& r = records[c];
            const double lateral = k ? known_earth_pressure(k[i], share[i]) * g[i] : g[i];
            const double known =
                share[i] < 1 ? thickness[i] / thinned(share[i], ground[i].slope2()) : thickness[i];
            r.volume = static_cast<float>(solids ? solids[i] + water[i]
                                                 : p.mass[i] / flow_->settings.density);
            r.vx = static_cast<float>(p.vx[i]);
            r.vy = static_cast<float>(p.vy[i]);
            r.vz = static_cast<float>(p.vz[i]);
            r.inverse_radius = static_cast<float>(1 / support_radius[i]);
            r.thickness = static_cast<float>(known);
            r.lateral = static_cast<float>(lateral);
            r.wave_speed = static_cast<float>(std::sqrt(lateral * known));
            r.share = static_cast<float>(share[i]);
          }
        });
  }

  std::shared_ptr<ColumnFlow> flow_;
};

struct Fastest {
  double wave = 0, approach2 = 0;
};

class SweepPass final : public Pass {
 public:
  explicit SweepPass(std::shared_ptr<ColumnFlow> flow) : flow_(std::move(flow)) {}
  std::string_view name() const override { return "column sweep"; }
  std::string_view effect() const override { return EffectName::column_pressure; }
  Stage stage() const override { return Stage::force; }

  void limits(const State&, std::vector<StepLimit>& out) const override {
    const double none = std::numeric_limits<double>::infinity();
    const double wave = flow_->fastest_wave, approach = flow_->fastest_approach;
    const double c = flow_->settings.courant;
    out.push_back({"thickness wave", wave > 0 ? c / wave : none});
    out.push_back({"approach", approach > 0 ? c / approach : none});
  }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[flow_->set];
    const ColumnView view = flow_->cells.view();
    const ColumnSweepOutput out = flow_->output();
    const ColumnConstants constants{flow_->settings.viscosity, flow_->steep};
    const Sweeps& loops = sweeps(flow_->settings.instruction_set);
    constexpr std::size_t groups_per_range = 16;
    parallel_ranges(flow_->cells.n_groups(), groups_per_range, s.threads,
                    [&](std::size_t begin, std::size_t end) {
                      loops.columns(view, constants, out, begin, end);
                    });
    accumulate(s, p, out, dt);
    if (!s.domain.walls.empty()) mirror_at_walls(s, p);
  }
  void warnings(const State& s, std::vector<std::string>& out) const override {
    warn_of_implausible(s, *flow_, out);
    warn_of_suction(s, *flow_, out);
  }
  std::size_t bytes() const override { return 7 * sizeof(float) * flow_->cells.size(); }

 private:
  /// Sums back to the columns: accelerations, thickness, support radius, earth pressure, limits.
  void accumulate(const State& s, MovingSet& p, const ColumnSweepOutput& out, double dt) {
    const ColumnCells& cells = flow_->cells;
    const DepthAveragedSettings& set = flow_->settings;
    auto& thickness = p.scalar(fields::thickness);
    auto& support_radius = p.scalar(fields::support_radius);
    const auto &g = flow_->lateral_gravity, &share = flow_->share;
    const GroundColumns ground(p);
    Field* k_field = p.find(fields::earth_pressure);
    double* k = k_field ? k_field->component[0].data() : nullptr;
    const double first = set.radius_per_spacing * set.spacing;
    const bool walls = !s.domain.walls.empty();
    if (set.mixture) flow_->strain_rate.resize(p.size());
    double* strain_rate = set.mixture ? flow_->strain_rate.data() : nullptr;
    const bool settles = s.n_steps < flow_->settle_until;
    double* area_share = settles ? p.scalar(fields::area_share).data() : nullptr;
    const Fastest fastest = ordered_reduce(
        cells.size(), s.threads, Fastest{},
        [&](std::size_t begin, std::size_t end, Fastest& most) {
          for (std::size_t c = begin; c < end; ++c) {
            if (cells.is_image(c)) continue;
            const std::size_t i = cells.source(c);
            p.ax[i] = out.ax[c], p.ay[i] = out.ay[c], p.az[i] = out.az[c];
            const bool settling = settles && p.id[i] >= flow_->settle_from;
            const double released = settling ? area_of(p, ground, i) : 0;
            const double whole =
                walls ? flow_->walls.thickness_factor(s.domain, s.time, {p.x[i], p.y[i], p.z[i]},
                                                      support_radius[i])
                      : 1;
            const double known = whole * out.thickness[c];
            const bool steep = share[i] < 1;
            thickness[i] = steep ? known * thinned(share[i], ground[i].slope2()) : known;
            if (strain_rate) strain_rate[i] = double(out.divergence[c]) / out.thickness[c];
            if (k)
              k[i] = strained(s.domain, p, i, k[i], out.divergence[c] / known * dt, thickness[i]);
            const double per_h = 2 / support_radius[i];
            const double wave2 =
                (k ? known_earth_pressure(k[i], share[i]) : 1.0) * g[i] * known * per_h * per_h;
            most.wave = std::max(most.wave, wave2);
            most.approach2 = std::max(most.approach2, out.approach[c] * per_h * per_h);
            support_radius[i] = adapted(support_radius[i], whole * out.density[c], first);
            if (settling) area_share[i] *= released / area_of(p, ground, i);
          }
        },
        [](Fastest& total, const Fastest& block) {
          total.wave = std::max(total.wave, block.wave);
          total.approach2 = std::max(total.approach2, block.approach2);
        });
    flow_->fastest_wave = std::sqrt(fastest.wave);
    flow_->fastest_approach = std::sqrt(fastest.approach2);
  }

  void mirror_at_walls(const State& s, MovingSet& p) const {
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const ColumnAtWall column = flow_->at_wall(p, i);
        Vec3 a(p.ax[i], p.ay[i], p.az[i]);
        for (const Wall& wall : s.domain.walls)
          if (s.time < wall.remove_at_s) a += flow_->walls.pressure(s.domain, s.time, wall, column);
        p.ax[i] = a.x(), p.ay[i] = a.y(), p.az[i] = a.z();
      }
    });
  }

  double area_of(ParticleSet& p, const GroundColumns& ground, std::size_t i) const {
    return column_area(p.scalar(fields::support_radius)[i], ground[i].normal().z(),
                       p.mass[i] / flow_->settings.density, p.scalar(fields::thickness)[i]);
  }

  /// Follows the mean distance of columns, by at most a tenth a step.
  double adapted(double support_radius, double density, double first) const {
    const DepthAveragedSettings& set = flow_->settings;
    const double wanted = set.radius_per_spacing / std::sqrt(density);
    const double next = std::clamp(wanted, 0.9 * support_radius, 1.1 * support_radius);
    return std::clamp(next, set.least_radius * first, set.most_radius * first);
  }

  double strained(const Domain& domain, const ParticleSet& p, std::size_t i, double k,
                  double strain, double thickness) const {
    const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    if (v2 < 1e-6 * standard_gravity * thickness) return k;  // at rest K stays as it came
    const EarthPressure e = flow_->earth_pressure_of(domain, p, i);
    return e.strained(k, strain, flow_->settings.earth_pressure_stiffness);
  }

  std::shared_ptr<ColumnFlow> flow_;
};

}  // namespace

void add_column_pressure(Step& step, const std::shared_ptr<ColumnFlow>& flow) {
  step.add(std::make_unique<CellPass>(flow));
  step.add(std::make_unique<GatherPass>(flow));
  step.add(std::make_unique<SweepPass>(flow));
}

}  // namespace sturz
