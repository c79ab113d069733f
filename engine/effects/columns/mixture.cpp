// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/columns/mixture.hpp"

#include "engine/core/sum.hpp"
#include "engine/effects/columns/wet_profile.hpp"
#include "engine/effects/fields.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

double pressure_at_release(const MixtureSettings& settings, double stress, double hydrostatic) {
  return settings.pressure_ratio < 0 || settings.profile.drained_bed
             ? hydrostatic
             : settings.pressure_ratio * stress;
}

/// Excess at a height over the bed, in shares of the thickness, between the nodes of column i.
double excess_at(const ProfileMesh& mesh, const std::vector<std::vector<double>>& nodes,
                 std::size_t i, double height) {
  const double where = (height - mesh.height(0)) / mesh.spacing();
  if (where < 0) return nodes[0][i] * (1 + 2 * where);  // a drained bed is half a spacing below
  const int below = std::min(static_cast<int>(where), mesh.nodes - 1);
  const double part = where - below, here = nodes[below][i];
  return below + 1 < mesh.nodes ? here + part * (nodes[below + 1][i] - here)
                                : here * std::max(0.0, 1 - 2 * part);
}

/// What stood in column i stands on so much more from now on, a share of the new thickness.
void lift_profile(MovingSet& p, std::size_t i, double lift, const AddedMixture& added) {
  for (const FieldKey& key : fields::excess_profile) {
    Field* found = p.find(key);
    if (!found) continue;
    auto& nodes = found->component;
    const ProfileMesh mesh{key.components, added.drained_bed};
    const double base = mesh.drained_bed ? 0 : nodes[0][i];
    const double excess = mesh.drained_bed ? 0 : added.excess_pa;
    double moved[fields::most_pressure_nodes];
    for (int j = 0; j < mesh.nodes; ++j) {
      const double height = mesh.height(j);
      moved[j] = height < lift ? base + excess * (1 - height / lift)
                               : excess_at(mesh, nodes, i, (height - lift) / (1 - lift));
    }
    for (int j = 0; j < mesh.nodes; ++j) nodes[j][i] = moved[j];
  }
}

}  // namespace

void add_mixture(State& state, std::size_t set, const MixtureSettings& settings) {
  MovingSet& p = state.sets[set];
  for (const FieldKey* key :
       {&fields::solids_volume, &fields::water_volume, &fields::solid_fraction,
        &fields::excess_pressure, &fields::pore_pressure, &fields::pore_gravity})
    p.add(*key);
  if (settings.profile.nodes > 0) p.add(fields::excess_profile_of(settings.profile.nodes));
  enter_mixture(p, settings, 0);
}

void enter_mixture(MovingSet& p, const MixtureSettings& settings, std::size_t first,
                   std::span<const Arrival> entering) {
  auto& solids = p.scalar(fields::solids_volume);
  auto& water = p.scalar(fields::water_volume);
  auto& fraction = p.scalar(fields::solid_fraction);
  Sum grains, fluid;
  for (std::size_t i = first; i < p.size(); ++i) {
    const double own =
        entering.empty() ? settings.solid_fraction : entering[i - first].solid_fraction;
    const double m = std::isnan(own) ? settings.solid_fraction : own;
    const double volume = p.mass[i] / settings.law.density(m);
    solids[i] = m * volume, water[i] = (1 - m) * volume, fraction[i] = m;
    grains.add(solids[i]), fluid.add(water[i]);
  }
  p.ledger.released_solids += grains.value();
  p.ledger.released_water += fluid.value();
}

void add_to_mixture(MovingSet& p, std::size_t i, const AddedMixture& added) {
  double &solids = p.scalar(fields::solids_volume)[i], &water = p.scalar(fields::water_volume)[i],
         &m = p.scalar(fields::solid_fraction)[i];
  const double skeleton = solids / m + added.solids_m3 / added.solid_fraction;
  lift_profile(p, i, added.solids_m3 / added.solid_fraction / skeleton, added);
  solids += added.solids_m3, water += added.water_m3;
  m = solids / skeleton;
  if (!added.drained_bed) p.scalar(fields::excess_pressure)[i] += added.excess_pa;
  p.ledger.released_solids += added.solids_m3;
  p.ledger.released_water += added.water_m3;
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
      gravity_seen_(p.scalar(fields::pore_gravity).data()) {
  if (settings.profile.nodes > 0)
    inside_ = &p.components(fields::excess_profile_of(settings.profile.nodes));
}

void WetBed::read(WetBlock& b, std::size_t begin) const {
  for (std::size_t k = 0; k < b.n; ++k) {
    const std::size_t i = begin + k;
    b.mass[k] = mass_[i], b.solids[k] = solids_[i], b.water[k] = water_[i];
    b.thickness[k] = thickness_[i], b.normal_gravity[k] = normal_gravity_[i];
    b.strain_rate[k] = strain_rate_[i], b.gravity_seen[k] = gravity_seen_[i];
    b.fraction[k] = fraction_[i], b.excess[k] = excess_[i];
  }
  if (!inside_) return;
  for (std::size_t j = 0; j < inside_->size(); ++j)
    std::copy_n((*inside_)[j].data() + begin, b.n, b.profile->excess[j]);
}

void WetBed::slide(WetBlock& b) const { b.slide(settings_); }

void WetBed::keep(const WetBlock& b, std::size_t k, std::size_t i) const {
  fraction_[i] = b.fraction[k];
  excess_[i] = b.excess[k];
  pressure_[i] = b.pressure[k];
  gravity_seen_[i] = normal_gravity_[i];
  if (!inside_) return;
  for (std::size_t j = 0; j < inside_->size(); ++j) (*inside_)[j][i] = b.profile->excess[j][k];
}

}  // namespace sturz
