// SPDX-License-Identifier: Apache-2.0
// Which keys of `erosion` go together, and which law knows them.
#include "scenarios/checks/combination_checks.hpp"
#include "scenarios/schema/value_text.hpp"

#include <string>
#include <variant>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

class Check {
 public:
  Check(const Scenario& s, Problems& problems) : s_(s), e_(*s.erosion), problems_(problems) {}

  void all() {
    if (s_.formulation == Formulation::full_stress)
      add("erosion",
          "erosion (formulation is full_stress; only depth_averaged takes its bed along). Remove "
          "it "
          "or set formulation: depth_averaged.");
    laws();
    mixture();
    supply();
  }

 private:
  void add(const std::string& path, std::string text) {
    problems_.push_back({path, std::move(text)});
  }
  bool given(const std::string& path) const {
    return !std::holds_alternative<std::monostate>(find_key(path)->get(s_));
  }
  /// A key that only one law knows.
  void belongs(const char* path, ErosionLaw law) {
    if (e_.law == law || !given(path)) return;
    add(path, std::string(path) + " = " + value_text(find_key(path)->get(s_)) +
                  " (erosion.law is " + std::string(to_string(e_.law)) + "; only " +
                  std::string(to_string(law)) + " knows it). Remove it or change the law.");
  }
  void needs(const char* path, const char* what) {
    if (!given(path))
      add(path, std::string(path) + " (missing; erosion.law: " + std::string(to_string(e_.law)) +
                    " needs it). Give " + what + ".");
  }

  void laws() {
    using enum ErosionLaw;
    belongs("erosion.growth_rate_per_m", exponential);
    for (const char* path :
         {"erosion.rate_m_s", "erosion.depth_per_stress_m_per_kpa", "erosion.critical_stress_kpa"})
      belongs(path, shear_stress);
    belongs("erosion.bed_friction_coefficient", momentum_jump);
    if (!s_.mixture) belongs("erosion.bed_pore_pressure_ratio", momentum_jump);
    if (e_.law == exponential)
      needs("erosion.growth_rate_per_m", "ln(V_f/V_0) over the length of the path, e.g. 0.001 1/m");
    if (e_.law == momentum_jump) {
      needs("erosion.bed_friction_coefficient", "the friction coefficient inside the bed");
      needs("erosion.bed_pore_pressure_ratio",
            "its pore pressure over the normal stress, 1 for a liquefied bed");
    }
  }

  void mixture() {
    if (s_.mixture && e_.bed_density_kg_m3)
      add("erosion.bed_density_kg_m3",
          "erosion.bed_density_kg_m3 (mixture is there too: the density of a saturated bed follows "
          "from its grains). Use erosion.bed_solid_fraction.");
    if (!s_.mixture && e_.bed_solid_fraction)
      add("erosion.bed_solid_fraction",
          "erosion.bed_solid_fraction (there is no mixture that it would join). Use "
          "erosion.bed_density_kg_m3.");
  }

  void supply() {
    const bool depth = e_.depth_m.has_value(), raster = !e_.depth_raster.empty();
    if (e_.supply == ErosionSupply::unlimited) {
      for (const char* path : {"erosion.depth_m", "erosion.depth_raster"})
        if (given(path))
          add(path, std::string(path) + " (erosion.supply is unlimited). Remove one of the two.");
      if (e_.law == ErosionLaw::momentum_jump)
        add("erosion.supply",
            "erosion.supply = unlimited (erosion.law is momentum_jump, whose rate grows without "
            "bound "
            "where the flow is slow). Give depth_m or depth_raster.");
    } else if (!depth && !raster) {
      add("erosion.depth_m",
          "erosion.depth_m (missing: nothing says how much bed there is). Give depth_m in metres, "
          "a "
          "depth_raster, or supply: unlimited.");
    } else if (depth && raster) {
      add("erosion.depth_raster",
          "erosion.depth_raster (erosion.depth_m is there too). Keep one of them.");
    }
    if (raster && !e_.polygon.empty())
      add("erosion.polygon",
          "erosion.polygon (erosion.depth_raster says where the bed can be taken already). Keep "
          "one "
          "of them.");
    if (e_.depth_factor && !raster)
      add("erosion.depth_factor",
          "erosion.depth_factor (there is no erosion.depth_raster that it could multiply). Remove "
          "it.");
    if (!e_.layer.empty() && e_.polygon.empty())
      add("erosion.layer",
          "erosion.layer (there is no erosion.polygon). Remove it or name the file.");
    if (!e_.crs.empty() && e_.polygon.empty() && !raster)
      add("erosion.crs", "erosion.crs (there is no file that it is for). Remove it.");
  }

  const Scenario& s_;
  const ErosionSpec& e_;
  Problems& problems_;
};

}  // namespace

void check_erosion(const Scenario& s, Problems& problems) {
  if (s.erosion) Check(s, problems).all();
}

}  // namespace sturz
