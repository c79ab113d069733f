// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_query.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/region/region_folder.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/netcdf/source_lists_netcdf.hpp"
#include "scenarios/layers/plane_name.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace sturz::workflow {

SourcesAt sources_at(const std::filesystem::path& region, double x_m, double y_m) {
  const OutputFolder folder{region};
  require(is_region(region),
          fmt::format("{} is no region. Name the folder that `sturz ensemble` made of a scenario "
                      "with release.each_feature.",
                      region.string()));
  require(std::filesystem::exists(folder.hazard_nc()),
          fmt::format("{} has no maps yet. Make them with `sturz merge`, or resume the ensemble.",
                      region.string()));
  const LayersFileReader maps(folder.hazard_nc());
  const Grid& g = maps.about().grid;
  SourcesAt found;
  const double row = std::floor((g.north_m - y_m) / g.cell_m);
  const double col = std::floor((x_m - g.west_m) / g.cell_m);
  require(row >= 0 && col >= 0 && row < g.n_rows && col < g.n_cols,
          fmt::format("x {:.10g}, y {:.10g} lies beyond the maps (x {:.10g} to {:.10g}, y {:.10g} "
                      "to {:.10g}): no source comes near. Coordinates are those of the maps.",
                      x_m, y_m, g.west_m, g.east_m(), g.south_m(), g.north_m));
  found.row = static_cast<int>(row);
  found.col = static_cast<int>(col);
  found.x_m = g.x_center(found.col);
  found.y_m = g.y_center(found.row);
  for (std::size_t l = 0; l < maps.about().layers.size(); ++l) {
    const Layer& layer = maps.about().layers[l];
    if (!layer.classes.empty()) continue;  // the list says it
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane) {
      float value = nan_f;
      maps.read(l, plane, {found.row, found.col, 1, 1}, {&value, 1});
      found.values.emplace_back(plane_name(layer, plane), value);
    }
  }
  const SourceLists lists = read_source_lists(NetcdfReader(folder.hazard_nc()), g);
  for (const SourceHit& hit : lists.at(std::int64_t{found.row} * g.n_cols + found.col))
    found.sources.emplace_back(lists.sources[hit.source], hit.probability);
  std::stable_sort(found.sources.begin(), found.sources.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return found;
}

}  // namespace sturz::workflow
