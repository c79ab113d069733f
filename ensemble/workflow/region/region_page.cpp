// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/region/region_page.hpp"

#include "ensemble/workflow/region/source_table.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/text_files.hpp"
#include "io/site/map_ground.hpp"
#include "io/site/overlays/orthophoto.hpp"
#include "reports/page/report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::workflow {
namespace {

/// The lists in the cells of a page: each source with its largest probability of the joined cells.
SourceLists joined_lists(SourceLists lists, const Grid& coarse, int joined) {
  if (joined == 1) return lists;
  struct Hit {
    std::int64_t cell;
    SourceHit hit;
  };
  std::vector<Hit> all;
  all.reserve(lists.hits.size());
  for (std::size_t i = 0; i < lists.cells.size(); ++i) {
    const std::int64_t row = lists.cells[i] / lists.grid.n_cols / joined;
    const std::int64_t col = lists.cells[i] % lists.grid.n_cols / joined;
    for (const SourceHit& hit : lists.at(lists.cells[i]))
      all.push_back({row * coarse.n_cols + col, hit});
  }
  std::sort(all.begin(), all.end(), [](const Hit& a, const Hit& b) {
    if (a.cell != b.cell) return a.cell < b.cell;
    if (a.hit.source != b.hit.source) return a.hit.source < b.hit.source;
    return a.hit.probability > b.hit.probability;
  });
  SourceLists out;
  out.grid = coarse;
  out.sources = lists.sources;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool new_cell = i == 0 || all[i].cell != all[i - 1].cell;
    if (!new_cell && all[i].hit.source == all[i - 1].hit.source) continue;
    if (new_cell) {
      out.cells.push_back(all[i].cell);
      out.begin.push_back(out.hits.size());
    }
    out.hits.push_back(all[i].hit);
    out.begin.back() = out.hits.size();
  }
  return out;
}

/// Names have no order: where cells were joined, the largest number of a source says nothing.
void name_likeliest(LayerStack& coarse, const SourceLists& lists) {
  if (coarse.joined == 1) return;
  for (Layer& layer : coarse.layers)
    if (layer.meaning.quantity == Quantity::sources && !layer.classes.empty())
      for (std::size_t i = 0; i < lists.cells.size(); ++i)
        layer.values[static_cast<std::size_t>(lists.cells[i])] =
            static_cast<float>(likeliest(lists.at(lists.cells[i]), 0) + 1);
}

/// Ground below the page's map with a margin, in no more cells than a page shows: means, read band
/// by band.
Raster<double> page_ground(const Scene& scene, const Grid& map) {
  const Grid& whole = scene.inputs.terrain_grid();
  const double margin = std::max(map.east_m() - map.west_m, map.north_m - map.south_m()) / 4;
  const int row0 = std::clamp(whole.row_of(map.north_m + margin), 0, whole.n_rows - 1);
  const int row1 = std::clamp(whole.row_of(map.south_m() - margin), row0, whole.n_rows - 1);
  const int col0 = std::clamp(whole.col_of(map.west_m - margin), 0, whole.n_cols - 1);
  const int col1 = std::clamp(whole.col_of(map.east_m() + margin), col0, whole.n_cols - 1);
  const Window shown{row0, col0, row1 - row0 + 1, col1 - col0 + 1};
  const int f = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(shown.n_cells()) /
                                                       static_cast<double>(page_cells))));
  Grid coarse = grid_of(shown, whole);
  coarse.n_rows = (shown.n_rows + f - 1) / f;
  coarse.n_cols = (shown.n_cols + f - 1) / f;
  coarse.cell_m *= f;
  Raster<double> sums(coarse, 0.0), counts(coarse, 0.0);
  const int band_rows = std::max(1, 256 / f) * f;
  for (int r = 0; r < shown.n_rows; r += band_rows) {
    const Window band{row0 + r, col0, std::min(band_rows, shown.n_rows - r), shown.n_cols};
    const auto ground = ground_of_map(scene.scenario, scene.inputs, grid_of(band, whole));
    const Window held = window_of(ground->grid, whole);
    for (int row = band.row0; row < band.row0 + band.n_rows; ++row)
      for (int col = band.col0; col < band.col0 + band.n_cols; ++col) {
        if (!held.contains(row, col)) continue;
        const double z = ground->at(row - held.row0, col - held.col0);
        if (!std::isfinite(z)) continue;
        sums.at((row - row0) / f, (col - col0) / f) += z;
        counts.at((row - row0) / f, (col - col0) / f) += 1;
      }
  }
  for (std::size_t i = 0; i < sums.values.size(); ++i)
    sums.values[i] = counts.values[i] > 0 ? sums.values[i] / counts.values[i] : nan_d;
  return sums;
}

RegionShown shown_region(const RegionJob& job, const StoredMembers& members,
                         const SourceLists& lists) {
  RegionShown shown;
  shown.members_planned = job.members_per_source();
  shown.touched_area_m2 =
      static_cast<double>(lists.cells.size()) * lists.grid.cell_m * lists.grid.cell_m;
  const std::vector<SourceAreas> areas = source_areas(lists, members.sources().size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const SourceState& s = members.sources()[i];
    shown.sources.push_back({as_utf8(s.counts.name), as_utf8(s.failure), s.counts.planned,
                             s.counts.valid, s.cut_off, s.release_volume_m3, areas[i].possible,
                             areas[i].likely, areas[i].likeliest});
  }
  return shown;
}

}  // namespace

void write_region_page(const RegionJob& job, const StoredMembers& members, SourceLists lists,
                       LayerStack coarse, const Window& extent, CancelFlag cancel) {
  RegionShown shown = shown_region(job, members, lists);
  shown.lists = joined_lists(std::move(lists), coarse.grid, coarse.joined);
  name_likeliest(coarse, shown.lists);
  for (std::string& name : shown.lists.sources) name = as_utf8(name);
  const Raster<double> ground = page_ground(job.typical, coarse.grid);
  const Raster<std::uint8_t> release =
      members.release_cells(coarse.grid, extent, coarse.joined, cancel);
  ReportInput input;
  if (!job.scenario.report.language.empty()) input.language = job.scenario.report.language;
  input.title = job.scenario.title.empty() ? as_utf8(job.folder.root.filename().string())
                                           : job.scenario.title;
  input.scenario_yaml = read_text(job.folder.scenario());
  input.manifest = job.manifest.lines();
  input.elevation = &ground;
  input.hazard = &coarse;
  input.region = &shown;
  input.n_planned = 0;
  input.warnings = job.manifest.warnings;
  input.description = job.manifest.description;
  input.elapsed_s = job.manifest.compute_s;
  input.release = &release;
  input.observed = job.typical.inputs.observed;
  input.overlays = job.typical.inputs.overlays;
  if (!job.scenario.report.orthophoto.empty())
    input.orthophoto = [&job](const Grid& view) { return orthophoto_jpeg(job.scenario, view); };
  input.observed_note = job.scenario.hazard.observed_note;
  input.cancel = cancel;
  write_text_atomic(job.folder.report(), make_report(input));
}

}  // namespace sturz::workflow
