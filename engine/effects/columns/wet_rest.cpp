// SPDX-License-Identifier: Apache-2.0
// A mixture at rest whose pores pull: what holds it drains away.
#include "engine/effects/columns/mixture.hpp"
#include "engine/effects/columns/shared.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

constexpr double share_that_counts = 0.05;

/// Whether and by what a column lies still.
struct Resting {
  bool moves = false;       ///< it does not
  bool by_suction = false;  ///< without it, it would slide
  double inflow = 0;        ///< rate at which the pressure comes back [1/s]
};

Resting rest_of(const State& s, const ParticleSet& p, const ColumnFlow& flow, std::size_t i) {
  Resting out;
  const MixtureLaw& law = flow.settings.mixture->law;
  const double h = p.scalar(fields::thickness)[i], g = p.scalar(fields::normal_gravity)[i];
  const double excess = p.scalar(fields::excess_pressure)[i],
               m = p.scalar(fields::solid_fraction)[i];
  const double v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
  out.moves = v2 > 1e-4 * s.gravity * h;
  if (out.moves || !(excess < 0)) return out;
  const double solids = p.scalar(fields::solids_volume)[i];
  const double volume = solids + p.scalar(fields::water_volume)[i];
  const double stress = p.mass[i] / volume * g * h;
  const ColumnWater water(solids / volume, m, h);
  const double still = law.fluid_density * g * water.level;
  const BasalResistance& bed =
      flow.settings.bed[static_cast<std::size_t>(flow.zone_of(s.domain, p, i))];
  const auto& slopes = p.components(fields::ground);
  const double slope2 = slopes[0][i] * slopes[0][i] + slopes[1][i] * slopes[1][i];
  const double drive = p.mass[i] / volume * h * s.gravity * std::sqrt(slope2 / (1 + slope2));
  const double drained = std::max(0.0, stress - still) * bed.friction_coefficient + bed.cohesion_pa;
  out.by_suction = drive > drained;
  const WetColumn column{m, excess, water.thickness, stress, still, g};
  out.inflow = pore_rates(law, column, law.permeability_at(m), 0, {}).decay;
  return out;
}

std::string time_text(double seconds) {
  const auto whole = [](double v) { return std::to_string(std::lround(v)); };
  if (!(seconds < 1e9)) return "years";
  if (seconds < 100) return whole(seconds) + " s";
  if (seconds < 6000) return whole(seconds / 60) + " min";
  return seconds < 360000 ? whole(seconds / 3600) + " h" : whole(seconds / 86400) + " days";
}

}  // namespace

void warn_of_suction(const State& s, const ColumnFlow& flow, std::vector<std::string>& out) {
  if (!flow.settings.mixture) return;
  const ParticleSet& p = s.sets[flow.set];
  double mass = 0, moving = 0, held = 0, inflow = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Resting rest = rest_of(s, p, flow, i);
    mass += p.mass[i];
    if (rest.moves) moving += p.mass[i];
    if (rest.by_suction) held += p.mass[i], inflow += p.mass[i] * rest.inflow;
  }
  if (!(held > share_that_counts * mass) || held < moving) return;
  out.push_back("mixture: " + std::to_string(std::lround(100 * held / mass)) +
                " % of the mass lies still on ground too steep for its friction under still water: "
                "only suction holds it, and water that flows back takes it away in about " +
                time_text(held / inflow) +
                ". Then it creeps on and may run. Where it lies is not where it stays: "
                "numerics.stop_at_rest: false with a longer end_time_s goes on");
}

}  // namespace sturz
