// SPDX-License-Identifier: Apache-2.0
// Keys of the bed's rasters and of its SamosAT form: basal.rasters, basal.samosat.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto rasters = blocks::at<&Scenario::basal, &BasalSpec::rasters>;
constexpr auto samosat = blocks::at<&Scenario::basal, &BasalSpec::samosat>;

template <BasalRaster BasalRasters::*member>
void add_raster(std::vector<KeyInfo>& keys, const char* name, const char* help,
                const char* factor_path, const char* factor_help) {
  using enum ValueKind;
  constexpr auto raster = blocks::at<&Scenario::basal, &BasalSpec::rasters, member>;
  keys.push_back(text_key(raster, &BasalRaster::path, name, ValueKind::path, help));
  keys.push_back(above_min(
      key(raster, &BasalRaster::factor, {factor_path, uncertain, "1", 0, 1000, factor_help})));
}

}  // namespace

void add_bed_field_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  const auto add_samosat = [&](Uncertain SamosAtSpec::*member, const Row& row) {
    keys.push_back(above_min(key(samosat, member, row)));
  };
  add_samosat(&SamosAtSpec::fluidization_number,
              {"basal.samosat.fluidization_number", uncertain, "1", 0, 100,
               "R_s0: friction doubles at speeds at which density x speed^2 over normal stress is "
               "well below it."});
  add_samosat(&SamosAtSpec::von_karman, {"basal.samosat.von_karman", uncertain, "1", 0, 10,
                                         "kappa of the logarithmic profile."});
  add_samosat(&SamosAtSpec::roughness_m, {"basal.samosat.roughness_m", uncertain, "m", 0, 10,
                                          "R, roughness of the bed under that profile."});
  add_samosat(&SamosAtSpec::profile_offset,
              {"basal.samosat.profile_offset", uncertain, "1", 0, 100,
               "B, which the profile adds to ln(thickness/R)/kappa."});
  add_raster<&BasalRasters::friction_coefficient>(
      keys, "basal.rasters.friction_coefficient",
      "Raster of the friction coefficient; nodata leaves basal's own number.",
      "basal.rasters.friction_coefficient_factor",
      "Multiplies the values of that raster; 1 when absent.");
  add_raster<&BasalRasters::pore_pressure_ratio>(
      keys, "basal.rasters.pore_pressure_ratio", "Raster of the pore pressure ratio r_u.",
      "basal.rasters.pore_pressure_ratio_factor",
      "Multiplies the values of that raster; 1 when absent.");
  add_raster<&BasalRasters::cohesion_pa>(
      keys, "basal.rasters.cohesion_pa", "Raster of the cohesion, in pascals.",
      "basal.rasters.cohesion_pa_factor", "Multiplies the values of that raster; 1 when absent.");
  add_raster<&BasalRasters::turbulent_coefficient_m_s2>(
      keys, "basal.rasters.turbulent_coefficient_m_s2",
      "Raster of Voellmy's xi, in m/s2; depth_averaged only.",
      "basal.rasters.turbulent_coefficient_m_s2_factor",
      "Multiplies the values of that raster; 1 when absent.");
  keys.push_back(text_key(rasters, &BasalRasters::crs, "basal.rasters.crs", text,
                          "Coordinate system of those rasters that have none."));
}

void add_bed_field_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block("basal.samosat",
                                  "Friction that falls with speed and the drag of a logarithmic "
                                  "profile, as in SamosAT; depth_averaged.",
                                  samosat));
}

}  // namespace sturz::schema_rows
