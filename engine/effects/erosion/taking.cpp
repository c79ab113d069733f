// SPDX-License-Identifier: Apache-2.0
// What columns take of the cells below them.
#include "engine/core/parallel.hpp"
#include "engine/effects/erosion/effect.hpp"
#include "engine/effects/erosion/shared.hpp"
#include "engine/effects/fields.hpp"
#include "engine/terrain/terrain.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double most_growth = 0.6931471805599453;  ///< of a column's mass in one step: it doubles
constexpr double widest = 8;                        ///< side of a column's square [cells]

/// The square of a column over the cells of the bed.
struct Footprint {
  double west, east, north, south;  ///< in columns and rows of the grid

  Footprint(const Appetite& a, const Grid& g) {
    const double half = 0.5 * a.side / g.cell_m;
    const double u = (a.x - g.west_m) / g.cell_m, v = (g.north_m - a.y) / g.cell_m;
    west = u - half, east = u + half, north = v - half, south = v + half;
  }
  /// Calls visit(cell, share of the column in it), row by row.
  template <class Visit>
  void visit(BedSupply& bed, Visit&& visit) const {
    const double per_area = 1 / ((east - west) * (south - north));
    for (int row = static_cast<int>(std::floor(north)); row < south; ++row) {
      const double high = std::min(south, row + 1.0) - std::max(north, static_cast<double>(row));
      for (int col = static_cast<int>(std::floor(west)); col < east; ++col) {
        const double wide = std::min(east, col + 1.0) - std::max(west, static_cast<double>(col));
        if (BedSupply::Cell* cell = bed.cell(row, col)) visit(*cell, high * wide * per_area);
      }
    }
  }
};

/// How deep a column would wear a cell [m].
struct Wish {
  double depth, room;
};
Wish wish(const Appetite& a, const BedSupply::Cell& cell, double share, double depth_per_mass) {
  const double room = std::min(cell.left, std::max(0.0, a.most_depth - cell.eroded));
  return {std::min(share * a.mass * depth_per_mass, room), room};
}

/// Finds what each column takes, takes it of the cells and lets half of it in.
class TakingPass final : public Pass {
 public:
  explicit TakingPass(std::shared_ptr<Erosion> erosion) : erosion_(std::move(erosion)) {}
  std::string_view name() const override { return "erosion"; }
  std::string_view effect() const override { return EffectName::erosion; }
  Stage stage() const override { return Stage::boundary; }

  void apply(State& s, double dt) override {
    MovingSet& p = s.sets[erosion_->set];
    appetites_.resize(p.size());
    erosion_->gained.resize(p.size());
    find_appetites(s, p, 0.5 * (s.previous_dt + dt));
    const double cell = erosion_->settings.cells.cell_m;
    const double mass_per_depth = erosion_->settings.bed_density * cell * cell;
    ask(*s.bed_supply, mass_per_depth);
    share_out(*s.bed_supply, s.threads, mass_per_depth);
    take();
    mix_half(s, p, *erosion_, false);
  }
  void entered(State& s, std::size_t set, std::size_t) override {
    if (set == erosion_->set) begin_lags(s.sets[set]);
  }
  void warnings(const State& s, std::vector<std::string>& out) const override {
    const MovingSet& p = s.sets[erosion_->set];
    const auto& entrained = p.scalar(fields::entrained_mass);
    double mass = 0, grown = 0, most = 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double growth = p.mass[i] / (p.mass[i] - entrained[i]);
      mass += p.mass[i], most = std::max(most, growth);
      if (growth > unresolved_growth) grown += p.mass[i];
    }
    if (grown > 0.01 * mass)
      out.push_back("erosion: " + std::to_string(std::lround(100 * grown / mass)) +
                    " % of the mass is in columns that grew by more than " +
                    std::to_string(std::lround(unresolved_growth)) + " times (up to " +
                    std::to_string(std::lround(most)) +
                    "): few columns stand for it, outline and thickness are coarse there. Use a "
                    "finer numerics.spacing_m");
  }
  std::size_t bytes() const override {
    return appetites_.capacity() * sizeof(Appetite) + erosion_->gained.capacity() * sizeof(double);
  }

 private:
  /// Arrays of the columns, looked up once.
  struct Columns {
    const double *thickness, *normal_gravity, *east, *north, *before[3];
    const double *solids = nullptr, *water = nullptr, *pressure = nullptr;  ///< of a mixture

    explicit Columns(const MovingSet& p)
        : thickness(p.scalar(fields::thickness).data()),
          normal_gravity(p.scalar(fields::normal_gravity).data()),
          east(p.components(fields::ground)[0].data()),
          north(p.components(fields::ground)[1].data()) {
      const auto& last = p.components(fields::velocity_before);
      for (int k = 0; k < 3; ++k) before[k] = last[static_cast<std::size_t>(k)].data();
      if (!p.has(fields::pore_pressure)) return;
      solids = p.scalar(fields::solids_volume).data();
      water = p.scalar(fields::water_volume).data();
      pressure = p.scalar(fields::pore_pressure).data();
    }
  };

  void find_appetites(const State& s, const MovingSet& p, double interval) {
    const Columns columns(p);
    parallel_ranges(p.size(), reduction_block, s.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        appetites_[i] = {};
        if (s.leaves(p, i)) continue;
        const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
        const double speed = v.norm();
        if (!(speed > 0)) continue;
        // Velocities belong to the middle of the last step; what is taken in this one, to its
        // start.
        const Vec3 last(columns.before[0][i], columns.before[1][i], columns.before[2][i]);
        const double gain = s.n_steps > 0 ? 0.5 * (speed - last.norm()) : 0;
        FlowOverBed flow;
        flow.thickness = columns.thickness[i];
        flow.speed = std::clamp(speed + gain, 0.0, 2 * speed);
        flow.density =
            columns.solids ? p.mass[i] / (columns.solids[i] + columns.water[i]) : p.bulk_density;
        flow.normal_gravity = columns.normal_gravity[i];
        flow.drive = -s.gravity * v.z() / speed;
        const double upright = upward_normal(columns.east[i], columns.north[i]).z();
        appetites_[i] = appetite(s, p, i, flow, upright, interval,
                                 columns.pressure ? columns.pressure + i : nullptr);
      }
    });
  }

  /// Of a column's mass over the interval by compound interest: the rate in proportion to it.
  double growth(FlowOverBed& flow, const BasalResistance& bed, double gravity,
                double interval) const {
    const ErosionSettings& set = erosion_->settings;
    flow.brake = bed.plastic(flow.normal_gravity, flow.thickness, flow.density, flow.speed) +
                 flow.speed * bed.rate(flow.speed, flow.thickness, flow.density, gravity);
    const double depth_rate = set.law.erosion_rate(flow, set.bed_density);
    return depth_rate > 0 ? set.bed_density / flow.density * depth_rate / flow.thickness * interval
                          : 0;
  }

  Appetite appetite(const State& s, const MovingSet& p, std::size_t i, FlowOverBed flow,
                    double upright, double interval, const double* pore_pressure) const {
    const ErosionSettings& set = erosion_->settings;
    Appetite a;
    double z = 0;
    a.x = p.x[i], a.y = p.y[i];
    s.domain.wrap(a.x, a.y, z);
    const int zone = set.zones.at(a.x, a.y);
    BasalResistance bed = set.bed[static_cast<std::size_t>(zone)];
    if (set.rasters.any()) bed = set.rasters.over(bed, zone, a.x, a.y);
    const double stress = flow.density * flow.normal_gravity * flow.thickness;
    if (pore_pressure && stress > 0)
      bed.pore_pressure_ratio = std::clamp(*pore_pressure / stress, 0.0, 1.0);
    const double first = growth(flow, bed, s.gravity, interval);
    if (!(first > 0)) return a;
    // The change of speed that was seen leaves out what mixing itself took of it.
    flow.speed *= 1 - 0.5 * std::min(first, most_growth);
    const double growth_now = growth(flow, bed, s.gravity, interval);
    a.mass = p.mass[i] * std::expm1(std::min(growth_now, most_growth));
    a.most_depth = set.law.most_depth(flow) / upright;
    const double side = std::sqrt(p.mass[i] / flow.density * upright / flow.thickness);
    const double cell = set.cells.cell_m;
    a.side = std::clamp(side, 1e-3 * cell, widest * cell);
    return a;
  }

  /// Serial and in storage order: the same bits at any number of threads.
  void ask(BedSupply& bed, double mass_per_depth) {
    asked_.clear();
    for (const Appetite& a : appetites_) {
      if (a.none()) continue;
      Footprint(a, bed.grid()).visit(bed, [&](BedSupply::Cell& cell, double share) {
        const Wish w = wish(a, cell, share, 1 / mass_per_depth);
        if (!(w.depth > 0)) return;
        if (cell.wanted == 0) asked_.push_back(&cell);
        cell.wanted += w.depth;
        cell.room = std::max(cell.room, w.room);
      });
    }
    for (BedSupply::Cell* cell : asked_) cell->given = std::min(1.0, cell->room / cell->wanted);
  }

  /// Every cell is open by now: looking changes nothing.
  void share_out(BedSupply& bed, int threads, double mass_per_depth) {
    parallel_ranges(
        appetites_.size(), reduction_block, threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const Appetite& a = appetites_[i];
            double depth = 0;
            if (!a.none())
              Footprint(a, bed.grid()).visit(bed, [&](const BedSupply::Cell& cell, double share) {
                depth += cell.given * wish(a, cell, share, 1 / mass_per_depth).depth;
              });
            erosion_->gained[i] = depth * mass_per_depth;
          }
        });
  }

  void take() {
    for (BedSupply::Cell* cell : asked_) {
      const double depth = cell->given < 1 ? cell->room : cell->wanted;
      cell->left -= depth;
      cell->eroded += depth;
      cell->wanted = cell->room = cell->given = 0;
    }
  }

  std::shared_ptr<Erosion> erosion_;
  std::vector<Appetite> appetites_;
  std::vector<BedSupply::Cell*> asked_;
};

}  // namespace

void begin_lags(MovingSet& p) {
  p.lag_x.resize(p.n_created(), 0);
  p.lag_y.resize(p.n_created(), 0);
}

void add_taking(Step& step, const std::shared_ptr<Erosion>& erosion) {
  step.add(std::make_unique<TakingPass>(erosion));
}

}  // namespace sturz
