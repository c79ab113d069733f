// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/mixture.hpp"

#include "engine/core/sum.hpp"
#include "engine/effects/columns/braking.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Change of pressure over weight that one part of a step may bring, and parts at most.
constexpr double largest_change = 0.05;
constexpr int most_parts = 16;
/// Change of the solid fraction in one part.
constexpr double most_dilation = 0.02;
/// Films without weight must not divide by it.
constexpr double least_stress = 1e-12;

double pressure_at_release(const MixtureSettings& settings, double stress, double hydrostatic) {
  return settings.pressure_ratio < 0 ? hydrostatic : settings.pressure_ratio * stress;
}

}  // namespace

void add_mixture(State& state, std::size_t set, const MixtureSettings& settings) {
  MovingSet& p = state.sets[set];
  for (const FieldKey* key :
       {&fields::solids_volume, &fields::water_volume, &fields::solid_fraction,
        &fields::excess_pressure, &fields::pore_pressure, &fields::pore_gravity})
    p.add(*key);
  enter_mixture(p, settings, 0);
}

void enter_mixture(MovingSet& p, const MixtureSettings& settings, std::size_t first) {
  auto& solids = p.scalar(fields::solids_volume);
  auto& water = p.scalar(fields::water_volume);
  auto& fraction = p.scalar(fields::solid_fraction);
  const double m = settings.solid_fraction;
  Sum grains, fluid;
  for (std::size_t i = first; i < p.size(); ++i) {
    const double volume = p.mass[i] / settings.law.density(m);
    solids[i] = m * volume, water[i] = (1 - m) * volume, fraction[i] = m;
    grains.add(solids[i]), fluid.add(water[i]);
  }
  p.ledger.released_solids += grains.value();
  p.ledger.released_water += fluid.value();
}

void start_pressure(ParticleSet& p, const MixtureSettings& settings, std::size_t i) {
  const double depth = p.scalar(fields::normal_gravity)[i] * p.scalar(fields::thickness)[i];
  const double volume = p.scalar(fields::solids_volume)[i] + p.scalar(fields::water_volume)[i];
  p.scalar(fields::pore_pressure)[i] =
      pressure_at_release(settings, p.mass[i] / volume * depth, settings.law.fluid_density * depth);
}

ColumnWater::ColumnWater(double solid_share, double m, double whole)
    : share(solid_share), thickness(whole * solid_share / m), level(whole) {
  if (m >= share) {
    film = whole - thickness;
  } else {
    saturation = m * (1 - share) / (share * (1 - m));
    level = saturation * thickness;
  }
}

WetBed::WetBed(ParticleSet& p, const MixtureSettings& settings, std::span<const double> strain_rate)
    : settings_(settings),
      mass_(p.mass.data()),
      thickness_(p.scalar(fields::thickness).data()),
      normal_gravity_(p.scalar(fields::normal_gravity).data()),
      solids_(p.scalar(fields::solids_volume).data()),
      water_(p.scalar(fields::water_volume).data()),
      strain_rate_(strain_rate.data()),
      fraction_(p.scalar(fields::solid_fraction).data()),
      excess_(p.scalar(fields::excess_pressure).data()),
      pressure_(p.scalar(fields::pore_pressure).data()),
      gravity_seen_(p.scalar(fields::pore_gravity).data()) {}

/// One column over one kick.
class WetBed::Column {
 public:
  Column(const WetBed& bed, std::size_t i, const BasalResistance& ground, const Push& push)
      : law_(bed.settings_.law), ground_(ground), push_(push), v_(push.before) {
    const double volume = bed.solids_[i] + bed.water_[i];
    share_ = bed.solids_[i] / volume;
    bulk_ = bed.mass_[i] / volume;
    h_ = bed.thickness_[i];
    area_ = volume / h_;
    g_ = bed.normal_gravity_[i];
    stress_ = bulk_ * g_ * h_;
    m_ = bed.fraction_[i];
    permeability_ = law_.permeability_at(m_);
  }

  /// What the weight did to the pressure while no water could move. At the first step the column
  /// learns how thick it is among the others. Later the summed thickness moves by its own noise
  /// too; still water takes that, the excess follows the strain alone.
  void load(double excess, double gravity_seen, double strain_rate,
            const MixtureSettings& settings) {
    const ColumnWater water = geometry();
    if (gravity_seen < 0) {
      const double still = hydrostatic(water);
      excess = pressure_at_release(settings, stress_, still) - still;
    } else {
      // The thickness at the kick is that of its middle.
      const double half = std::clamp(0.5 * strain_rate * push_.time, -0.5, 0.5);
      const double change = h_ * (g_ * (1 - half) - gravity_seen * (1 + half));
      excess += law_.undrained(bulk_, change) - law_.fluid_density * change;
    }
    excess_ = bounded(excess, water);
  }

  void move() {
    Part part = look_ahead(push_.time);
    const ColumnWater water = geometry();
    const double change = std::abs(bounded_only(part.change.excess, water) - excess_) /
                          (largest_change * stress_ + least_stress);
    const int parts = std::clamp(static_cast<int>(std::ceil(std::min(change, 1e3))), 1, most_parts);
    for (int k = 0; k < parts; ++k) {
      if (parts > 1) part = look_ahead(push_.time / parts);
      finish(part);
    }
  }

  Slid result() const { return {v_, clipped_work_}; }
  double solid_fraction() const { return m_; }
  double excess() const { return excess_; }
  double pressure() const { return std::max(0.0, excess_ + hydrostatic(geometry())); }

 private:
  struct Part {
    double time = 0, speed = 0;  // [s], mean |u| [m/s]
    double end_speed = 0;        // as foreseen [m/s]
    PoreRates rates;
    PoreChange change;
    Dilatancy dilatancy;
  };

  ColumnWater geometry() const { return {share_, m_, h_}; }
  double hydrostatic(const ColumnWater& w) const { return law_.fluid_density * g_ * w.level; }
  WetColumn column(const ColumnWater& w, double excess) const {
    return {m_, excess, w.thickness, stress_, hydrostatic(w), g_};
  }

  /// Not below zero, not above the weight, and not above what water in half-filled pores can hold.
  double bounded_only(double excess, const ColumnWater& w) const {
    const double still = hydrostatic(w);
    double most = stress_ - still;
    if (w.saturation < 1) most = std::min(most, 0.0);
    return std::clamp(excess, std::min(-still, most), most);
  }
  double bounded(double excess, const ColumnWater& w) {
    const double inside = bounded_only(excess, w);
    if (inside != excess) {
      const double still = hydrostatic(w);
      // Beyond twice the weight a rate has run away, not a pressure.
      const double out = std::clamp(excess, -still - stress_, 2 * stress_ - still) + still;
      const double in = inside + still;
      const double stiffness = law_.stiffness(m_, std::max(0.0, stress_ - in));
      clipped_work_ += 0.5 * std::abs(out * out - in * in) / stiffness * w.thickness * area_;
    }
    return inside;
  }

  double plastic(const Dilatancy& d, double effective_stress) const {
    const double friction = mixture_friction(ground_.friction_coefficient, d.tangent, m_);
    return (effective_stress * friction + ground_.cohesion_pa) / (bulk_ * h_);
  }
  double rate(double speed, const ColumnWater& w) const {
    const double viscous = 2 * law_.fluid_viscosity * (1 - m_) / (w.thickness * bulk_ * h_);
    return viscous + ground_.rate(speed, h_, bulk_, push_.gravity);
  }

  /// The speed in the middle of the next `time` seconds, and what the pressure does at it.
  Part look_ahead(double time) const {
    Part part;
    part.time = time;
    const ColumnWater water = geometry();
    const WetColumn c = column(water, excess_);
    const double start = v_.norm(), stress = c.effective_stress();
    const Dilatancy now = dilatancy(law_, m_, 2 * start / water.thickness, stress);
    part.end_speed = braked(v_, push_.pull, plastic(now, stress), rate(start, water), time).norm();
    part.speed = 0.5 * (start + part.end_speed);
    part.dilatancy = dilatancy(law_, m_, 2 * part.speed / water.thickness, stress);
    part.rates = tangent_rates(law_, c, permeability_, part.speed, part.dilatancy);
    part.change = advance(part.rates, excess_, time);
    return part;
  }

  void finish(const Part& part) {
    const ColumnWater before = geometry();
    const double mean = bounded_only(part.change.mean_excess, before);
    double m = m_ * std::exp(std::clamp(part.rates.compaction * mean * part.time, -1.0, 1.0));
    m = std::clamp(m, m_ - most_dilation, m_ + most_dilation);
    m = std::max(m, std::min(m_, law_.loosest_fraction()));
    const double steady = part.dilatancy.steady_fraction;
    // Thin fast films would swing about their steady fraction: they stop at it.
    if (part.rates.decay * part.time > 1 && part.speed > 0 && (m_ - steady) * (m - steady) < 0)
      m = steady;
    if (before.saturation < 1 && part.change.excess > 0) m = std::max(m, closed(part, before));
    const WetColumn c = column(before, mean);
    const Dilatancy d =
        dilatancy(law_, m_, 2 * part.speed / before.thickness, c.effective_stress());
    v_ = braked(v_, push_.pull, plastic(d, c.effective_stress()), rate(part.speed, before),
                part.time);
    m_ = std::clamp(m, 1e-3, 0.99);
    excess_ = bounded(part.change.excess, geometry());
  }

  /// Pores with air in them close as fast as shear closes them: the air leaves freely.
  double closed(const Part& part, const ColumnWater& water) const {
    const double steady = std::min(part.dilatancy.steady_fraction, share_);
    if (!(steady > m_)) return m_;
    const double strain = 2 * part.speed / water.thickness * part.time;
    return steady + (m_ - steady) * std::exp(-strain * m_);
  }

  const MixtureLaw& law_;
  const BasalResistance& ground_;
  const Push& push_;
  Vec3 v_;
  double share_ = 0, bulk_ = 0, h_ = 0, area_ = 0, g_ = 0, stress_ = 0, permeability_ = 0;
  double m_ = 0, excess_ = 0, clipped_work_ = 0;
};

WetBed::Slid WetBed::slide(std::size_t i, const BasalResistance& ground, const Push& push) const {
  Column column(*this, i, ground, push);
  column.load(excess_[i], gravity_seen_[i], strain_rate_[i], settings_);
  column.move();
  fraction_[i] = column.solid_fraction();
  excess_[i] = column.excess();
  pressure_[i] = column.pressure();
  gravity_seen_[i] = normal_gravity_[i];
  return column.result();
}

}  // namespace sturz
