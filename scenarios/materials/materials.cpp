// SPDX-License-Identifier: Apache-2.0
#include "scenarios/materials/materials.hpp"

#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace sturz {
namespace {

constexpr const char* friction = "basal.friction_coefficient";
constexpr const char* xi = "basal.turbulent_coefficient_m_s2";
constexpr const char* shear_stress = "basal.cohesion_pa";
constexpr const char* density = "grains.density_kg_m3";
constexpr const char* fraction = "grains.solid_fraction";

constexpr const char* usual = "usual range of the field";

// Ranges of back-calculated events with the value that authors recommend as the mode. Friction and
// xi of one process come from one source, because they trade off against each other.
const std::array all{
    Material{"rock_avalanche",
             "large failures of rock that run as a dry, fragmented mass",
             {{density, "{uniform: [2500, 2800]}", usual, false},
              {fraction, "{uniform: [0.55, 0.65]}", usual, false},
              {friction, "{triangular: [0.03, 0.1, 0.25]}", "Hungr and Evans 1996", false},
              {xi, "{triangular: [100, 500, 1000]}", "Hungr and Evans 1996", false}}},
    Material{"debris_flow",
             "granular debris with its water, as one material",
             {{density, "2650", usual, false},
              {fraction, "{uniform: [0.5, 0.7]}", usual, false},
              {friction, "{triangular: [0.05, 0.15, 0.25]}", "Rickenmann and others 2006", false},
              {xi, "{triangular: [100, 200, 500]}", "Rickenmann and others 2006", false}}},
    Material{"mud_flow",
             "fine-grained debris flows: less dry friction, less turbulent drag",
             {{density, "2650", usual, false},
              {fraction, "{uniform: [0.4, 0.6]}", usual, false},
              {friction, "{triangular: [0.03, 0.07, 0.15]}", "Schraml and others 2015", false},
              {xi, "{triangular: [200, 500, 1000]}", "Schraml and others 2015", false}}},
    Material{
        "snow_dense",
        "large dry dense-flow snow avalanches",
        {{density, "917", "ice", true},
         {fraction, "{uniform: [0.22, 0.44]}", usual, false},
         {friction, "{triangular: [0.15, 0.155, 0.3]}",
          "Martinelli and others 1980 (0.15), Buser and Frutiger 1980 (0.155); upper end Salm and "
          "others 1990",
          false},
         {xi, "{uniform: [1200, 1600]}", "Martinelli and others 1980", true},
         {shear_stress, "{uniform: [0, 100]}",
          "RAMMS, background information of the program's site: dry snow", true}}},
    Material{"snow_wet",
             "wet or small dense-flow snow avalanches",
             {{density, "917", "ice", true},
              {fraction, "{uniform: [0.33, 0.5]}", usual, false},
              {friction, "{uniform: [0.25, 0.4]}", "Salm and others 1990", false},
              {xi, "{uniform: [700, 800]}", "Martinelli and others 1980", true},
              {shear_stress, "{uniform: [100, 300]}",
               "RAMMS, background information of the program's site: wet snow", true}}},
    Material{"lahar",
             "volcanic debris flows, rich in water",
             {{density, "2500", usual, false},
              {fraction, "{uniform: [0.35, 0.6]}", usual, false},
              {friction, "{triangular: [0.02, 0.05, 0.15]}", usual, false},
              {xi, "{triangular: [200, 500, 1500]}", usual, false}}},
};

}  // namespace

std::span<const Material> materials() { return all; }

const Material* find_material(const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Material& m) { return name == m.name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const Material& material : all) names.emplace_back(material.name);
  return names;
}

std::vector<std::string> material_notes(const Scenario& scenario) {
  const Material* material = find_material(scenario.material);
  std::vector<std::string> notes;
  if (!material) return notes;
  for (const MaterialValue& value : material->values) {
    const std::string is = value_text(find_key(value.key)->get(scenario));
    std::string note = std::string("material ") + material->name + ": " + value.key + " = " + is;
    if (is != value.value)
      note += std::string(" (yours; the material's is ") + value.value + ", " + value.source + ")";
    else
      note += std::string(" (") + value.source +
              (value.checked ? ")" : "; from memory, look it up before you quote it)");
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace sturz
