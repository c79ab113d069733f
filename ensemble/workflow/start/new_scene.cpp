// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/start/new_scene.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/start/scene_text.hpp"
#include "io/site/scene_inputs.hpp"
#include "io/site/start/first_look.hpp"
#include "scenarios/assembly/release_pattern.hpp"
#include "scenarios/assembly/start_checks.hpp"
#include "scenarios/materials/materials.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <numeric>
#include <string_view>
#include <system_error>

namespace sturz::workflow {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view no_publication = "usual range of the field";
constexpr double most_columns = 4000;  ///< more are seldom worth their seconds for a first map

bool has_sources(const Material& m) {
  return std::all_of(m.values.begin(), m.values.end(), [](const MaterialValue& v) {
    return !std::string_view(v.key).starts_with("basal.") || v.source != no_publication;
  });
}

const Material& process_of(const std::string& name) {
  const Material* m = find_material(name);
  const std::vector<std::string> known = process_names();
  const std::string near = nearest_name(name, known);
  require(m != nullptr,
          fmt::format("--process {} (unknown). There are {}.{}", name, comma_separated(known),
                      near.empty() ? "" : " Did you mean " + near + "?"));
  require(
      has_sources(*m),
      fmt::format("--process {} (no publication stands behind its friction). Take one of {}, or "
                  "write `material: {}` into the scenario yourself.",
                  name, comma_separated(known), name));
  return *m;
}

/// A file's full name; what only GDAL understands stays as it is.
std::string full_name(const std::string& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) ? fs::weakly_canonical(file).string() : file;
}

/// The same file, seen from the scenario's folder, which need not be there yet.
std::string from_folder(const std::string& file, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return file;
  const fs::path name = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return name.empty() ? full_name(file) : name.string();
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A file of features, where the ground should be; what cannot be opened is told when it is read.
bool is_layer(const std::string& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) &&
         !look_at_release(file, fs::current_path().string()).is_raster;
}

/// The field of a layer that has one of these names; empty: none.
std::string field_named(const ReleaseFile& file, std::initializer_list<const char*> names) {
  for (const std::string& field : file.number_fields)
    for (const char* name : names)
      if (lower(field) == name) return field;
  return {};
}

/// Numbers that people would write, of one power of ten.
constexpr std::array<double, 9> nice_steps{1, 1.5, 2, 2.5, 3, 4, 5, 6, 8};

double nice_below(double v) {
  const double unit = std::pow(10, std::floor(std::log10(v)));
  double best = unit;
  for (const double step : nice_steps)
    if (step * unit <= v * (1 + 1e-9)) best = step * unit;
  return best;
}

double nice_above(double v) {
  const double unit = std::pow(10, std::floor(std::log10(v)));
  for (const double step : nice_steps)
    if (step * unit >= v * (1 - 1e-9)) return step * unit;
  return 10 * unit;
}

/// What is known of a release once its files are read.
struct Measures {
  double area_m2 = 0, narrow_m = 0, thickness_m = 0, cell_m = 0;
};

Measures measures_of(const Scenario& scenario, const SceneInputs& in) {
  const Raster<double> h = release_thickness(median_scenario(scenario).release, in);
  Measures m;
  m.cell_m = h.grid.cell_m;
  const double volume =
      std::accumulate(h.values.begin(), h.values.end(), 0.0) * m.cell_m * m.cell_m;
  m.area_m2 = in.source_area_m2;
  m.narrow_m = narrow_side(h, in.source_area_m2);
  m.thickness_m = volume / m.area_m2;
  return m;
}

class Writer {
 public:
  explicit Writer(const NewSceneRequest& request)
      : request_(request), process_(process_of(request.process)) {
    draft_.process = &process_;
    draft_.members = request.members;
    draft_.terrain = full_name(request.terrain);
    draft_.crs = request.crs;
    draft_.spacing = {"spacing_m: 10", ""};
    draft_.title = request.title;
    if (draft_.title.empty())
      draft_.title =
          fmt::format("{} from {}", process_.name, fs::path(request.release).stem().string());
    std::replace(draft_.title.begin(), draft_.title.end(), '_', ' ');
  }

  NewScene write() {
    choose_release();
    SceneInputs inputs = load_scene_inputs(scenario());
    if (guesses_thickness_) {
      guess_thickness(inputs.source_area_m2);
      inputs = load_scene_inputs(scenario());
    }
    draft_.about_ground =
        grid_text(inputs.whole.n_cols > 0 ? inputs.whole : inputs.elevation->grid);
    choose_spacing(measures_of(scenario(), inputs));
    NewScene made;
    made.scene = scene_of(file(), {});
    explain_spacing(made.scene.description);
    // Read by full names, because the folder that the others start from may not be there yet.
    draft_.terrain = from_folder(request_.terrain, request_.folder);
    draft_.release.front().text = release_line(from_folder(request_.release, request_.folder));
    made.text = scene_text(draft_);
    made.choices = std::move(choices_);
    return made;
  }

 private:
  std::string release_line(const std::string& name) const {
    return fmt::format("{}: {}", release_key_, quoted(name));
  }
  void choose_release();
  void choose_polygon(const ReleaseFile&);
  void guess_thickness(double area_m2);
  void choose_spacing(const Measures&);
  void explain_spacing(const SceneDescription&);
  ScenarioFile file() const {
    return read_scenario_file_text(scene_text(draft_), "the new scenario", request_.folder);
  }
  Scenario scenario() const { return file().scenario; }

  const NewSceneRequest& request_;
  const Material& process_;
  SceneDraft draft_;
  const char* release_key_ = "polygon";
  bool guesses_thickness_ = false;
  double cell_m_ = 0;
  std::vector<std::string> choices_;
};

void Writer::choose_release() {
  const ReleaseFile file = look_at_release(request_.release, fs::current_path().string());
  if (file.is_raster) {
    require(!is_layer(request_.terrain),
            fmt::format("{} holds polygons and {} cells: they seem to be swapped. First comes the "
                        "elevation raster, then the outline of the mass.",
                        request_.terrain, request_.release));
    require(!request_.thickness_m,
            "--thickness (the release is a raster, which says it). Leave it "
            "out, or give the outline as a polygon.");
    release_key_ = "thickness_raster";
    draft_.release = {
        {release_line(full_name(request_.release)), "in metres, 0 or nodata outside"}};
    if (request_.volume_m3)
      draft_.release.push_back({fmt::format("volume_m3: {}", number_text(*request_.volume_m3)),
                                "the raster's thicknesses are scaled to it"});
  } else {
    draft_.release = {
        {release_line(full_name(request_.release)),
         fmt::format("{} feature{}", file.n_features, file.n_features == 1 ? "" : "s")}};
    choose_polygon(file);
  }
  const bool snow = request_.process.starts_with("snow");
  draft_.release.push_back({snow ? "thickness: normal" : "thickness: vertical",
                            snow
                                ? "at right angles to the slope, as snow is measured; or vertical"
                                : "or normal: measured at right angles to the slope, as for snow"});
  draft_.release.push_back({"surface: bed",
                            "the raster shows the ground without the mass; or "
                            "pre_failure: with it"});
}

void Writer::choose_polygon(const ReleaseFile& file) {
  const std::string name = fs::path(request_.release).filename().string();
  if (request_.thickness_m) {
    const double h = *request_.thickness_m;
    draft_.release.push_back(
        {fmt::format("thickness_m: {}", number_text(h)),
         fmt::format("in the mean; {{uniform: [{}, {}]}} where it is not known",
                     short_number(0.75 * h), short_number(1.25 * h))});
    return;
  }
  if (request_.volume_m3) {
    draft_.release.push_back({fmt::format("volume_m3: {}", number_text(*request_.volume_m3)),
                              "or thickness_m in its place; may be a distribution"});
    return;
  }
  if (const std::string field = field_named(file, {"thickness_m", "thickness", "thick", "depth_m"});
      !field.empty()) {
    draft_.release.push_back({"thickness_attribute: " + quoted(field), "a field of " + name});
    choices_.push_back(fmt::format("thickness from the field {} of {}", field, name));
    return;
  }
  if (const std::string field = field_named(file, {"volume_m3", "volume"}); !field.empty()) {
    draft_.release.push_back({"volume_attribute: " + quoted(field), "a field of " + name});
    choices_.push_back(fmt::format("volume from the field {} of {}", field, name));
    return;
  }
  const bool of_ground = request_.process == "rock_avalanche" || request_.process == "debris_flow";
  require(
      of_ground,
      fmt::format("--process {} (how thick the release is cannot be guessed from its area). Say "
                  "--thickness METRES or --volume M3.",
                  request_.process));
  draft_.release.push_back({"thickness_m: 5", ""});
  guesses_thickness_ = true;
}

/// Guzzetti, Ardizzone, Cardinali, Rossi and Valigi 2009: V = 0.074 A^1.45 of 677 landslides.
void Writer::guess_thickness(double area_m2) {
  const double h = 0.074 * std::pow(area_m2, 0.45);
  const std::string low = short_number(h / 2), high = short_number(2 * h);
  const auto line =
      std::find_if(draft_.release.begin(), draft_.release.end(),
                   [](const SceneDraft::Line& l) { return l.text.starts_with("thickness_m:"); });
  line->text = fmt::format("thickness_m: {{log_uniform: [{}, {}]}}", low, high);
  line->comment = "in the mean; A GUESS from the area: put your own here";
  choices_.push_back(fmt::format(
      "thickness {} to {} m: a guess from the area alone, half to twice V = 0.074 A^1.45 (Guzzetti "
      "and others 2009, from memory). Better: --thickness METRES or --volume M3",
      low, high));
}

void Writer::choose_spacing(const Measures& m) {
  const double coarsest = m.narrow_m / resolved_across;
  double spacing = request_.spacing_m.value_or(0);
  if (!request_.spacing_m) {
    const double finest = std::min(std::sqrt(m.area_m2 / most_columns), coarsest);
    spacing = nice_below(std::clamp(std::min(m.cell_m, m.thickness_m), finest, coarsest));
    if (spacing < finest)
      spacing = nice_above(finest) <= coarsest ? nice_above(finest) : finest * 1.0001;
    spacing = std::strtod(short_number(spacing).c_str(), nullptr);
  }
  draft_.spacing.text = fmt::format("spacing_m: {}", number_text(spacing));
  cell_m_ = m.cell_m;
}

void Writer::explain_spacing(const SceneDescription& d) {
  draft_.spacing.comment =
      fmt::format("{} columns, {:.0f} across the narrow side of {} m (10 are needed)",
                  d.n_particles, d.narrow_side_m / d.spacing_m, short_number(d.narrow_side_m));
  choices_.push_back(fmt::format("spacing {} m: {}; the ground has cells of {} m",
                                 number_text(d.spacing_m), draft_.spacing.comment,
                                 number_text(cell_m_)));
}

}  // namespace

std::vector<std::string> process_names() {
  std::vector<std::string> names;
  for (const Material& m : materials())
    if (has_sources(m)) names.emplace_back(m.name);
  return names;
}

NewScene new_scene(const NewSceneRequest& request) { return Writer(request).write(); }

}  // namespace sturz::workflow
