// SPDX-License-Identifier: Apache-2.0
// sturz init: a commented scenario around an elevation raster and a release.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "ensemble/workflow/readable.hpp"
#include "ensemble/workflow/start/new_scene.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <system_error>

namespace sturz::app {
namespace fs = std::filesystem;
namespace {

struct Options {
  workflow::NewSceneRequest scene;
  std::string out;  ///< scenario file or folder
};

/// -o names the file where it ends in .yaml, else the folder that will hold scenario.yaml.
fs::path file_of(const std::string& out) {
  const fs::path path = out;
  if (path.extension() == ".yaml" || path.extension() == ".yml") return path;
  return path / "scenario.yaml";
}

void say_scene(const workflow::NewScene& made, const fs::path& file, Console& console) {
  const SceneDescription& d = made.scene.description;
  console.say(fmt::format(
      "release: {} m3 on {} m2, {:.1f} m thick in the mean", workflow::grouped(d.release_volume_m3),
      workflow::grouped(d.release_area_m2), d.release_volume_m3 / d.release_area_m2));
  for (const std::string& choice : made.choices) console.say(choice);
  for (const std::string& note : made.scene.inputs.notes) console.say("note: " + note);
  for (const std::string& warning : d.warnings) console.warn(warning);
  const std::string name = file.string();
  console.say(
      fmt::format("Wrote {}. Next:\n"
                  "  sturz describe {}    what will be computed, how long it takes\n"
                  "  sturz run {}         one member, medians\n"
                  "  sturz ensemble {}    the map",
                  name, name, name, name));
}

int init(const Options& options, Console& console) {
  const fs::path file = file_of(options.out);
  std::error_code ignored;
  require(!fs::exists(fs::symlink_status(file, ignored)),
          fmt::format("{} (is there already and may hold your changes). Name another folder or "
                      "file with -o.",
                      file.string()));
  workflow::NewSceneRequest request = options.scene;
  request.folder = fs::absolute(file).parent_path();
  workflow::NewScene made;
  try {
    made = workflow::new_scene(request);
  } catch (const SetupError& problem) {
    const std::string words = problem.what();
    if (request.crs.empty() && words.find("terrain.crs") != std::string::npos)
      throw SetupError(words + "\nHere: sturz init ... --crs EPSG:CODE.");
    throw;
  }
  make_folder(request.folder);
  write_text_atomic(file, made.text);
  say_scene(made, file, console);
  const SceneDescription& d = made.scene.description;
  const nlohmann::ordered_json done = {{"event", "done"},
                                       {"scenario", file.string()},
                                       {"spacing_m", d.spacing_m},
                                       {"release_volume_m3", d.release_volume_m3},
                                       {"release_area_m2", d.release_area_m2},
                                       {"choices", made.choices},
                                       {"notes", made.scene.inputs.notes}};
  console.event(json_text(done));
  return ok;
}

std::string process_list() {
  std::string text;
  for (const std::string& name : workflow::process_names())
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

void add_init(Grammar& grammar) {
  auto [parser, options] = add_command(
      grammar, "init", "Write a scenario around your elevation raster and release", init);
  workflow::NewSceneRequest& s = options.scene;
  parser.add_option("terrain", s.terrain, "Elevation raster (any that GDAL reads)")
      ->type_name("FILE")
      ->required();
  parser
      .add_option("release", s.release, "Outline of the mass (polygon layer), or thickness raster")
      ->type_name("FILE")
      ->required();
  parser.add_option("-o,--out", options.out, "Folder of scenario.yaml, or its name.yaml")
      ->type_name("DIR")
      ->required();
  parser.add_option("--process", s.process, fmt::format("Typical values of: {}", process_list()))
      ->type_name("PROCESS")
      ->capture_default_str();
  CLI::Option* const thickness =
      parser.add_option("--thickness", s.thickness_m, "Mean thickness of the release [m]");
  thickness->check(CLI::PositiveNumber);
  parser.add_option("--volume", s.volume_m3, "Volume of the release [m3]")
      ->check(CLI::PositiveNumber)
      ->excludes(thickness);
  parser.add_option("--spacing", s.spacing_m, "Distance of columns [m]; else picked")
      ->check(CLI::PositiveNumber);
  parser.add_option("--crs", s.crs, "Coordinate system of a raster without one, or `local`");
  parser.add_option("--title", s.title, "Title of the scenario");
  parser.add_option("-n,--members", s.members, "Members of the ensemble")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  add_remote(parser);
  add_json(grammar, parser);
}

}  // namespace sturz::app
