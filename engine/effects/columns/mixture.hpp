// SPDX-License-Identifier: Apache-2.0
/// A mixture of grains and pore fluid in columns: solid fraction and basal pore pressure of each
/// column go with it, and the pressure decides how much of its weight the bed brakes.
///
/// A column keeps its grains and its water exactly. What it contracts by becomes a film of water on
/// it, what it dilates by comes out of the film; once that is used up the pores fill with air and
/// hold no pressure above that of the water left in them.
#pragma once

#include "engine/effects/columns/mixture_settings.hpp"
#include "engine/effects/columns/wet_block.hpp"
#include "engine/effects/state.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// Fields "solids_volume", "water_volume", "solid_fraction", "excess_pressure",
/// "pore_pressure", "pore_gravity", and "excess_profile" where it is resolved.
void add_mixture(State&, std::size_t set, const MixtureSettings&);
/// Fills them for columns from `first` on, which are new, and the ledger with their volumes.
/// \param entering of each of them, where it may bring a solid fraction of its own; or empty
void enter_mixture(MovingSet&, const MixtureSettings&, std::size_t first,
                   std::span<const Arrival> entering = {});

/// Mass that joins a column from below, e.g. bed that a flow takes along.
struct AddedMixture {
  double solids_m3 = 0, water_m3 = 0;
  double solid_fraction = 0.6;  ///< of its grains and pores, full or not
  /// What it adds to the excess pressure at the column's base: its own pore pressure less that of
  /// still water in it; zero where it is hydrostatic [Pa].
  double excess_pa = 0;
  bool drained_bed = false;  ///< the bed lets go of its excess at once (ProfileSettings)
};
/// Mixes it into column i, its volumes into the ledger. Mass and momentum are the caller's;
/// pressure comes within its bounds at the next kick.
void add_to_mixture(MovingSet&, std::size_t i, const AddedMixture&);

/// Sets column i's pore pressure to that of the release, for its present thickness.
void start_pressure(ParticleSet&, const MixtureSettings&, std::size_t i);

/// Where grains, pores and film of a column are.
struct ColumnWater {
  double share = 0;       ///< of the volume of grains and water that is grain
  double thickness = 0;   ///< of grains and pores, along the normal [m]
  double film = 0;        ///< of water on them [m]
  double saturation = 1;  ///< of the pores
  double level = 0;       ///< of the water: its pressure at rest over rho_f g [m]

  /// \param whole thickness of grains and water [m]
  ColumnWater(double solid_share, double solid_fraction, double whole);
};

/// The columns of a mixture as the bed meets them; looked up once per pass.
class WetBed {
 public:
  /// \param strain_rate div v of each column [1/s]
  WetBed(ParticleSet&, const MixtureSettings&, std::span<const double> strain_rate);

  /// Fills what the columns know of themselves, for columns begin ... begin + block.n; a block of
  /// a resolved profile has room for it.
  void read(WetBlock&, std::size_t begin) const;
  void slide(WetBlock&) const;
  /// Column i takes over what became of column k of the block, but for its velocity.
  void keep(const WetBlock&, std::size_t k, std::size_t i) const;

 private:
  const MixtureSettings& settings_;
  const double *mass_, *thickness_, *normal_gravity_, *solids_, *water_, *strain_rate_;
  double *fraction_, *excess_, *pressure_, *gravity_seen_;
  std::vector<std::vector<double>>* inside_ = nullptr;  // of a resolved profile, by node
};

}  // namespace sturz
