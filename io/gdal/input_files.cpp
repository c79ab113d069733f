// SPDX-License-Identifier: Apache-2.0
#include "io/gdal/input_files.hpp"

#include "engine/core/error.hpp"
#include "io/gdal/gdal_handles.hpp"
#include "io/gdal/input_trust.hpp"
#include "scenarios/schema/suggest.hpp"

#include <cpl_vsi.h>
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

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// "/vsizip/" of "/vsizip/dem.zip/dem.tif", "/vsigzip//vsitar/" of a chain; an opening brace, which
/// may set off the archive, belongs to it. Empty where the file system reads no other files.
std::string archive_prefix(const std::string& text) {
  std::string prefix;
  for (bool found = true; found;) {
    found = false;
    for (const char* system : {"/vsizip/", "/vsigzip/", "/vsitar/", "/vsi7z/", "/vsirar/"})
      if (text.compare(prefix.size(), std::string(system).size(), system) == 0) {
        prefix += system;
        found = true;
      }
    if (text.compare(prefix.size(), 1, "{") == 0 && !prefix.empty()) prefix += "{";
  }
  return prefix;
}

/// Where a file inside a name that only GDAL understands begins and ends, as far as it can be
/// found: what follows `directory` / it exists. {0, 0} where nothing does.
struct Part {
  std::size_t from = 0, end = 0;
};

Part relative_part(const std::string& text, const fs::path& directory) {
  std::size_t from = archive_prefix(text).size();
  if (from == 0) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || text.rfind("/vsi", 0) == 0) return {};
    from = colon + 1 + (text.compare(colon + 1, 1, "\"") == 0 ? 1 : 0);
  }
  if (from >= text.size() || text[from] == '/') return {};
  // The longest beginning that is a file: what follows it is a place inside.
  for (std::size_t end = text.size(); end > from; --end) {
    const bool border = end == text.size() || text[end] == '/' || text[end] == ':' ||
                        text[end] == '"' || text[end] == '}';
    if (border && fs::is_regular_file(directory / text.substr(from, end - from)))
      return {from, end};
  }
  return {};
}

void require_archive_entry(const std::string& path, const std::string& label) {
  const GdalScope scope;
  VSIStatBufL about;
  if (archive_prefix(path).empty() || VSIStatL(path.c_str(), &about) == 0) return;
  throw SetupError(
      fmt::format("{}: nothing of that name is there (looked for {}). Relative paths "
                  "start at the scenario file's folder.",
                  label, path));
}

}  // namespace

std::string anchored_gdal_name(const std::string& written, const std::string& directory) {
  const fs::path folder = directory.empty() ? fs::path(".") : fs::path(directory);
  const Part part = relative_part(written, folder);
  if (part.end == 0) return written;
  const fs::path file = fs::absolute(folder / written.substr(part.from, part.end - part.from));
  return written.substr(0, part.from) + file.lexically_normal().string() + written.substr(part.end);
}

InputFile find_input(const std::string& key, const std::string& written,
                     const std::string& directory) {
  const std::string label = key + " = " + written;
  require(!written.empty(), key + " is empty (a file name was expected). Name the file.");
  fs::path path(written);
  if (path.is_relative() && !directory.empty()) path = fs::path(directory) / path;
  InputFile file{path.string(), label};
  if (!is_there(path)) {
    if (!is_gdal_name(written))
      throw SetupError(fmt::format("{}: no such file (looked for {}). {}", label, path.string(),
                                   suggestion(path)));
    file.path = anchored_gdal_name(written, directory);
  }
  require_trusted(file);
  require_archive_entry(file.path, label);
  return file;
}

}  // namespace sturz
