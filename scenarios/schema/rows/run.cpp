// SPDX-License-Identifier: Apache-2.0
// Keys that say how it is computed and what is asked: numerics, domain, ensemble, hazard.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto numerics = blocks::at<&Scenario::numerics>;
constexpr auto domain = blocks::at<&Scenario::domain>;
constexpr auto ensemble = blocks::at<&Scenario::ensemble>;
constexpr auto target = blocks::at<&Scenario::ensemble, &EnsembleSpec::target>;
constexpr auto hazard = blocks::at<&Scenario::hazard>;

void add_numerics(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(is_required(absent_when_zero(above_min(
      key(numerics, &NumericsSpec::spacing_m,
          {"numerics.spacing_m", number, "m", 0, 1000,
           "Initial particle spacing; at least three should fit the source's thickness."})))));
  keys.push_back(above_min(key(numerics, &NumericsSpec::end_time_s,
                               {"numerics.end_time_s", number, "s", 0, 1e5,
                                "Simulated time after which a member is stopped. When absent it "
                                "runs to rest, at most for a time from the energy line."})));
  keys.push_back(key(numerics, &NumericsSpec::courant,
                     {"numerics.courant", number, "1", 0.01, 0.5,
                      "Time step over smoothing length / (sound speed + speed)."}));
  keys.push_back(key(numerics, &NumericsSpec::sound_speed_factor,
                     {"numerics.sound_speed_factor", number, "1", 3, 100,
                      "Numerical sound speed over the expected flow speed."}));
  keys.push_back(key(numerics, &NumericsSpec::adaptive_sound_speed,
                     {"numerics.adaptive_sound_speed", flag, "", -no_limit, no_limit,
                      "Let the sound speed follow the flow: fewer steps while the mass is slow."}));
  keys.push_back(
      key(numerics, &NumericsSpec::artificial_viscosity,
          {"numerics.artificial_viscosity", number, "1", 0, 1,
           "Strength of the artificial viscosity. Where grains flow it stands in for at most "
           "a tenth of their friction."}));
  keys.push_back(key(numerics, &NumericsSpec::density_diffusion,
                     {"numerics.density_diffusion", number, "1", 0, 0.5,
                      "Strength of the density smoothing (delta-SPH)."}));
  keys.push_back(key(numerics, &NumericsSpec::jitter,
                     {"numerics.jitter", number, "1", 0, 0.25,
                      "Random displacement of the start lattice, in initial particle spacings."}));
  keys.push_back(key(numerics, &NumericsSpec::stop_at_rest,
                     {"numerics.stop_at_rest", flag, "", -no_limit, no_limit,
                      "Stop a member when its mass has come to rest."}));
  keys.push_back(key(numerics, &NumericsSpec::stop_energy_fraction,
                     {"numerics.stop_energy_fraction", number, "1", 1e-6, 0.1,
                      "At rest: the front stands, and no more than this share of the peak kinetic "
                      "energy is left."}));
  keys.push_back(key(numerics, &NumericsSpec::max_wall_time_s,
                     {"numerics.max_wall_time_s", number, "s", 0, 1e7,
                      "Computing time after which a member counts as failed; 0 sets no limit."}));
  keys.push_back(key(numerics, &NumericsSpec::accept_unresolved,
                     {"numerics.accept_unresolved", flag, "", -no_limit, no_limit,
                      "Compute with full_stress although fewer than two layers of particles "
                      "resolve the flow."}));
}

void add_domain(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(with_choices(key(domain, &DomainSpec::periodic,
                                  {"domain.periodic", text_list, "", -no_limit, no_limit,
                                   "Directions in which the terrain's extent repeats itself."}),
                              {"x", "y"}));
  keys.push_back(key(domain, &DomainSpec::walls,
                     {"domain.walls", wall_list, "", -no_limit, no_limit,
                      "Plane walls: a point, a normal into the free side, friction of the grains, "
                      "when the wall is taken away, and whether the liquid of `fluid` slips (the "
                      "default) or sticks there."}));
}

void add_ensemble(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  keys.push_back(choice_key(
      ensemble, &EnsembleSpec::design, "ensemble.design",
      "How the uncertain values are drawn; morris and saltelli are for `sturz sensitivity`.",
      {"full_grid"}));
  keys.push_back(text_key(ensemble, &EnsembleSpec::table, "ensemble.table", path,
                          "CSV with one row per member and one column per uncertain key, for "
                          "design: table."));
  keys.push_back(
      absent_when_zero(key(ensemble, &EnsembleSpec::members,
                           {"ensemble.members", integer, "1", 1, 1e7, "Number of members."})));
  keys.push_back(key(ensemble, &EnsembleSpec::seed,
                     {"ensemble.seed", integer, "1", 0, 9007199254740992.0,
                      "Seed of every random number of the ensemble."}));
  keys.push_back(key(ensemble, &EnsembleSpec::correlation,
                     {"ensemble.correlation", number_map, "1", -no_limit, no_limit,
                      "Correlation of pairs 'key/key' of uncertain values (Gaussian copula), "
                      "each between -1 and 1."}));
  keys.push_back(key(ensemble, &EnsembleSpec::max_failed_fraction,
                     {"ensemble.max_failed_fraction", number, "1", 0, 1,
                      "Share of failed members above which the ensemble counts as failed."}));
  keys.push_back(
      key(ensemble, &EnsembleSpec::max_censored_fraction,
          {"ensemble.max_censored_fraction", number, "1", 0, 1,
           "Share of members whose mass left the terrain or still moved at the end above "
           "which every result says so first."}));
}

void add_estimator(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  KeyInfo estimator =
      key(ensemble, &EnsembleSpec::estimator,
          {"ensemble.estimator", choice, "", -no_limit, no_limit,
           "plain: means and maps of the members; multilevel: the same of few members "
           "and many cheaper ones, for what `target` asks."});
  keys.push_back(with_choices(std::move(estimator), {"plain", "multilevel"}));
  keys.push_back(absent_when_zero(above_min(key(
      target, &TargetSpec::relative_error,
      {"ensemble.target.relative_error", number, "1", 0, 1,
       "Half width of the 90 % bounds of mean run-out, reached area and travel of the centre of "
       "mass, over the mean."}))));
  keys.push_back(absent_when_zero(above_min(
      key(target, &TargetSpec::map_error,
          {"ensemble.target.map_error", number, "1", 0, 0.5,
           "Standard error of P(reached), root mean square over cells with 0.05 < P < 0.95."}))));
  keys.push_back(absent_when_zero(
      above_min(key(target, &TargetSpec::core_hours,
                    {"ensemble.target.core_hours", number, "h", 0, 1e6,
                     "Computing time of all members together, instead of an error."}))));
  keys.push_back(text_key(ensemble, &EnsembleSpec::levels, "ensemble.levels", text,
                          "Cheaper levels for multilevel, a formulation and a spacing in metres "
                          "each, such as full_stress 12, depth_averaged 9; chosen when absent."));
  keys.push_back(key(ensemble, &EnsembleSpec::pilot,
                     {"ensemble.pilot", integer, "1", 8, 1000,
                      "Members of each level before multilevel chooses their numbers; 16 when "
                      "absent."}));
}

void add_hazard(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  const auto thresholds = [&](std::vector<double> HazardSpec::*member, const char* path,
                              const char* units, const char* help) {
    keys.push_back(above_min(key(hazard, member, {path, number_list, units, 0, no_limit, help})));
  };
  keys.push_back(key(hazard, &HazardSpec::cell_size_m,
                     {"hazard.cell_size_m", number, "m", 1e-3, 1e4,
                      "Cell of the hazard maps; the terrain's working cell when absent."}));
  thresholds(&HazardSpec::thickness_m, "hazard.thickness_m", "m",
             "Thickness thresholds of the exceedance maps, rising.");
  thresholds(&HazardSpec::speed_m_s, "hazard.speed_m_s", "m s-1",
             "Speed thresholds of the exceedance maps, rising.");
  thresholds(&HazardSpec::energy_kj_m2, "hazard.energy_kj_m2", "kJ m-2",
             "Thresholds of kinetic energy per area, rising.");
  thresholds(&HazardSpec::pressure_kpa, "hazard.pressure_kpa", "kPa",
             "Thresholds of dynamic pressure, rising.");
  thresholds(&HazardSpec::eroded_depth_m, "hazard.eroded_depth_m", "m",
             "Thresholds of the depth of bed that the flow takes along, rising; for scenes with "
             "erosion.");
  keys.push_back(above_min(key(
      hazard, &HazardSpec::quantiles,
      {"hazard.quantiles", number_list, "1", 0, 1, "Quantile levels between 0 and 1, rising."})));
  keys.push_back(text_key(hazard, &HazardSpec::observed_polygon, "hazard.observed_polygon", path,
                          "Polygon layer of what a mapped event covered, any format that OGR "
                          "reads: drawn over the maps of the page, nothing is computed from it."));
  keys.push_back(text_key(hazard, &HazardSpec::observed_note, "hazard.observed_note", text,
                          "What the observed outline is, for the legend: event, source, how it "
                          "was made."));
  keys.push_back(
      key(hazard, &HazardSpec::gis_files,
          {"hazard.gis_files", flag, "", -no_limit, no_limit,
           "Write what a GIS opens: GeoTIFFs with their styles, outlines (.gpkg), project "
           "(.qgz), ground.tif and stac_item.json. hazard.nc and peaks.nc hold the same "
           "maps without them."}));
}

}  // namespace

void add_run_blocks(std::vector<BlockInfo>& list) {
  list.push_back(
      optional_block("ensemble.target", "What a multilevel ensemble is to reach.", target));
}

void add_run_keys(std::vector<KeyInfo>& keys) {
  add_numerics(keys);
  add_domain(keys);
  add_ensemble(keys);
  add_estimator(keys);
  add_hazard(keys);
}

}  // namespace sturz::schema_rows
