// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/map_files.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/text_files.hpp"
#include "io/gdal/cog.hpp"
#include "reports/gis/qgis_style.hpp"

#include <fmt/format.h>

#include <set>
#include <sstream>
#include <string>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr const char* index_header =
    "file,layer,quantity,statistic,unit,axis,axis_value,axis_unit,meaning\n";

fs::path style_of(fs::path tif) { return tif.replace_extension(".qml"); }

/// First column of an earlier list; empty when there is none, or another program's.
std::set<std::string> listed_files(const fs::path& index) {
  std::set<std::string> files;
  if (!fs::exists(index)) return files;
  std::istringstream lines(read_text(index));
  std::string line;
  std::getline(lines, line);
  if (line + "\n" != index_header) return files;
  while (std::getline(lines, line)) files.insert(line.substr(0, line.find(',')));
  return files;
}

/// Names of ours have no way out of the folder: an edited list cannot reach other files.
bool is_ours(const std::string& name) {
  const fs::path path(name);
  return path.extension() == ".tif" && !path.is_absolute() && name.find("..") == std::string::npos;
}

std::string line_of(const std::string& name, const Layer& layer, std::size_t plane) {
  const bool axis = !layer.axis.values.empty();
  return fmt::format(
      "{},{},{},{},{},{},{},{},\"{}\"\n", name, layer.name, to_string(layer.meaning.quantity),
      to_string(layer.meaning.statistic), layer.units, layer.axis.name,
      axis ? fmt::format("{}", layer.axis.values[plane]) : "", layer.axis.units, layer.long_name);
}

/// What an earlier list and a list in the making name, so that no file of ours is ever unlisted.
void list_both(const fs::path& index, const std::string& now) {
  const std::string before = listed_files(index).empty() ? index_header : read_text(index);
  write_text_atomic(index, before + now.substr(std::string(index_header).size()));
}

void remove_files(const fs::path& folder, const std::set<std::string>& names) {
  for (const std::string& name : names) {
    if (!is_ours(name)) continue;
    fs::remove(folder / name);
    fs::remove(style_of(folder / name));
  }
}

}  // namespace

void remove_map_files(const fs::path& folder) {
  const fs::path index = folder / "index.csv";
  const std::set<std::string> listed = listed_files(index);
  if (listed.empty()) return;
  remove_files(folder, listed);
  fs::remove(index);
}

void write_map_files(const fs::path& folder, const LayerSource& maps, const LayerStack& coarse,
                     CancelFlag cancel) {
  const fs::path index = folder / "index.csv";
  std::set<std::string> before = listed_files(index);
  std::string list = index_header;
  for (const PlaneFile& file : cog_files(folder, maps.about())) {
    const std::string name = file.path.lexically_relative(folder).generic_string();
    list += line_of(name, maps.about().layers[file.layer], file.plane);
    before.erase(name);
  }
  make_folder(folder);
  list_both(index, list);
  for (const PlaneFile& file : write_cogs(folder, maps, cancel)) {
    const Layer& layer = maps.about().layers[file.layer];
    const Layer* shown = coarse.find(layer.name);
    write_text_atomic(style_of(file.path), qgis_style(shown != nullptr ? *shown : layer));
  }
  remove_files(folder, before);
  write_text_atomic(index, list);
}

}  // namespace sturz::workflow
