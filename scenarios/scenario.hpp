// SPDX-License-Identifier: Apache-2.0
/// What a scene is: the plain data of one scenario file. Presence of a block switches an effect on.
#pragma once

#include "scenarios/assets/assets_spec.hpp"
#include "scenarios/choices.hpp"
#include "scenarios/estimator/estimator.hpp"
#include "scenarios/fluid/fluid_spec.hpp"
#include "scenarios/grains/discrete_spec.hpp"
#include "scenarios/map_box.hpp"
#include "scenarios/observation/observation_spec.hpp"
#include "scenarios/overlays/report_spec.hpp"
#include "scenarios/uncertain.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// Ground written as a formula instead of a raster; see scenarios/shapes/synthetic_terrain.hpp.
struct SyntheticTerrain {
  std::string shape;  ///< plane, bowl, step, flume, ramp, zhangjiawan, shuicheng
  double cell_size_m = 5;
  std::map<std::string, double> parameters;  ///< the shape's own numbers, e.g. slope_deg
  bool operator==(const SyntheticTerrain&) const = default;
};

/// The part of a large raster that is read first: a rectangle, or what a polygon layer spans.
struct TerrainWindow {
  std::array<double, 2> x_m{}, y_m{};
  std::string polygon;  ///< any OGR polygon layer
  bool operator==(const TerrainWindow&) const = default;
};

/// A dam or deflecting wall along a line, raised on the ground before the run. Exactly one of line
/// and points_m; exactly one of height_m, height_attribute, crest_elevation_m.
struct DamSpec {
  std::string line;                              ///< any OGR layer of lines
  std::string layer;                             ///< layer name inside `line`; empty: the first
  std::vector<std::array<double, 2>> points_m;   ///< map coordinates of the line's corners
  std::optional<Uncertain> height_m;             ///< of the crest above the ground below it
  std::string height_attribute;                  ///< field of `line` with it
  std::optional<Uncertain> crest_elevation_m{};  ///< level crest at this elevation
  double crest_width_m = 4;                      ///< flat top across the line
  double side_slope = 1.5;                       ///< horizontal per vertical, of both sides
  bool operator==(const DamSpec&) const = default;
};

/// Cells of the ground that stand above it, so that columns flow around them.
struct BuildingsSpec {
  std::string polygon;           ///< any OGR polygon layer
  std::string layer;             ///< layer name inside `polygon`; empty: the first
  double height_m = 10;          ///< of the roofs above the ground
  std::string height_attribute;  ///< field of `polygon` with it, in metres
  bool operator==(const BuildingsSpec&) const = default;
};

struct TerrainSpec {
  std::string raster;  ///< path of any GDAL raster; empty: synthetic
  std::optional<SyntheticTerrain> synthetic;
  std::string crs;  ///< given by the user where the file has none (or a wrong one)
  std::optional<double> cell_size_m;  ///< working grid; default: the raster's own
  TerrainEdge nodata = TerrainEdge::outflow;
  std::optional<TerrainWindow> window;  ///< absent: from the energy line
  std::vector<DamSpec> dams;
  std::optional<BuildingsSpec> buildings;
  bool operator==(const TerrainSpec&) const = default;
};

/// Analytic source shapes for tests and sketches, in map coordinates.
using ReleaseBox = MapBox;
struct ReleaseParaboloid {  ///< thickness * (1 - (dx/a)^2 - (dy/b)^2)
  std::array<double, 2> center_m{}, semi_axes_m{};
  bool operator==(const ReleaseParaboloid&) const = default;
};
struct ReleaseCylinder {
  std::array<double, 2> center_m{};
  double radius_m = 0;
  bool operator==(const ReleaseCylinder&) const = default;
};

/// Where and how thick the mass starts. Exactly one of polygon, thickness_raster, box, paraboloid,
/// cylinder, or none of them when the synthetic terrain brings its own source.
struct ReleaseSpec {
  std::string polygon;              ///< any OGR polygon layer
  std::string layer;                ///< layer name inside `polygon`; empty: the first
  std::string feature;              ///< the one feature that is the source; empty: all of them
  std::string feature_key;          ///< field of `polygon` that names features; empty: their FID
  bool each_feature = false;        ///< a region: an ensemble for each of them
  std::string thickness_attribute;  ///< field of `polygon` with a thickness in metres
  std::string volume_attribute;     ///< field of `polygon` with a bulk volume in m3
  std::string thickness_raster;     ///< metres; nodata means zero
  double thickness_factor = 1;      ///< of `thickness_raster`: -1 where depths count downward
  std::string crs;                  ///< where the release file has none
  std::optional<ReleaseBox> box;
  std::optional<ReleaseParaboloid> paraboloid;
  std::optional<ReleaseCylinder> cylinder;
  std::optional<Uncertain> thickness_m;          ///< thickness of polygon, box, ...
  std::optional<Uncertain> volume_m3;            ///< bulk; scales the thickness
  ReleaseSurface surface = ReleaseSurface::bed;  ///< pre_failure: bed = terrain - thickness
  ThicknessDirection thickness = ThicknessDirection::vertical;  ///< how thicknesses were measured
  ReleaseFloor floor = ReleaseFloor::uniform;                   ///< of a pre_failure release
  std::array<double, 3> velocity_m_s{0, 0, 0};
  std::optional<Uncertain> start_time_s;  ///< absent: 0; of the whole release, depth_averaged only
  std::string start_time_attribute;  ///< field of `polygon` with a time in seconds, in addition
  bool operator==(const ReleaseSpec&) const = default;
};

/// Mass that enters over time across a line or at a polygon; depth_averaged only.
struct InflowSpec {
  std::string name;        ///< what it is called in words; empty: its number
  std::string hydrograph;  ///< CSV of time and discharge
  // Exactly one of the next three.
  std::string line, polygon;                  ///< any OGR layer
  std::vector<std::array<double, 2>> line_m;  ///< corners of a line in map coordinates
  std::string layer;                          ///< layer name inside the file; empty: the first
  std::string crs;                            ///< where the file has none
  std::optional<Uncertain> discharge_factor;  ///< of the hydrograph; absent: 1
  std::optional<Uncertain> start_time_s;      ///< of the hydrograph's time 0; absent: 0
  std::optional<Uncertain> speed_m_s;         ///< along the ground; absent: critical
  std::optional<Uncertain> direction_deg;     ///< clockwise from north; absent: down the slope
  bool operator==(const InflowSpec&) const = default;
};

/// A named point (one corner) or line.
struct GaugeSpec {
  std::string name;
  std::vector<std::array<double, 2>> corners_m;  ///< map coordinates
  bool operator==(const GaugeSpec&) const = default;
};

/// Where the run is followed over time.
struct GaugesSpec {
  double interval_s = 1;
  std::vector<GaugeSpec> points, lines;
  std::string file;                     ///< any OGR layer of points or lines
  std::string layer;                    ///< layer name inside `file`; empty: the first
  std::string name_attribute = "name";  ///< field of `file` with their names
  std::string crs;                      ///< where `file` has none
  bool operator==(const GaugesSpec&) const = default;
};

/// mu(I) = static + (dynamic - static) / (scale / I + 1)
struct FrictionLaw {
  Uncertain static_coefficient{0.38};   ///< key `static`
  Uncertain dynamic_coefficient{0.64};  ///< key `dynamic`
  Uncertain inertial_number_scale{0.3};
  bool operator==(const FrictionLaw&) const = default;
};

/// Grains that part and collide: kinetic theory with a granular temperature.
struct DiluteSpec {
  Uncertain restitution{0.7};  ///< of two grains, e
  bool operator==(const DiluteSpec&) const = default;
};

/// Grains that have lost their neighbours: isolated particles in free flight.
struct UltradiluteSpec {
  IsolatedContactLaw contacts = IsolatedContactLaw::none;
  Uncertain restitution{0.7};           ///< of two isolated particles, where they meet
  Uncertain friction_coefficient{0.5};  ///< of two isolated particles
  double youngs_modulus_pa = 5e10;      ///< softened to the speeds of the scene
  bool operator==(const UltradiluteSpec&) const = default;
};

/// The states that grains pass through when the fraction they fill falls; full_stress only.
struct GrainStatesSpec {
  std::optional<DiluteSpec> dilute;
  std::optional<UltradiluteSpec> ultradilute;
  StressMode stress_mode = StressMode::unified;
  std::optional<Uncertain> max_fraction;   ///< alpha_max; default max(0.64, solid_fraction + 0.08)
  Uncertain frictional_pressure_pa{0.05};  ///< Fr of the paper's Eq. (23)
  bool operator==(const GrainStatesSpec&) const = default;
};

struct GrainsSpec {
  Uncertain density_kg_m3{2600};  ///< of the grain material
  Uncertain diameter_m{0.1};
  Uncertain solid_fraction{0.6};
  std::optional<FrictionLaw> friction;  ///< either this ...
  std::optional<Uncertain>
      friction_angle_deg;  ///< ... or this: mu = tan(angle), no rate dependence
  Uncertain cohesion_pa{0};
  Uncertain poisson_ratio{0.3};
  LateralPressure earth_pressure = LateralPressure::automatic;  ///< depth_averaged only
  FrictionCone friction_cone = FrictionCone::simple_shear;      ///< full_stress only
  bool pore_pressure_inside = false;  ///< basal.pore_pressure_ratio acts inside; full_stress only
  std::optional<GrainStatesSpec> states;  ///< absent: every grain is dense
  std::optional<DiscreteSpec> discrete;   ///< absent: its defaults; formulation: discrete only
  bool operator==(const GrainsSpec&) const = default;
};

/// A mixture of grains and water whose pore pressure follows from its shear: depth_averaged only.
/// Its grains and their share at the start are those of `grains`, its friction angle that of
/// `basal`.
struct MixtureSpec {
  Uncertain fluid_density_kg_m3{1000};
  Uncertain fluid_viscosity_pa_s{0.005};
  InitialPressure initial_pressure = InitialPressure::hydrostatic;
  std::optional<Uncertain> initial_pressure_ratio;  ///< p_b over total normal stress, instead
  Uncertain critical_solid_fraction{0.64};
  Uncertain permeability_m2{1e-10};  ///< at `permeability_fraction`
  Uncertain permeability_fraction{0.6};
  Uncertain compressibility{0.05};
  Uncertain stress_offset_pa{1000};
  Uncertain shear_grain_diameter_m{0.001};
  PressureProfile pressure_profile = PressureProfile::parabola;
  std::optional<int> pressure_nodes;  ///< of a resolved profile; absent: 8
  Drainage drainage = Drainage::top;  ///< `both` needs a resolved profile
  MixturePhases phases = MixturePhases::one;
  /// Of `phases: two`, as is the next; `settling` is by grains.diameter_m without a speed.
  PhaseDragLaw drag_law = PhaseDragLaw::permeability;
  std::optional<Uncertain> settling_speed_m_s;
  bool operator==(const MixtureSpec&) const = default;
};

/// Grains and liquid are two sets of columns.
inline bool has_two_phases(const std::optional<MixtureSpec>& mixture) {
  return mixture && mixture->phases == MixturePhases::two;
}

/// A part of the ground with values of its own; what it does not give is that of `basal`.
struct BasalZone {
  std::string polygon;  ///< any OGR polygon layer
  std::string layer;    ///< layer name inside `polygon`; empty: the first
  std::optional<Uncertain> friction_coefficient, pore_pressure_ratio, cohesion_pa;
  std::optional<Uncertain> turbulent_coefficient_m_s2{};  ///< depth_averaged only
  bool operator==(const BasalZone&) const = default;
};

/// A raster in the place of one number of `basal`; nodata leaves that number.
struct BasalRaster {
  std::string path;                 ///< any GDAL raster, in the key's unit; empty: none
  std::optional<Uncertain> factor;  ///< multiplies its values; 1 when absent
  bool operator==(const BasalRaster&) const = default;
};
struct BasalRasters {
  BasalRaster friction_coefficient, pore_pressure_ratio, cohesion_pa, turbulent_coefficient_m_s2;
  std::string crs;  ///< of those files that have none
  bool operator==(const BasalRasters&) const = default;
};

/// SamosAT's bed: friction that falls with speed and a logarithmic profile's drag; depth_averaged
/// only. Its mu is `friction_coefficient`, its tau_0 `cohesion_pa` of basal.
struct SamosAtSpec {
  Uncertain fluidization_number{0.222};  ///< R_s0
  Uncertain von_karman{0.43};            ///< kappa
  Uncertain roughness_m{0.05};           ///< R
  Uncertain profile_offset{4.13};        ///< B
  bool operator==(const SamosAtSpec&) const = default;
};

struct BasalSpec {
  Uncertain friction_coefficient{0.4};
  Uncertain pore_pressure_ratio{0};
  Uncertain cohesion_pa{0};
  Uncertain restitution{0.2};                           ///< full_stress only
  std::optional<Uncertain> turbulent_coefficient_m_s2;  ///< Voellmy's xi; depth_averaged only
  std::optional<Uncertain> viscosity_pa_s;   ///< laminar drag at the bed; depth_averaged only
  std::optional<Uncertain> yield_stress_pa;  ///< Bingham, with viscosity_pa_s; depth_averaged only
  std::optional<SamosAtSpec> samosat;        ///< absent: Coulomb with the terms above
  BasalRasters rasters;                      ///< a zone's own number goes before a raster's
  std::vector<BasalZone> zones;              ///< where two overlap, the later one holds
  bool operator==(const BasalSpec&) const = default;
};

/// Index of the first zone with a turbulent coefficient of its own.
inline std::optional<std::size_t> zone_with_turbulence(const BasalSpec& basal) {
  for (std::size_t i = 0; i < basal.zones.size(); ++i)
    if (basal.zones[i].turbulent_coefficient_m_s2) return i;
  return std::nullopt;
}

/// A bed that the flow takes along; depth_averaged only. What a law does not know is not given.
struct ErosionSpec {
  ErosionLaw law = ErosionLaw::exponential;
  ErosionSupply supply = ErosionSupply::limited;
  std::optional<Uncertain> depth_m;       ///< vertical, everywhere or inside `polygon`
  std::string polygon;                    ///< any OGR polygon layer: where the bed can be taken
  std::string layer;                      ///< layer name inside `polygon`; empty: the first
  std::string depth_raster;               ///< metres, vertical; nodata means zero
  std::optional<Uncertain> depth_factor;  ///< of `depth_raster`
  std::string crs;                        ///< where polygon or raster has none
  std::optional<Uncertain> bed_density_kg_m3;  ///< bulk; absent: the flow's own
  std::optional<Uncertain> growth_rate_per_m;  ///< E_s of `exponential`
  std::optional<Uncertain> rate_m_s;           ///< of `shear_stress`, as are the next two
  std::optional<Uncertain> depth_per_stress_m_per_kpa, critical_stress_kpa;
  /// Of `momentum_jump`: what the bed itself resists with. The pressure is also what a bed brings
  /// into a mixture; hydrostatic when absent.
  std::optional<Uncertain> bed_friction_coefficient, bed_pore_pressure_ratio;
  std::optional<Uncertain> bed_solid_fraction;  ///< with `mixture`; absent: its critical fraction
  bool operator==(const ErosionSpec&) const = default;
};

struct NumericsSpec {
  double spacing_m = 0;              ///< initial particle spacing dx; 0 = not given (an error)
  std::optional<double> end_time_s;  ///< absent: to rest, see scenarios/assembly/time_cap.hpp
  double courant = 0.25;             ///< dt <= courant h / (c0 + |v|)
  double sound_speed_factor = 10;    ///< c0 = factor * expected flow speed
  bool adaptive_sound_speed =
      true;  ///< c0 follows the flow, see engine/effects/dense/sound_speed.cpp
  double artificial_viscosity = 0.1;  ///< alpha_v of B.4
  double density_diffusion = 0.1;     ///< delta of B.2
  double jitter = 0.05;               ///< of the release lattice, in spacings
  bool stop_at_rest = true;
  double stop_energy_fraction = 0.01;  ///< of the peak kinetic energy
  double max_wall_time_s = 0;          ///< per member; 0 = none
  bool accept_unresolved = false;      ///< run full_stress although under two layers resolve it
  bool operator==(const NumericsSpec&) const = default;
};

struct WallSpec {
  std::array<double, 3> point_m{}, normal{};  ///< normal points into the free side
  double friction_coefficient = 0;
  std::optional<double> remove_at_s;
  WallLiquid liquid = WallLiquid::slips;  ///< where there is `fluid`
  bool operator==(const WallSpec&) const = default;
};

struct DomainSpec {
  std::vector<std::string> periodic;  ///< subset of x, y: the terrain's extent is the period
  std::vector<WallSpec> walls;
  bool operator==(const DomainSpec&) const = default;
};

struct EnsembleSpec {
  Design design = Design::latin_hypercube;
  std::string table;  ///< CSV of a user's design (design: table)
  int members = 0;    ///< 0 = not given
  std::uint64_t seed = 1;
  std::map<std::string, double> correlation;  ///< "path/path" -> Gaussian copula correlation
  double max_failed_fraction = 0.05;
  double max_censored_fraction = 0.05;
  std::optional<Estimator> estimator;  ///< absent: plain
  std::optional<TargetSpec> target;
  std::string levels;        ///< "full_stress 12, depth_averaged 9": cheaper ones; empty: chosen
  std::optional<int> pilot;  ///< members of each level before their numbers are chosen
  bool operator==(const EnsembleSpec&) const = default;
};

struct HazardSpec {
  std::optional<double> cell_size_m;  ///< default: the terrain's working cell
  std::vector<double> thickness_m{0.1, 0.5, 1, 2};
  std::vector<double> speed_m_s{1, 5, 10};
  std::vector<double> energy_kj_m2{10, 100, 1000};
  std::vector<double> pressure_kpa{1, 10, 30};
  std::vector<double> eroded_depth_m{0.1, 0.5, 1, 2};  ///< where the scene has `erosion`
  std::vector<double> quantiles{0.05, 0.5, 0.95};
  std::string observed_polygon;  ///< any OGR polygon layer, drawn over the maps
  std::string observed_note;     ///< what it is, in words
  bool gis_files = true;         ///< write what a GIS opens beside the netCDF file
  bool operator==(const HazardSpec&) const = default;
};

struct Scenario {
  std::string title;
  std::string material;  ///< name of ready-made priors, see scenarios/materials; empty: none
  TerrainSpec terrain;
  ReleaseSpec release;
  std::vector<InflowSpec> inflow;
  std::optional<GrainsSpec> grains;
  std::optional<MixtureSpec> mixture;  ///< absent: dry, or with basal.pore_pressure_ratio
  std::optional<FluidSpec> fluid;      ///< without `grains`: a liquid alone
  std::optional<CouplingSpec> coupling;
  BasalSpec basal;
  std::optional<ErosionSpec> erosion;
  Formulation formulation = Formulation::automatic;
  NumericsSpec numerics;
  DomainSpec domain;
  EnsembleSpec ensemble;
  HazardSpec hazard;
  std::optional<GaugesSpec> gauges;
  std::optional<ObservationSpec> observation;  ///< absent: members are not scored
  std::optional<AssetsSpec> assets;            ///< absent: no table of assets is made
  ReportSpec report;
  std::string directory;  ///< where relative paths of the file start; not a key
  bool operator==(const Scenario&) const = default;
};

}  // namespace sturz
