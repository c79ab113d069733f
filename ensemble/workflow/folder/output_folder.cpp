// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/folder/output_folder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/manifest.hpp"

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
    require(entry.path().extension() != ".nc" && entry.path().extension() != ".pack",
            fmt::format("{} holds members but no scenario.yaml (they may belong to another scene). "
                        "Choose another folder with --out.",
                        folder.root.string()));
}

void require_only_ours(const OutputFolder& folder) {
  static constexpr std::array ours{"log.txt", "members", "design.csv"};
  for (const auto& entry : fs::directory_iterator(folder.root)) {
    const fs::path name = entry.path().filename();
    const bool mine = name.extension() == ".part" || name.string().starts_with("lock.json") ||
                      name.string().starts_with("lock_") ||
                      std::find(ours.begin(), ours.end(), name.string()) != ours.end();
    require(mine, fmt::format("{} holds files of something else, such as {} (results could "
                              "overwrite them). Choose another folder with --out.",
                              folder.root.string(), name.string()));
  }
}

}  // namespace

bool holds_results(const OutputFolder& folder, const std::string& kind) {
  std::error_code problem;
  if (!fs::exists(fs::status(folder.root, problem))) {
    require(!problem || problem == std::errc::no_such_file_or_directory,
            fmt::format("{}: {}. Choose another folder with --out.", folder.root.string(),
                        problem.message()));
    return false;
  }
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

std::string default_folder(const std::string& scenario_file) {
  const fs::path file = fs::absolute(scenario_file).lexically_normal();
  const std::string name = file.stem().string() == "scenario"
                               ? file.parent_path().filename().string()
                               : file.stem().string();
  return (fs::path("out") / (name.empty() ? "scene" : name)).string();
}

}  // namespace sturz::workflow
