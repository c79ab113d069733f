// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/scalar_censoring.hpp"

#include "engine/core/error.hpp"

#include <algorithm>
#include <array>

namespace sturz {
namespace {

using M = MemberScalars;
constexpr Known yes = Known::exactly, least = Known::at_least, no = Known::not_at_all;

// Left, moving. A crown-to-toe length is to the deposit: what left lies farther, but what still
// moves may thin out or run back from a counter-slope. Drops and ratios go either way. Shares of
// mass and time belong to the motion that was seen.
constexpr std::array rows{
    ScalarCensoring{&M::runout_m, least, least},
    ScalarCensoring{&M::front_travel_m, least, least},
    ScalarCensoring{&M::com_travel_m, no, no},
    ScalarCensoring{&M::com_drop_m, no, no},
    ScalarCensoring{&M::com_ratio, no, no},
    ScalarCensoring{&M::drop_m, no, no},
    ScalarCensoring{&M::crown_to_toe_length_m, least, no},
    ScalarCensoring{&M::crown_to_toe_drop_m, no, no},
    ScalarCensoring{&M::crown_to_toe_ratio, no, no},
    ScalarCensoring{&M::deposit_front_m, least, no},
    ScalarCensoring{&M::deposit_com_x_m, no, no},
    ScalarCensoring{&M::deposit_com_y_m, no, no},
    ScalarCensoring{&M::reached_area_m2, least, least},
    ScalarCensoring{&M::deposit_area_m2, least, no},
    ScalarCensoring{&M::max_speed_m_s, least, least},
    ScalarCensoring{&M::max_mean_speed_m_s, no,
                    least},  // of what was there: the slow may have left
    ScalarCensoring{&M::max_thickness_m, least, least},
    ScalarCensoring{&M::max_deposit_m, least, no},
    ScalarCensoring{&M::max_energy_j_m2, least, least},
    ScalarCensoring{&M::max_pressure_pa, least, least},
    ScalarCensoring{&M::release_volume_m3, yes, yes},
    ScalarCensoring{&M::released_mass_kg, yes, yes},
    ScalarCensoring{&M::lost_mass_kg, yes, least},
    ScalarCensoring{&M::lost_fraction, yes, least},
    ScalarCensoring{&M::mass_error, yes, yes},
    ScalarCensoring{&M::energy_residual, yes, yes},
    ScalarCensoring{&M::release_layers, yes, yes},
    ScalarCensoring{&M::thin_fraction, no, no},
    ScalarCensoring{&M::layers_median, no, no},
    ScalarCensoring{&M::layers_p10, no, no},
    ScalarCensoring{&M::take_off_fraction, no, no},
    ScalarCensoring{&M::max_mach, least, least},
    ScalarCensoring{&M::max_density_error, least, least},
    ScalarCensoring{&M::end_time_s, least, least},
    ScalarCensoring{&M::end_energy_fraction, yes, yes},
    ScalarCensoring{&M::end_moving_fraction, yes, yes},
    ScalarCensoring{&M::n_particles, yes, yes},
    ScalarCensoring{&M::n_steps, yes, yes},
    ScalarCensoring{&M::mean_dt_s, yes, yes},
    ScalarCensoring{&M::wall_s, yes, yes},
    ScalarCensoring{&M::cpu_s, yes, yes},
    ScalarCensoring{&M::parted_fraction, no, no},
    ScalarCensoring{&M::transition_fraction, no, no},
    ScalarCensoring{&M::dilute_fraction, no, no},
    ScalarCensoring{&M::ultradilute_fraction, no, no},
    ScalarCensoring{&M::max_granular_temperature_m2_s2, least, least},
    ScalarCensoring{&M::granular_ratio, no, no},
    ScalarCensoring{&M::max_pore_pressure_ratio, no, least},  // of what was there
    ScalarCensoring{&M::end_pore_pressure_ratio, no, no},
    ScalarCensoring{&M::end_solid_fraction, no, no},
    ScalarCensoring{&M::end_film_m3, no, no},
    ScalarCensoring{&M::solids_error, yes, yes},
    ScalarCensoring{&M::water_error, yes, yes},
    ScalarCensoring{&M::pore_clipped_fraction, no, no},
    ScalarCensoring{&M::inflow_volume_m3, yes, least},
    ScalarCensoring{&M::eroded_volume_m3, least, least},
    ScalarCensoring{&M::entrained_mass_kg, least, least},
    ScalarCensoring{&M::volume_growth, least, least},
    ScalarCensoring{&M::max_eroded_depth_m, least, least},
    ScalarCensoring{&M::entrainment_loss_fraction, no, no},
    ScalarCensoring{&M::solid_runout_m, least, least, Phase::grains},
    ScalarCensoring{&M::liquid_runout_m, least, least, Phase::liquid},
    ScalarCensoring{&M::solid_front_travel_m, least, least, Phase::grains},
    ScalarCensoring{&M::liquid_front_travel_m, least, least, Phase::liquid},
    ScalarCensoring{&M::max_solid_thickness_m, least, least, Phase::grains},
    ScalarCensoring{&M::max_liquid_thickness_m, least, least, Phase::liquid},
    ScalarCensoring{&M::drag_loss_fraction, no, no},
    ScalarCensoring{&M::drag_raised_fraction, no, no},
    ScalarCensoring{&M::solid_lost_mass_kg, yes, least, Phase::grains},
    ScalarCensoring{&M::liquid_lost_mass_kg, yes, least, Phase::liquid},
    ScalarCensoring{&M::solid_lost_fraction, yes, least, Phase::grains},
    ScalarCensoring{&M::liquid_lost_fraction, yes, least, Phase::liquid},
    ScalarCensoring{&M::solid_reached_area_m2, least, least, Phase::grains},
    ScalarCensoring{&M::liquid_reached_area_m2, least, least, Phase::liquid},
    ScalarCensoring{&M::max_solid_speed_m_s, least, least, Phase::grains},
    ScalarCensoring{&M::max_liquid_speed_m_s, least, least, Phase::liquid},
    ScalarCensoring{&M::max_solid_energy_j_m2, least, least, Phase::grains},
    ScalarCensoring{&M::max_liquid_energy_j_m2, least, least, Phase::liquid},
    ScalarCensoring{&M::max_solid_pressure_pa, least, least, Phase::grains},
    ScalarCensoring{&M::max_liquid_pressure_pa, least, least, Phase::liquid},
};
// A scalar without a row would pass as fully known.
static_assert(rows.size() * sizeof(double) == sizeof(MemberScalars));

const ScalarCensoring& row_of(double MemberScalars::*field) {
  const auto* row = std::find_if(rows.begin(), rows.end(),
                                 [&](const ScalarCensoring& r) { return r.field == field; });
  expect(row != rows.end(), "scalar_censoring has a row for every scalar");
  return *row;
}

}  // namespace

std::span<const ScalarCensoring> scalar_censoring() { return rows; }

Known weaker(Known left, Known moving, Censoring censoring) {
  Known weakest = Known::exactly;
  if (has_left(censoring)) weakest = std::max(weakest, left);
  if (is_moving(censoring)) weakest = std::max(weakest, moving);
  return weakest;
}

Known known(double MemberScalars::*field, Censoring censoring) {
  const ScalarCensoring& row = row_of(field);
  return weaker(row.left, row.moving, censoring);
}

Known known(double MemberScalars::*field, const MemberScalars& of, Censoring censoring) {
  const ScalarCensoring& row = row_of(field);
  return weaker(row.left, row.moving, censoring_of(row.of, of, censoring));
}

std::vector<Observation> observations(std::span<const MemberSummary> members,
                                      double MemberScalars::*field) {
  std::vector<Observation> all;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome))
      all.push_back({m.scalars.*field, known(field, m.scalars, m.censoring)});
  return all;
}

}  // namespace sturz
