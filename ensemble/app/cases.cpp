// SPDX-License-Identifier: Apache-2.0
// sturz cases: list the shipped cases, or copy one to where it can be run and changed.
#include "engine/core/error.hpp"
#include "ensemble/app/commands.hpp"
#include "ensemble/app/console/json_text.hpp"
#include "ensemble/app/exit_codes.hpp"
#include "ensemble/app/grammar.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace sturz::app {
namespace fs = std::filesystem;
namespace {

struct Options {
  std::string name;  ///< empty: list them
  std::string out;   ///< folder of the copy; empty: the case's name, here
};

/// Seen from the program itself, so that an installation may be moved; a build folder has a link
/// in the same place.
fs::path cases_folder() {
  std::error_code problem;
  const fs::path program = fs::read_symlink("/proc/self/exe", problem);
  require(!problem, "Cannot tell where the program lies (/proc/self/exe: " + problem.message() +
                        "), and the shipped cases lie beside it. Is /proc mounted?");
  fs::path folder = program.parent_path().parent_path() / "share/sturz/cases";
  require(fs::is_directory(folder, problem),
          fmt::format("{} (no such folder: the shipped cases are not beside this program). "
                      "Install it with `cmake --install`.",
                      folder.string()));
  return folder;
}

std::vector<std::string> case_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "scenario.yaml"))
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void list_cases(const fs::path& folder, Console& console) {
  const std::vector<std::string> names = case_names(folder);
  std::size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());
  for (const std::string& name : names) {
    const std::string title = read_scenario(folder / name / "scenario.yaml").title;
    // Two leading spaces tell the completion which lines are cases.
    console.say("  " + name + std::string(width - name.size() + 2, ' ') + title);
    const nlohmann::ordered_json event = {{"event", "case"}, {"name", name}, {"title", title}};
    console.event(json_text(event));
  }
  console.say("Copy one into a folder of yours: sturz cases NAME -o DIR");
}

void copy_case(const fs::path& source, const fs::path& target, Console& console) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const fs::path copy = target / file.filename();
    std::error_code ignored;
    require(!fs::exists(fs::symlink_status(copy, ignored)),
            fmt::format("{} (is there already and may hold your changes). Name another folder "
                        "with -o.",
                        copy.string()));
  }
  make_folder(target);
  for (const fs::path& file : files) write_text_atomic(target / file.filename(), read_text(file));
  const std::string scenario = (target / "scenario.yaml").string();
  console.say(fmt::format("{}\nNext: sturz describe {}", scenario, scenario));
  const nlohmann::ordered_json event = {{"event", "done"}, {"scenario", scenario}};
  console.event(json_text(event));
}

int cases(const Options& options, Console& console) {
  const fs::path folder = cases_folder();
  if (options.name.empty()) {
    require(options.out.empty(),
            "-o (without the name of a case). Say which: sturz cases NAME -o DIR");
    list_cases(folder, console);
    return ok;
  }
  const std::vector<std::string> names = case_names(folder);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  if (std::find(names.begin(), names.end(), options.name) == names.end()) {
    const std::string near = nearest_name(options.name, names);
    throw SetupError(fmt::format("{} (no shipped case). There are: {}.{}", options.name, all,
                                 near.empty() ? "" : fmt::format(" Did you mean {}?", near)));
  }
  copy_case(folder / options.name, options.out.empty() ? options.name : options.out, console);
  return ok;
}

}  // namespace

void add_cases(Grammar& grammar) {
  auto [parser, options] =
      add_command(grammar, "cases", "List the shipped cases, or copy one to start from", cases);
  parser.add_option("name", options.name, "Case to copy; without one they are listed")
      ->type_name("CASE");
  parser.add_option("-o,--out", options.out, "Folder of the copy (default: ./NAME)")
      ->type_name("DIR");
  add_json(grammar, parser);
}

}  // namespace sturz::app
