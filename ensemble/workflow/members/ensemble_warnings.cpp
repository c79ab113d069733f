// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/ensemble_warnings.hpp"

#include "ensemble/workflow/folder/saved_design.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/checks/idle_keys.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz::workflow {
namespace {

using Warnings = std::vector<std::string>;

/// Values of a key over the members, [n_members]; its fixed number where it was not drawn.
std::vector<double> drawn(const DesignTable& design, const char* key, double otherwise) {
  std::vector<double> values(design.values.size(), otherwise);
  const auto found = std::find(design.keys.begin(), design.keys.end(), key);
  if (found == design.keys.end()) return values;
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = design.values[i][static_cast<std::size_t>(found - design.keys.begin())];
  return values;
}

void warn_of_copies(const Scene& scene, const DesignTable& design, Warnings& out) {
  if (design.n_members() < 2 || !uncertain_keys(scene.scenario).empty()) return;
  out.push_back(fmt::format(
      "nothing is uncertain: {} members are one and the same scene and differ by the jitter of "
      "their start lattice only. Probabilities and bounds of the maps say nothing. Give a key a "
      "distribution, such as basal.friction_coefficient: {{uniform: [0.2, 0.4]}}, or use sturz run",
      design.n_members()));
}

void warn_of_idle_draws(const Scene& scene, Warnings& out) {
  const bool columns = scene.description.formulation == to_string(Formulation::depth_averaged);
  std::vector<std::string> idle;
  for (const std::string& path :
       idle_keys(scene.scenario, columns, scene.description.friction_inside))
    for (const UncertainKey& key : uncertain_keys(scene.scenario))
      if (key.path == path) idle.push_back(path);
  if (!idle.empty())
    out.push_back(fmt::format("drawn but without effect in {}: {}", scene.description.formulation,
                              comma_separated(idle)));
}

void warn_of_unused_rows(const Scene& scene, const DesignTable& design, Warnings& out) {
  if (scene.scenario.ensemble.design != Design::table) return;
  const std::int64_t rows = rows_of_table(scene.scenario);
  if (rows > design.n_members())
    out.push_back(fmt::format(
        "ensemble.table = {}: {} of its {} rows are used, because ensemble.members is {}",
        scene.scenario.ensemble.table, design.n_members(), rows, design.n_members()));
}

/// What was found without a value may lie elsewhere beside it.
void warn_of_prior_columns(const Scene& scene, Warnings& out) {
  const std::vector<std::string> keys = keys_from_prior(scene.scenario);
  if (keys.empty()) return;
  out.push_back(fmt::format(
      "drawn from {} own distribution{}, independently of the rest: {}. The posterior in "
      "ensemble.table = {} says nothing of {}, and was found while {} one number",
      keys.size() == 1 ? "its" : "their", keys.size() == 1 ? "" : "s", comma_separated(keys),
      scene.scenario.ensemble.table, keys.size() == 1 ? "it" : "them",
      keys.size() == 1 ? "it was" : "each was"));
}

/// Release thickness of each member over that of the medians.
std::vector<double> thickness_scales(const Scene& scene, const DesignTable& design) {
  const ReleaseSpec& r = scene.medians.release;
  const bool by_volume = r.volume_m3.has_value();
  const double median = by_volume ? r.volume_m3->value : r.thickness_m ? r.thickness_m->value : 1;
  std::vector<double> scales =
      drawn(design, by_volume ? "release.volume_m3" : "release.thickness_m", median);
  for (double& s : scales) s /= median;
  return scales;
}

/// Layers that resolve each member, by the rules of choose_formulation.
struct Layers {
  std::vector<double> release, least;
};
Layers layers_of(const Scene& scene, const DesignTable& design) {
  const SceneDescription& d = scene.description;
  const bool confined =
      !scene.scenario.domain.walls.empty() || !scene.scenario.domain.periodic.empty();
  const double deposit = confined
                             ? std::numeric_limits<double>::infinity()
                             : std::cbrt(d.release_volume_m3) / area_over_volume23 / d.spacing_m;
  Layers layers;
  for (const double scale : thickness_scales(scene, design)) {
    layers.release.push_back(d.layers * scale);
    layers.least.push_back(std::min(d.layers * scale, deposit * std::cbrt(scale)));
  }
  return layers;
}

std::int64_t count_below(const std::vector<double>& values, double limit) {
  return std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; });
}

void warn_of_layers(const Scene& scene, const DesignTable& design, Warnings& out) {
  const Scenario& s = scene.scenario;
  const Layers layers = layers_of(scene, design);
  const std::int64_t n = design.n_members(), thin = count_below(layers.least, resolved_layers);
  if (n < 2) return;
  if (s.formulation == Formulation::automatic && has_both_formulations(s) && thin > 0 && thin < n)
    out.push_back(
        fmt::format("formulation: auto computes members unlike: {} of {} have fewer than 4 layers "
                    "and are columns, the others may be full_stress, and jump against them. Name "
                    "one formulation",
                    thin, n));
  if (s.formulation != Formulation::full_stress && !s.fluid) return;
  const auto thinnest = std::min_element(layers.release.begin(), layers.release.end());
  if (const auto refused = count_below(layers.release, unresolved_layers);
      refused > 0 && !s.numerics.accept_unresolved)
    out.push_back(fmt::format(
        "{} of {} members will fail: the thinnest release has {} layers of particles, "
        "fewer than 2. Use a smaller numerics.spacing_m, {}or "
        "numerics.accept_unresolved",
        refused, n, short_number(*thinnest), s.fluid ? "" : "formulation: depth_averaged, "));
  else if (*thinnest < resolved_layers && scene.description.layers >= resolved_layers)
    out.push_back(
        fmt::format("thin members: {} of {} have releases of fewer than 4 layers, the "
                    "thinnest {}, although the median has {}",
                    count_below(layers.release, resolved_layers), n, short_number(*thinnest),
                    short_number(scene.description.layers)));
}

void warn_of_no_brake(const Scene& scene, const DesignTable& design, Warnings& out) {
  const BasalSpec& b = scene.medians.basal;
  if (b.turbulent_coefficient_m_s2 || b.viscosity_pa_s) return;
  constexpr double hardly = 0.02;  // one degree
  std::vector<double> friction =
      drawn(design, "basal.friction_coefficient", b.friction_coefficient.value);
  const std::vector<double> pressure =
      drawn(design, "basal.pore_pressure_ratio", b.pore_pressure_ratio.value);
  for (std::size_t i = 0; i < friction.size(); ++i) friction[i] *= 1 - pressure[i];
  if (const auto n = count_below(friction, hardly); n > 0)
    out.push_back(fmt::format(
        "hardly anything brakes {} of {} members: friction_coefficient x (1 - pore_pressure_ratio) "
        "of the bed falls to {}, under 0.02. They run to the edge of the terrain or to the end "
        "time",
        n, friction.size(), short_number(*std::min_element(friction.begin(), friction.end()))));
}

}  // namespace

Warnings ensemble_warnings(const Scene& scene, const DesignTable& design) {
  Warnings out;
  warn_of_copies(scene, design, out);
  warn_of_idle_draws(scene, out);
  warn_of_unused_rows(scene, design, out);
  warn_of_prior_columns(scene, out);
  warn_of_layers(scene, design, out);
  warn_of_no_brake(scene, design, out);
  return out;
}

}  // namespace sturz::workflow
