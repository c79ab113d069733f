// SPDX-License-Identifier: Apache-2.0
/// What one finished member leaves behind: scalars, peak maps over the window it touched.
#pragma once

#include "engine/core/named_seconds.hpp"
#include "engine/simulation/gauges/gauge_result.hpp"
#include "engine/simulation/history.hpp"
#include "engine/simulation/outcome.hpp"
#include "engine/terrain/raster.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Per-cell results of a member. Peaks are maxima over time of each product at one instant
/// (never max(h) max(v)^2).
enum class PeakLayer {
  thickness,
  speed,
  energy,
  pressure,
  arrival,
  deposit,
  left,
  eroded,
  solid,
  liquid,
  solid_speed,
  solid_energy,
  solid_pressure,
  solid_arrival,
  liquid_speed,
  liquid_energy,
  liquid_pressure,
  liquid_arrival,
  liquid_fraction
};
inline constexpr int n_peak_layers = 19;
/// Of grains and liquid that are told apart, or of both at once.
inline constexpr bool is_of_materials(PeakLayer layer) { return layer >= PeakLayer::solid; }

struct PeakLayerInfo {
  const char* name;  ///< variable name, e.g. "peak_thickness"
  const char* long_name;
  const char* units;  ///< SI: m, m s-1, J m-2, Pa, s, m
  float untouched;    ///< value of a cell that the flow never reached: 0; NaN of what needs a flow
};
const PeakLayerInfo& info(PeakLayer);
/// One number per member. Units are in the names; see scalar_table() for descriptions.
struct MemberScalars {
  double runout_m = 0;  ///< horizontal distance, release's centre of mass to farthest reached cell
  double front_travel_m = 0;  ///< farthest horizontal displacement of a particle from its start
  /// Horizontal displacement of the centre of mass. What left the known ground counts where it was
  /// last seen, here and in com_drop_m and drop_m.
  double com_travel_m = 0;
  double com_drop_m = 0;  ///< vertical fall of the centre of mass
  double com_ratio = 0;   ///< com_drop_m / com_travel_m, tangent; NaN without travel
  double drop_m = 0;      ///< highest release elevation minus lowest elevation at the end
  /// Fahrboeschung (Heim 1932; Scheidegger 1973; Corominas 1996): along the straight line in the
  /// map from the crown, the highest point of the source's surface before it failed, to the toe,
  /// the deposit's cell (above the runout limit) farthest from the crown. NaN without a deposit.
  double crown_to_toe_length_m = 0;  ///< L, horizontal
  double crown_to_toe_drop_m = 0;    ///< H, surface at the crown minus ground at the toe
  double crown_to_toe_ratio = 0;     ///< H / L, tangent of the travel angle
  double deposit_front_m = 0;  ///< as runout_m, to the farthest cell of the deposit; NaN without
  double deposit_com_x_m = 0;  ///< centre of mass of what is there at the end, on the map
  double deposit_com_y_m = 0;
  double reached_area_m2 = 0;  ///< cells with smoothed thickness above the runout limit at any time
  double deposit_area_m2 = 0;  ///< the same at the end
  double max_speed_m_s = 0;    ///< fastest particle (99.9 % quantile of mass when > 1000 particles)
  double max_mean_speed_m_s = 0;  ///< largest mass-averaged speed
  double max_thickness_m = 0;     ///< largest cell value of peak thickness
  double max_deposit_m = 0;
  double max_energy_j_m2 = 0;
  double max_pressure_pa = 0;
  double release_volume_m3 = 0;  ///< bulk
  double released_mass_kg = 0;
  double lost_mass_kg = 0;     ///< left through the domain boundary or removed, accounted for
  double lost_fraction = 0;    ///< share of the mass that left the known ground; 0: not censored so
  double mass_error = 0;       ///< (kept + lost - released) / released; exactly 0 expected
  double energy_residual = 0;  ///< unexplained energy / released energy (see Ledger)
  double release_layers = 0;   ///< volume-weighted median vertical thickness / spacing at release
  double thin_fraction = 0;    ///< mass fraction below 4 layers, time average while moving
  double layers_median =
      0;                  ///< cell thickness / spacing that half of the mass exceeds, time average
  double layers_p10 = 0;  ///< the same for 90 % of the mass
  double take_off_fraction =
      0;  ///< mass and time on ground that curves away faster than it falls; depth_averaged
  double max_mach = 0;             ///< fastest particle / sound speed
  double max_density_error = 0;    ///< max |rho/rho_ref - 1| of loaded particles (99 % of mass)
  double end_time_s = 0;           ///< simulated
  double end_energy_fraction = 0;  ///< kinetic energy at the end / its peak
  double end_moving_fraction = 0;  ///< mass share at the end faster than max_mean_speed_m_s / 20
  double n_particles = 0;
  double n_steps = 0;
  double mean_dt_s = 0;
  double wall_s = 0;                ///< computing time; not part of any hash
  double cpu_s = 0;                 ///< of all threads of the member; not part of any hash
  double parted_fraction = 0;       ///< mass x time under 0.98 of its packing; NaN: depth_averaged
  double transition_fraction = 0;   ///< mass x time in that state; 0 without grains.states
  double dilute_fraction = 0;       ///< the same
  double ultradilute_fraction = 0;  ///< the same
  double max_granular_temperature_m2_s2 = 0;
  double granular_ratio = 0;  ///< that over max_speed_m_s squared
  // Of a mixture; NaN without one.
  double max_pore_pressure_ratio = 0;  ///< of its mass mean over time
  double end_pore_pressure_ratio = 0;  ///< basal pore pressure / total normal stress, mass mean
  double end_solid_fraction = 0;       ///< mass mean
  double end_film_m3 = 0;              ///< water that it has given off and carries
  double solids_error = 0;             ///< (kept + lost - released) / released volume of grains
  double water_error = 0;              ///< the same of water, in pores and film
  double pore_clipped_fraction = 0;    ///< work of pore pressures beyond bounds / released energy
  /// Bulk volume that entered as inflow by the end; NaN without inflow.
  double inflow_volume_m3 = nan_d;
  // Of a bed that the flow takes along; NaN without one.
  double eroded_volume_m3 = nan_d;           ///< of the bed, at its own density
  double entrained_mass_kg = nan_d;          ///< taken up by the flow
  double volume_growth = nan_d;              ///< (brought + entrained) / brought mass
  double max_eroded_depth_m = nan_d;         ///< vertical, of a cell of the ground
  double entrainment_loss_fraction = nan_d;  ///< kinetic energy lost by mixing / released energy
  // Of grains and liquid at two velocities; NaN without.
  double solid_runout_m = nan_d;  ///< as runout_m, to the farthest cell with enough grains
  double liquid_runout_m = nan_d;
  double solid_front_travel_m = nan_d;  ///< as front_travel_m, of each of the two
  double liquid_front_travel_m = nan_d;
  double max_solid_thickness_m = nan_d;  ///< volume of grains over area, largest cell of its peak
  double max_liquid_thickness_m = nan_d;
  double drag_loss_fraction = nan_d;    ///< energy that drag between them took / released energy
  double drag_raised_fraction = nan_d;  ///< mass x time with drag raised to keep the slip solvable
  // The same; files of scenes without them do not name these.
  double solid_lost_mass_kg = nan_d;  ///< as lost_mass_kg, of each of the two
  double liquid_lost_mass_kg = nan_d;
  double solid_lost_fraction = nan_d;  ///< share of the grains that left the known ground
  double liquid_lost_fraction = nan_d;
  double solid_reached_area_m2 = nan_d;  ///< as reached_area_m2, of each of the two
  double liquid_reached_area_m2 = nan_d;
  double max_solid_speed_m_s = nan_d;  ///< largest cell value of its peak speed
  double max_liquid_speed_m_s = nan_d;
  double max_solid_energy_j_m2 = nan_d;  ///< as max_energy_j_m2, of each of the two
  double max_liquid_energy_j_m2 = nan_d;
  double max_solid_pressure_pa = nan_d;  ///< as max_pressure_pa, of the share of each of the two
  double max_liquid_pressure_pa = nan_d;
};

/// What a result is of: everything that flows, or one of two materials that are told apart.
enum class Phase { both, grains, liquid };

/// What of a member's censoring concerns results of a phase: mass that left only where some of it
/// was of that phase. A member that still moved at its end did so as a whole.
inline Censoring censoring_of(Phase phase, const MemberScalars& m, Censoring censoring) {
  const double lost = phase == Phase::grains ? m.solid_lost_fraction : m.liquid_lost_fraction;
  if (phase == Phase::both || std::isnan(lost)) return censoring;
  return censoring_of(has_left(censoring) && lost > 0, is_moving(censoring));
}

/// Whether a member has this layer: `left` is kept only where mass left, `eroded` only where the
/// flow takes its bed along, those of grains and liquid only where they move apart.
inline bool is_kept(PeakLayer layer, Censoring censoring, const MemberScalars& scalars) {
  if (layer == PeakLayer::eroded) return !std::isnan(scalars.eroded_volume_m3);
  if (is_of_materials(layer)) return !std::isnan(scalars.solid_runout_m);
  return layer != PeakLayer::left || has_left(censoring);
}

struct ScalarInfo {
  const char* name;
  const char* units;
  const char* long_name;
  double MemberScalars::*field;
  bool sparse = false;  ///< left out of files where no member has it
};
/// Every scalar in file order; the one table that CSV, netCDF and report share.
std::span<const ScalarInfo> scalar_table();

struct MemberResult {
  std::int64_t member = 0;
  Outcome outcome = Outcome::failed;
  Censoring censoring = Censoring::none;
  std::string reason;  ///< one sentence for diverged, failed, cancelled, left_terrain
  std::string formulation = "full_stress";
  std::string binding_limit;     ///< the time-step limit that bound most steps
  std::string warnings;          ///< '; '-separated, e.g. thin flow
  std::uint64_t state_hash = 0;  ///< of the final particle state, bitwise
  /// Ground was asked for that was not held: nothing else of this result holds, and the member is
  /// to be computed again with a larger part of the raster.
  bool needs_more_ground = false;
  MemberScalars scalars;
  MemberHistory history;  ///< not part of any hash
  GaugeResult gauges;     ///< where the scene has some
  /// Computing time of each pass, and of what lies between steps; adds up to wall_s. Not part of
  /// any hash.
  NamedSeconds pass_seconds;
  /// The same by effect, in the words of `describe`; the same sum.
  NamedSeconds effect_seconds;
  Grid grid;      ///< the whole hazard grid
  Window window;  ///< the part that was touched
  /// Each [window.n_rows][window.n_cols]; empty where not kept (is_kept).
  std::array<std::vector<float>, n_peak_layers> layers;

  std::vector<float>& layer(PeakLayer p) { return layers[static_cast<int>(p)]; }
  const std::vector<float>& layer(PeakLayer p) const { return layers[static_cast<int>(p)]; }
};

/// A member without its maps.
struct MemberSummary {
  std::int64_t member = 0;
  Outcome outcome = Outcome::failed;
  Censoring censoring = Censoring::none;
  std::string reason, formulation, binding_limit, warnings;
  std::uint64_t state_hash = 0;
  MemberScalars scalars;
  Window window;
  SharedSeconds effect_seconds;  ///< may be empty
};

/// A member that has what its summary tells, and neither grid nor maps yet.
MemberResult result_of(const MemberSummary& summary);

/// Finished members, wherever they are kept; implemented by io, handed out by the app.
class MemberSource {
 public:
  virtual ~MemberSource() = default;
  /// All finished members in ascending order of their number.
  virtual const std::vector<MemberSummary>& members() const = 0;
  virtual const Grid& grid() const = 0;
  /// Rows row0..row0+n_rows-1 of one layer of member members()[index], whole grid width;
  /// cells outside its window get info(layer).untouched.
  /// \param out [n_rows][grid().n_cols]
  virtual void read_rows(std::size_t index, PeakLayer layer, int row0, int n_rows,
                         std::span<float> out) const = 0;
};

}  // namespace sturz
