// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_folder.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/scenario/scenario_file.hpp"
#include "scenarios/schema/value_text.hpp"

#include <fmt/core.h>

#include <cctype>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

fs::path failure_file(const OutputFolder& region, const std::string& source) {
  return region.root / "failed" / (source_file_name(source) + ".txt");
}

}  // namespace

std::string source_file_name(const std::string& source) {
  std::string name;
  for (const char c : source) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = byte < 128 && (std::isalnum(byte) != 0 || c == '-' || c == '_' ||
                                     (c == '.' && !name.empty()));
    name += kept ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  require(
      !name.empty() && name.size() <= 200,
      fmt::format("feature '{}': its name is {} to name a folder. Use another "
                  "release.feature_key, or none for the features' numbers.",
                  source.substr(0, 40), name.empty() ? "empty, which is too short" : "too long"));
  return name;
}

OutputFolder source_folder(const OutputFolder& region, const std::string& source) {
  return {region.root / "features" / source_file_name(source)};
}

fs::path sources_csv(const OutputFolder& region) { return region.root / "sources.csv"; }

std::optional<std::string> failure_of(const OutputFolder& region, const std::string& source) {
  const fs::path file = failure_file(region, source);
  if (!fs::exists(file)) return std::nullopt;
  std::string reason = read_text(file);
  while (reason.ends_with('\n')) reason.pop_back();
  return reason;
}

void keep_failure(const OutputFolder& region, const std::string& source,
                  const std::string& reason) {
  const fs::path file = failure_file(region, source);
  if (reason.empty()) {
    std::error_code ignored;
    // The folder stays, were it empty: another source may be about to write into it.
    fs::remove(file, ignored);
    return;
  }
  make_folder(file.parent_path());
  write_text_atomic(file, reason + "\n");
}

bool is_region(const SceneRequest& request) {
  return read_scenario(request.file, request.overrides).release.each_feature;
}

bool is_region(const fs::path& folder) {
  const fs::path manifest = OutputFolder{folder}.manifest();
  return fs::exists(manifest) && Manifest::read(manifest).kind == "region";
}

SceneRequest source_scene(const SceneRequest& region, const std::string& source) {
  SceneRequest scene = region;
  scene.overrides.emplace_back("release.each_feature=false");
  scene.overrides.push_back("release.feature=" + quoted_text(source));
  scene.predicts = false;
  return scene;
}

}  // namespace sturz::workflow
