// SPDX-License-Identifier: Apache-2.0
// Keys of a bed that the flow takes along: erosion.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto erosion = blocks::at<&Scenario::erosion>;

void add_supply(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(choice_key(erosion, &ErosionSpec::supply, "erosion.supply",
                            "How much there is to take: limited by depth_m or depth_raster, or "
                            "unlimited."));
  keys.push_back(above_min(key(erosion, &ErosionSpec::depth_m,
                               {"erosion.depth_m", uncertain, "m", 0, 1000,
                                "Vertical depth of bed that can be taken, everywhere or inside "
                                "erosion.polygon."})));
  keys.push_back(text_key(erosion, &ErosionSpec::polygon, "erosion.polygon", path,
                          "Polygon layer that outlines where the bed can be taken; everywhere when "
                          "absent."));
  keys.push_back(text_key(erosion, &ErosionSpec::layer, "erosion.layer", text,
                          "Layer inside erosion.polygon; the first when absent."));
  keys.push_back(
      text_key(erosion, &ErosionSpec::depth_raster, "erosion.depth_raster", path,
               "Raster of the vertical depth of bed that can be taken, in metres; nodata "
               "means zero."));
  keys.push_back(above_min(key(erosion, &ErosionSpec::depth_factor,
                               {"erosion.depth_factor", uncertain, "1", 0, 1000,
                                "Multiplies the values of depth_raster; 1 when absent."})));
  keys.push_back(text_key(erosion, &ErosionSpec::crs, "erosion.crs", text,
                          "Coordinate system of polygon or raster where it has none."));
  keys.push_back(key(erosion, &ErosionSpec::bed_density_kg_m3,
                     {"erosion.bed_density_kg_m3", uncertain, "kg m-3", 100, 10000,
                      "Bulk density of the bed; that of the flow when absent."}));
}

void add_laws(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(
      choice_key(erosion, &ErosionSpec::law, "erosion.law",
                 "exponential: depth rate growth_rate x thickness x speed; shear_stress: "
                 "a fixed rate down to a depth that the stress sets; momentum_jump: by "
                 "the difference of what flow and bed resist with."));
  keys.push_back(above_min(key(erosion, &ErosionSpec::growth_rate_per_m,
                               {"erosion.growth_rate_per_m", uncertain, "m-1", 0, 1,
                                "E_s of law exponential: ln(V_f/V_0) over the path."})));
  keys.push_back(above_min(key(erosion, &ErosionSpec::rate_m_s,
                               {"erosion.rate_m_s", uncertain, "m s-1", 0, 10,
                                "Depth rate of law shear_stress; 0.025 when absent."})));
  keys.push_back(above_min(key(erosion, &ErosionSpec::depth_per_stress_m_per_kpa,
                               {"erosion.depth_per_stress_m_per_kpa", uncertain, "m kPa-1", 0, 100,
                                "Depth that each kilopascal above critical_stress can take, law "
                                "shear_stress; 0.1 when absent."})));
  keys.push_back(key(erosion, &ErosionSpec::critical_stress_kpa,
                     {"erosion.critical_stress_kpa", uncertain, "kPa", 0, 1e4,
                      "Shear stress below which nothing is taken, law shear_stress; 1 when "
                      "absent."}));
  keys.push_back(key(erosion, &ErosionSpec::bed_friction_coefficient,
                     {"erosion.bed_friction_coefficient", uncertain, "1", 0, 2,
                      "Friction coefficient inside the bed, law momentum_jump."}));
  keys.push_back(key(erosion, &ErosionSpec::bed_pore_pressure_ratio,
                     {"erosion.bed_pore_pressure_ratio", uncertain, "1", 0, 1,
                      "Pore pressure over normal stress in the bed, 1: liquefied; for law "
                      "momentum_jump, and for what a bed brings into a mixture (hydrostatic when "
                      "absent)."}));
  keys.push_back(key(erosion, &ErosionSpec::bed_solid_fraction,
                     {"erosion.bed_solid_fraction", uncertain, "1", 0.05, 0.85,
                      "Share of the saturated bed that is grain, with mixture; "
                      "mixture.critical_solid_fraction when absent."}));
}

}  // namespace

void add_erosion_keys(std::vector<KeyInfo>& keys) {
  add_laws(keys);
  add_supply(keys);
}

void add_erosion_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(
      optional_block("erosion", "A bed that the flow takes along; depth_averaged.", erosion));
}

}  // namespace sturz::schema_rows
