// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf/source_lists_netcdf.hpp"

#include "engine/core/error.hpp"
#include "io/files/io_error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

namespace sturz {
namespace {

constexpr const char* cell_name = "reached_cell";
constexpr const char* count_name = "sources_at_cell";
constexpr const char* hit_axis = "source_hit";
constexpr const char* source_name = "hit_source";
constexpr const char* share_name = "hit_probability";
constexpr const char* names_attribute = "source_names";
constexpr std::size_t longest_chunk = 1 << 16;

int define(NetcdfWriter& file, const char* name, NcType type, int dimension, std::size_t length,
           const char* long_name) {
  const int variable = file.variable(name, type, {dimension});
  file.compress(variable, {std::min(length, longest_chunk)});
  file.text(variable, "long_name", long_name);
  return variable;
}

std::string lines_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) (text += text.empty() ? "" : "\n") += name;
  return text;
}

[[noreturn]] void refuse(const NetcdfReader& file) {
  throw IoError(
      fmt::format("{}: its lists of sources contradict each other (it is damaged). Make "
                  "the maps again with `sturz merge`.",
                  file.file().string()));
}

/// Cells and where each one's hits begin.
void read_cells(const NetcdfReader& file, const Grid& grid, SourceLists& lists) {
  const std::vector<std::int32_t> cells = file.integers(cell_name),
                                  counts = file.integers(count_name);
  if (cells.size() != counts.size()) refuse(file);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool rising = i == 0 || cells[i] > cells[i - 1];
    if (!rising || cells[i] < 0 || static_cast<std::size_t>(cells[i]) >= grid.n_cells() ||
        counts[i] <= 0)
      refuse(file);
    lists.cells.push_back(cells[i]);
    lists.begin.push_back(lists.begin.back() + static_cast<std::size_t>(counts[i]));
  }
}

}  // namespace

void write_source_lists(NetcdfWriter& file, const SourceLists& lists) {
  if (lists.cells.empty()) return;
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  require(
      lists.grid.n_cells() <= most && lists.hits.size() <= most,
      fmt::format("the region's map has {} cells and {} hits (more than 2^31 cannot be listed). "
                  "Use larger cells (hazard.cell_size_m) or fewer features.",
                  lists.grid.n_cells(), lists.hits.size()));
  std::vector<std::int32_t> cells, counts, sources;
  std::vector<float> shares;
  for (std::size_t i = 0; i < lists.cells.size(); ++i) {
    cells.push_back(static_cast<std::int32_t>(lists.cells[i]));
    counts.push_back(static_cast<std::int32_t>(lists.begin[i + 1] - lists.begin[i]));
  }
  for (const SourceHit& hit : lists.hits) {
    sources.push_back(static_cast<std::int32_t>(hit.source) + 1);
    shares.push_back(hit.probability);
  }
  const int cell_axis = file.dimension(cell_name, cells.size());
  const int hits = file.dimension(hit_axis, sources.size());
  const int cell = define(file, cell_name, NcType::int32, cell_axis, cells.size(),
                          "cells that some source reaches");
  file.text(cell, "compress", "y x");
  const int count = define(file, count_name, NcType::int32, cell_axis, cells.size(),
                           "number of sources that reach the cell");
  file.text(count, "sample_dimension", hit_axis);
  const int source = define(file, source_name, NcType::int32, hits, sources.size(),
                            "number of a source that reaches the cell, from 1 as in sources.csv");
  file.text(source, names_attribute, lines_of(lists.sources));
  const int share = define(file, share_name, NcType::float32, hits, sources.size(),
                           "share of that source's valid members that reach the cell");
  file.text(share, "units", "1");
  file.put(cell, cells);
  file.put(count, counts);
  file.put(source, sources);
  file.put(share, shares);
}

SourceLists read_source_lists(const NetcdfReader& file, const Grid& grid) {
  SourceLists lists;
  lists.grid = grid;
  if (!file.has(cell_name)) return lists;
  std::istringstream names(file.text(source_name, names_attribute).value_or(""));
  for (std::string name; std::getline(names, name);) lists.sources.push_back(name);
  read_cells(file, grid, lists);
  const std::vector<std::int32_t> sources = file.integers(source_name);
  std::vector<float> shares(file.size(share_name));
  file.floats(share_name, {0}, {shares.size()}, shares);
  if (sources.size() != lists.begin.back() || shares.size() != sources.size()) refuse(file);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const bool known =
        sources[i] >= 1 && static_cast<std::size_t>(sources[i]) <= lists.sources.size();
    if (!known || !(shares[i] > 0 && shares[i] <= 1)) refuse(file);
    lists.hits.push_back({static_cast<std::uint32_t>(sources[i] - 1), shares[i]});
  }
  return lists;
}

}  // namespace sturz
