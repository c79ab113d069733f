// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/output_folder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "scenarios/schema/schema.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// Members without a scenario.yaml beside them: their scene is not known.
void require_no_orphans(const OutputFolder& folder) {
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder.members(), failed))
    require(entry.path().extension() != ".nc",
            fmt::format("{} holds members but no scenario.yaml (they may belong to another scene). "
                        "Choose another folder with --out.",
                        folder.root.string()));
}

void require_only_ours(const OutputFolder& folder) {
  static constexpr std::array ours{"log.txt", "members", "design.csv"};
  for (const auto& entry : fs::directory_iterator(folder.root)) {
    const fs::path name = entry.path().filename();
    const bool mine = name.extension() == ".part" ||
                      std::find(ours.begin(), ours.end(), name.string()) != ours.end();
    require(mine, fmt::format("{} holds files of something else, such as {} (results could "
                              "overwrite them). Choose another folder with --out.",
                              folder.root.string(), name.string()));
  }
}

KeyValue without_file_names(const KeyInfo& key, KeyValue value) {
  for_each_path(key, value, [](std::string& path) { path.clear(); });
  return value;
}

}  // namespace

bool holds_results(const OutputFolder& folder, const std::string& kind) {
  if (!fs::exists(folder.root)) return false;
  require(fs::is_directory(folder.root),
          fmt::format("{} is a file (results need a folder). Choose another name with --out.",
                      folder.root.string()));
  if (fs::exists(folder.manifest())) {
    const std::string found = Manifest::read(folder.manifest()).kind;
    require(found == kind,
            fmt::format("{} holds the results of `sturz {}` (this is `sturz {}`). Choose another "
                        "folder with --out.",
                        folder.root.string(), found, kind));
    if (fs::exists(folder.scenario())) return true;
  } else {
    require_only_ours(folder);
  }
  if (kind == "ensemble") require_no_orphans(folder);
  return false;
}

std::vector<std::string> differences(const Scenario& before, const Scenario& now) {
  std::vector<std::string> found;
  for (const KeyInfo& key : schema()) {
    const bool only_asked = key.path == "title" || key.path == "ensemble.members" ||
                            key.path == "ensemble.max_failed_fraction" ||
                            key.path == "ensemble.max_censored_fraction" ||
                            key.path.starts_with("terrain.window.") ||
                            (key.path.starts_with("hazard.") && key.path != "hazard.cell_size_m");
    if (only_asked || key.kind == ValueKind::path) continue;
    const KeyValue was = key.get(before), is = key.get(now);
    if (without_file_names(key, was) == without_file_names(key, is)) continue;
    const auto text = [](const KeyValue& v) {
      const std::string words = value_text(v);
      return words.empty() ? std::string("absent") : words;
    };
    found.push_back(fmt::format("{}: {} -> {}", key.path, text(was), text(is)));
  }
  return found;
}

std::string default_folder(const std::string& scenario_file) {
  const fs::path file = fs::absolute(scenario_file).lexically_normal();
  const std::string name = file.stem().string() == "scenario"
                               ? file.parent_path().filename().string()
                               : file.stem().string();
  return (fs::path("out") / (name.empty() ? "scene" : name)).string();
}

}  // namespace sturz::workflow
