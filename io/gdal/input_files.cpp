// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/input_files.hpp"

#include "engine/core/error.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace sturz {
namespace fs = std::filesystem;
namespace {

std::string suggestion(const fs::path& missing) {
  const fs::path folder = missing.parent_path().empty() ? fs::path(".") : missing.parent_path();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return fmt::format("The folder {} does not exist either.", folder.string());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());  // folders have no order of their own
  const std::string best = nearest_name(missing.filename().string(), names);
  if (best.empty()) return "Relative paths start at the scenario file's folder.";
  return fmt::format("Did you mean '{}'?", best);
}

bool is_gdal_name(const std::string& text) {
  return text.rfind("/vsi", 0) == 0 || text.find(':') != std::string::npos;
}

}  // namespace

InputFile find_input(const std::string& key, const std::string& written,
                     const std::string& directory) {
  const std::string label = key + " = " + written;
  require(!written.empty(), key + " is empty (a file name was expected). Name the file.");
  fs::path path(written);
  if (path.is_relative() && !directory.empty()) path = fs::path(directory) / path;
  std::error_code error;
  if (fs::exists(path, error)) return {path.string(), label};
  if (is_gdal_name(written)) return {written, label};
  throw SetupError(
      fmt::format("{}: no such file (looked for {}). {}", label, path.string(), suggestion(path)));
}

}  // namespace sturz
