// SPDX-License-Identifier: Apache-2.0
// sturz terrain: write a synthetic ground, or the ground and source of a scenario, as GeoTIFF.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "io/files/atomic_file.hpp"
#include "io/gdal/cog.hpp"
#include "io/scenario/scenario_file.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/schema/number_text.hpp"
#include "scenarios/schema/suggest.hpp"
#include "scenarios/shapes/synthetic_terrain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace sturz::app {
namespace fs = std::filesystem;
namespace {

struct Options {
  std::string what;  ///< a synthetic shape or a scenario file
  std::string out;   ///< folder
  std::optional<double> cell_size_m;
  std::vector<std::string> set;  ///< shape's "parameter=value", or scenario keys
};

/// "slope_deg=20" into the shape's parameters; names are checked by make_synthetic.
void set_parameter(SyntheticTerrain& shape, const std::string& word) {
  const std::size_t equals = std::min(word.find('='), word.size());
  const auto number =
      parse_number(std::string_view(word).substr(std::min(equals + 1, word.size())));
  require(number.has_value(), fmt::format("--set {} (must be parameter=number).", word));
  const std::string name = word.substr(0, equals);
  if (name == "cell_size_m")
    shape.cell_size_m = *number;
  else
    shape.parameters[name] = *number;
}

void write_raster(const fs::path& file, const Raster<double>& raster, bool synthetic,
                  const std::string& what, Console& console) {
  TextPairs metadata = {{"DESCRIPTION", what}};
  if (synthetic) metadata.emplace_back("SYNTHETIC", "YES");
  write_geotiff(file, raster, metadata);
  console.say(fmt::format("{}: {} x {} cells of {} m, {}", file.string(), raster.grid.n_cols,
                          raster.grid.n_rows, raster.grid.cell_m, what));
}

void write_shape(const Options& options, Console& console) {
  SyntheticTerrain shape;
  shape.shape = options.what;
  for (const std::string& word : options.set) set_parameter(shape, word);
  if (options.cell_size_m) shape.cell_size_m = *options.cell_size_m;
  const SyntheticScene scene = make_synthetic(shape);
  make_folder(options.out);
  const fs::path folder = options.out;
  write_raster(folder / "elevation.tif", scene.bed, true, "elevation of the bed [m]", console);
  if (scene.thickness)
    write_raster(folder / "release.tif", *scene.thickness, true, "thickness of the source [m]",
                 console);
}

/// The release on the cells of the elevation beside it.
Raster<double> beside(const Raster<double>& elevation, const Raster<double>& release) {
  Raster<double> out(elevation.grid, 0.0);
  const Window at = window_of(release.grid, elevation.grid);
  for (int r = 0; r < at.n_rows; ++r)
    for (int c = 0; c < at.n_cols; ++c)
      if (elevation.grid.contains(at.row0 + r, at.col0 + c))
        out.at(at.row0 + r, at.col0 + c) = release.at(r, c);
  return out;
}

void write_scene(const Options& options, Console& console) {
  require(!options.cell_size_m,
          "--cell is for shapes (a scenario says terrain.cell_size_m). Use --set instead.");
  const Scenario scenario = read_scenario(options.what, options.set);
  const SceneInputs inputs = load_scene_inputs(scenario);
  const bool synthetic = scenario.terrain.synthetic.has_value();
  make_folder(options.out);
  const fs::path folder = options.out;
  write_raster(folder / "elevation.tif", *inputs.elevation, synthetic,
               "elevation on the working grid [m]", console);
  const bool cover = inputs.pattern == ReleasePattern::cover;
  write_raster(
      folder / "release.tif", beside(*inputs.elevation, *inputs.release), synthetic,
      cover ? "share of each cell that the source covers [-]" : "thickness of the source [m]",
      console);
  for (const std::string& note : inputs.notes) console.say("note: " + note);
  for (const std::string& warning : inputs.warnings) console.warn(warning);
}

int terrain(const Options& options, Console& console) {
  const std::vector<std::string> shapes = synthetic_shapes();
  if (std::find(shapes.begin(), shapes.end(), options.what) != shapes.end()) {
    write_shape(options, console);
    return ok;
  }
  std::string names;
  for (const std::string& shape : shapes) names += (names.empty() ? "" : ", ") + shape;
  const std::string near = nearest_name(options.what, shapes);
  require(fs::exists(options.what),
          fmt::format("{} (neither a shape nor a scenario file). Shapes are: {}.{}", options.what,
                      names, near.empty() ? "" : fmt::format(" Did you mean {}?", near)));
  write_scene(options, console);
  return ok;
}

}  // namespace

void add_terrain(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "terrain",
      "Write the terrain and release of a synthetic shape or scenario as GeoTIFF", terrain);
  parser.add_option("what", options.what, "Name of a shape, or a scenario file")
      ->type_name("SHAPE|SCENARIO")
      ->required();
  parser.add_option("-o,--out", options.out, "Folder for the rasters")
      ->type_name("DIR")
      ->required();
  parser.add_option("--cell", options.cell_size_m, "Cell size of a shape [m]")
      ->check(CLI::PositiveNumber);
  add_set(parser, options.set, "A shape's parameter=value, or a scenario's key=value");
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
