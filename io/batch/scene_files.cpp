// SPDX-License-Identifier: Apache-2.0
#include "io/batch/scene_files.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "scenarios/schema/schema.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace sturz {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> named_files(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const KeyInfo& key : schema()) {
    KeyValue value = key.get(scenario);
    for_each_path(key, value, [&](std::string& path) {
      if (!path.empty())
        names.push_back(fs::absolute(fs::path(scenario.directory) / path).string());
    });
  }
  return names;
}

/// "dem.tif", "dem.tif.aux.xml" and "dem.prj" of "dem.tif"; all files of a folder.
void add_neighbours(const fs::path& file, std::set<std::string>& files) {
  std::error_code failed;
  const bool folder = fs::is_directory(file, failed);
  const std::string name = file.filename().string();
  const std::string stem = name.substr(0, name.find('.', 1)) + ".";
  const fs::path where = folder ? file : file.parent_path();
  for (const auto& entry : fs::directory_iterator(where.empty() ? "." : where, failed))
    if (folder || entry.path().filename().string().starts_with(stem))
      files.insert(entry.path().string());
  files.insert(file.string());
}

/// What the library opens besides; nothing for what it does not know, such as tables.
void add_parts(const std::string& file, std::set<std::string>& files) {
  try {
    const OpenDataset open =
        open_dataset(file, file, GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY);
    for (const std::string& part : files_of(*open.dataset)) files.insert(part);
  } catch (const SetupError&) {  // what reads it says why
  }
}

std::vector<FileStamp> stamps(const std::set<std::string>& files) {
  std::vector<FileStamp> found;
  for (const std::string& file : files)
    if (const auto stamp = stamp_of(file)) found.push_back(*stamp);
  return found;
}

}  // namespace

std::optional<std::vector<FileStamp>> stamps_of(const Scenario& scenario) {
  const GdalScope scope;
  std::set<std::string> files;
  for (const std::string& name : named_files(scenario)) {
    std::error_code failed;
    if (!fs::exists(name, failed)) return std::nullopt;
    add_neighbours(name, files);
    add_parts(name, files);
  }
  return stamps(files);
}

bool are_unchanged(const Scenario& scenario, const std::vector<FileStamp>& before,
                   std::int64_t looked_ns) {
  std::set<std::string> files;
  for (const FileStamp& stamp : before) {
    if (is_fresh(stamp, looked_ns)) return false;
    files.insert(stamp.path);
  }
  for (const std::string& name : named_files(scenario)) add_neighbours(name, files);
  return stamps(files) == before;
}

}  // namespace sturz
