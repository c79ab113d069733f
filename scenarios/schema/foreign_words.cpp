// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/foreign_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

namespace sturz {
namespace {

struct Entry {
  std::vector<std::string_view> words;
  std::string_view advice;
};

constexpr std::string_view xi =
    "Use basal.turbulent_coefficient_m_s2: Voellmy's xi, in m/s2 (100 to 3000).";
constexpr std::string_view mu =
    "Use basal.friction_coefficient: the tangent of the bed's friction angle.";
constexpr std::string_view yield =
    "Use basal.yield_stress_pa with basal.viscosity_pa_s: a Bingham fluid.";
constexpr std::string_view viscosity = "Use basal.viscosity_pa_s.";
constexpr std::string_view pore =
    "Use basal.pore_pressure_ratio: pore pressure over normal stress.";
constexpr std::string_view density =
    "Use grains.density_kg_m3 and grains.solid_fraction: their product is the bulk density.";
constexpr std::string_view angle = "Use grains.friction_angle_deg.";
constexpr std::string_view erosion = "Use the block erosion: law, growth_rate_per_m, depth_m, ...";
constexpr std::string_view obstacles =
    "Forest is friction: basal.zones or basal.rasters. Dams are terrain.dams, buildings "
    "terrain.buildings.";
constexpr std::string_view secondary =
    "Use release.start_time_attribute: a field of release.polygon with the time of each polygon.";
constexpr std::string_view inflow =
    "Use the list inflow: sources, each with a hydrograph (CSV) and a line or polygon.";
constexpr std::string_view step =
    "The step is found anew each time; numerics.courant makes it shorter.";
constexpr std::string_view end = "Use numerics.end_time_s.";
constexpr std::string_view resolution =
    "Use numerics.spacing_m for particles, terrain.cell_size_m for the ground.";
constexpr std::string_view count = "Use numerics.spacing_m: their number follows from it.";
constexpr std::string_view ground = "Use terrain.raster.";
constexpr std::string_view members = "Use ensemble.members.";

const std::array entries{
    Entry{{"xi", "xi_m_s2", "ksi", "turbulence", "turbulent_friction", "voellmy_xi"}, xi},
    Entry{{"mu", "dry_friction", "coulomb_friction", "voellmy_mu", "bed_friction",
           "bed_friction_angle", "bed_friction_angle_deg", "delta", "delta_deg"},
          mu},
    Entry{{"tau0", "tau0_pa", "tau_0", "tau_y", "tau_y_pa", "tauy", "yield_strength",
           "yield_strength_pa"},
          yield},
    Entry{{"eta", "eta_pa_s", "dynamic_viscosity", "viscosity"}, viscosity},
    Entry{{"ru", "r_u", "pore_pressure", "lambda"}, pore},
    Entry{{"rho", "rho_kg_m3", "bulk_density", "bulk_density_kg_m3"}, density},
    Entry{{"phi", "phi_deg", "internal_friction_angle", "internal_friction_angle_deg"}, angle},
    Entry{{"entrainment", "erosion_rate", "bed_erosion", "snow_cover", "erodible_bed"}, erosion},
    Entry{{"resistance", "forest", "trees", "obstacles", "buildings", "dam", "dams", "barrier"},
          obstacles},
    Entry{{"secondary", "secondary_release", "secondary_releases", "staggered"}, secondary},
    Entry{{"hydrograph", "inflow", "discharge"}, inflow},
    Entry{{"dt", "dt_s", "time_step", "time_step_s", "timestep"}, step},
    Entry{{"t_end", "tend", "t_end_s", "tmax", "duration", "duration_s"}, end},
    Entry{{"resolution", "resolution_m", "cellsize", "mesh_size", "mesh_size_m"}, resolution},
    Entry{{"n_particles", "number_of_particles", "mass_per_particle"}, count},
    Entry{{"dem", "dtm", "topography", "topo"}, ground},
    Entry{{"samples", "n_samples", "n_members", "runs", "n_runs"}, members},
};

}  // namespace

std::string advice_on_foreign_word(const std::string& path) {
  // Words of a bed's drag; a liquid has its own of nearly the same name.
  if (path.starts_with("fluid.")) return {};
  std::string word = path.substr(path.rfind('.') + 1);
  std::transform(word.begin(), word.end(), word.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  for (const Entry& entry : entries)
    if (std::find(entry.words.begin(), entry.words.end(), word) != entry.words.end())
      return std::string(entry.advice);
  return {};
}

}  // namespace sturz
