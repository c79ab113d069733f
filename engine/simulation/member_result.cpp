// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/member_result.hpp"

namespace sturz {
namespace {

constexpr std::array<PeakLayerInfo, n_peak_layers> layer_infos{{
    {"peak_thickness", "largest vertical flow thickness over time", "m", 0},
    {"peak_speed", "largest mass-averaged speed over time", "m s-1", 0},
    {"peak_energy", "largest kinetic energy per area over time", "J m-2", 0},
    {"peak_pressure", "largest dynamic pressure (density times mean speed squared) over time", "Pa",
     0},
    {"arrival_time", "time at which the thickness first exceeds the runout limit", "s", nan_f},
    {"deposit_thickness", "vertical thickness at the end", "m", 0},
}};

using M = MemberScalars;
constexpr std::array scalar_infos{
    ScalarInfo{"runout_m", "m",
               "horizontal distance from the release's centre of mass to the farthest reached cell",
               &M::runout_m},
    ScalarInfo{"front_travel_m", "m", "farthest horizontal displacement of a particle",
               &M::front_travel_m},
    ScalarInfo{"com_travel_m", "m", "horizontal displacement of the centre of mass",
               &M::com_travel_m},
    ScalarInfo{"drop_m", "m", "highest release elevation minus lowest deposit elevation",
               &M::drop_m},
    ScalarInfo{"reached_area_m2", "m2", "area of cells above the runout limit at any time",
               &M::reached_area_m2},
    ScalarInfo{"deposit_area_m2", "m2", "area of cells above the runout limit at the end",
               &M::deposit_area_m2},
    ScalarInfo{"max_speed_m_s", "m s-1", "speed of the fastest particle over time",
               &M::max_speed_m_s},
    ScalarInfo{"max_mean_speed_m_s", "m s-1", "largest mass-averaged speed over time",
               &M::max_mean_speed_m_s},
    ScalarInfo{"max_thickness_m", "m", "largest cell value of peak thickness", &M::max_thickness_m},
    ScalarInfo{"max_deposit_m", "m", "largest cell value of deposit thickness", &M::max_deposit_m},
    ScalarInfo{"max_energy_j_m2", "J m-2", "largest cell value of peak kinetic energy per area",
               &M::max_energy_j_m2},
    ScalarInfo{"max_pressure_pa", "Pa", "largest cell value of peak dynamic pressure",
               &M::max_pressure_pa},
    ScalarInfo{"release_volume_m3", "m3", "bulk volume released", &M::release_volume_m3},
    ScalarInfo{"released_mass_kg", "kg", "mass released", &M::released_mass_kg},
    ScalarInfo{"lost_mass_kg", "kg", "mass that left through the domain boundary or was removed",
               &M::lost_mass_kg},
    ScalarInfo{"mass_error", "1", "(kept + lost - released) / released mass", &M::mass_error},
    ScalarInfo{"energy_residual", "1", "unexplained energy / released energy", &M::energy_residual},
    ScalarInfo{"release_layers", "1", "volume-weighted median vertical release thickness / spacing",
               &M::release_layers},
    ScalarInfo{"thin_fraction", "1", "mass fraction below four layers, time average while moving",
               &M::thin_fraction},
    ScalarInfo{"layers_median", "1",
               "cell thickness / spacing that half of the mass exceeds, time average while moving",
               &M::layers_median},
    ScalarInfo{"layers_p10", "1",
               "cell thickness / spacing that 90 % of the mass exceeds, time average while moving",
               &M::layers_p10},
    ScalarInfo{"take_off_fraction", "1",
               "share of mass and time on ground that curves away faster than the mass falls",
               &M::take_off_fraction},
    ScalarInfo{"max_mach", "1", "speed of the fastest particle / sound speed", &M::max_mach},
    ScalarInfo{"max_density_error", "1",
               "largest relative density deviation of loaded particles (99 % of mass)",
               &M::max_density_error},
    ScalarInfo{"end_time_s", "s", "simulated time", &M::end_time_s},
    ScalarInfo{"n_particles", "1", "number of particles", &M::n_particles},
    ScalarInfo{"n_steps", "1", "number of time steps", &M::n_steps},
    ScalarInfo{"mean_dt_s", "s", "mean time step", &M::mean_dt_s},
    ScalarInfo{"wall_s", "s", "computing time", &M::wall_s},
    ScalarInfo{"parted_fraction", "1",
               "share of mass and time that is looser than 0.98 of its packing at release",
               &M::parted_fraction},
    ScalarInfo{"transition_fraction", "1",
               "share of mass and time between the dense and the dilute state",
               &M::transition_fraction},
    ScalarInfo{"dilute_fraction", "1", "share of mass and time in the dilute state",
               &M::dilute_fraction},
    ScalarInfo{"ultradilute_fraction", "1",
               "share of mass and time in the ultradilute state: grains on their own",
               &M::ultradilute_fraction},
    ScalarInfo{"max_granular_temperature_m2_s2", "m2 s-2", "largest granular temperature over time",
               &M::max_granular_temperature_m2_s2},
    ScalarInfo{"granular_ratio", "1", "largest granular temperature / largest speed squared",
               &M::granular_ratio},
};
// A scalar that is added to the struct but forgotten here would silently miss from every file.
static_assert(scalar_infos.size() * sizeof(double) == sizeof(MemberScalars));

}  // namespace

const PeakLayerInfo& info(PeakLayer layer) { return layer_infos[static_cast<int>(layer)]; }

std::span<const ScalarInfo> scalar_table() { return scalar_infos; }

}  // namespace sturz
