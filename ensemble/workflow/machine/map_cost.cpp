// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/map_cost.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/machine/temporary_folder.hpp"
#include "ensemble/workflow/results/gis/gis_files.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/members/member_writer.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr int n_trial_members = 8;
constexpr int small_edge = 24, large_edge = 200;  // cells of the two made-up ensembles

struct NamedSpeed {
  const char* name;
  double MapSpeed::*field;
};
constexpr NamedSpeed named_speeds[] = {
    {"seconds_per_member", &MapSpeed::seconds_per_member},
    {"seconds_per_touch", &MapSpeed::seconds_per_touch},
    {"seconds_per_plane", &MapSpeed::seconds_per_plane},
    {"seconds_per_plane_cell", &MapSpeed::seconds_per_plane_cell},
    {"seconds_per_packed_member", &MapSpeed::seconds_per_packed_member}};

/// Computing time of the process: files are compressed by threads of their own.
double process_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A flow along a square's diagonal, every value its own, the rest untouched as real maps are.
MemberResult made_up_member(std::int64_t number, int edge) {
  MemberResult m;
  m.member = number;
  m.outcome = Outcome::settled;
  m.grid = {edge, edge, 0, 1e4, 5, ""};
  m.window = {0, 0, edge, edge};
  const int half_width = edge / 8 + static_cast<int>(number % 4) * edge / 40;
  for (int l = 0; l < n_peak_layers; ++l) {
    const auto layer = static_cast<PeakLayer>(l);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    for (int i = 0; i < edge * edge; ++i)
      m.layer(layer).push_back(
          std::abs(i / edge - i % edge) <= half_width
              ? static_cast<float>((l + 1) *
                                   (1.1 + std::sin(0.01 * i + static_cast<double>(number) * 1.7)))
              : info(layer).untouched);
  }
  return m;
}

double touched_cells(const MemberResult& m) {
  const auto& arrival = m.layer(PeakLayer::arrival);
  return static_cast<double>(
      std::count_if(arrival.begin(), arrival.end(), [](float v) { return !std::isnan(v); }));
}

struct Trial {
  double touches = 0;
  double open_s = 0, open_packed_s = 0, statistics_s = 0, files_s = 0;
};

/// Swallows maps: statistics alone.
struct NoSink final : LayerSink {
  void begin(const LayerStack& /*about*/) override {}
  void put(std::size_t /*layer*/, std::size_t /*plane*/, const Window& /*window*/,
           std::span<const float> /*values*/) override {}
};

void write_all(const fs::path& folder, const LayerStack& maps, const MemberStore& members) {
  LayersFileWriter file(folder / "hazard.nc");
  file.begin(maps);
  const StackSource source(maps);
  std::vector<float> values;
  for (std::size_t l = 0; l < maps.layers.size(); ++l)
    for (std::size_t plane = 0; plane < maps.layers[l].n_planes(); ++plane)
      for (int row = 0; row < maps.grid.n_rows; row += MemberCells::block_edge)
        for (int col = 0; col < maps.grid.n_cols; col += MemberCells::block_edge) {
          const Window w{row, col, std::min(MemberCells::block_edge, maps.grid.n_rows - row),
                         std::min(MemberCells::block_edge, maps.grid.n_cols - col)};
          values.resize(w.n_cells());
          source.read(l, plane, w, values);
          file.put(l, plane, w, values);
        }
  file.commit();
  const LayersFileReader reader(folder / "hazard.nc");
  const LayerStack coarse = coarse_layers(reader, page_cells);
  write_map_files(folder / "hazard", reader, coarse, {});
  const OutputFolder out{folder};
  write_text_atomic(out.scenario(), "");
  GisContent gis;
  gis.maps = &reader;
  gis.coarse = &coarse;
  gis.members = members.members();
  write_gis_files(out, gis);
  PageContent page;
  page.hazard = &coarse;
  page.members = members.members();
  write_page(out, {}, {}, page);
}

Trial measure(const fs::path& folder, int edge) {
  Trial trial;
  for (std::int64_t k = 0; k < n_trial_members; ++k) {
    const MemberResult m = made_up_member(k, edge);
    trial.touches += touched_cells(m);
    write_member(folder / "members", m);
    PackWriter(folder / "packs", {}).append(m, {});
  }
  const double begin_packed = process_seconds();
  const MemberStore packed(folder / "packs");
  const double begin = process_seconds();
  trial.open_packed_s = begin - begin_packed;
  const MemberStore store(folder / "members");
  const double opened = process_seconds();
  NoSink nothing;
  make_hazard_map(store, HazardSpec{}, {}, nothing);
  const double counted = process_seconds();
  const LayerStack maps = make_hazard_map(store, HazardSpec{}, {});
  const double begin_files = process_seconds();
  write_all(folder, maps, store);
  trial.files_s = process_seconds() - begin_files;
  trial.open_s = opened - begin;
  trial.statistics_s = counted - opened;
  return trial;
}

MapSpeed measured() {
  const TemporaryFolder folder;
  const Trial small = measure(folder.path() / "small", small_edge);
  const Trial large = measure(folder.path() / "large", large_edge);
  const double planes = map_planes(HazardSpec{});
  MapSpeed speed;
  speed.seconds_per_touch =
      std::max((large.statistics_s - small.statistics_s) / (large.touches - small.touches), 1e-9);
  speed.seconds_per_member =
      std::max((small.open_s + large.open_s) / (2.0 * n_trial_members), 1e-6);
  speed.seconds_per_packed_member =
      std::max((small.open_packed_s + large.open_packed_s) / (2.0 * n_trial_members), 1e-6);
  const double more_cells = planes * (large_edge * large_edge - small_edge * small_edge);
  speed.seconds_per_plane_cell = std::max((large.files_s - small.files_s) / more_cells, 1e-10);
  speed.seconds_per_plane = std::max(small.files_s / planes, 1e-6);
  return speed;
}

std::string machine_key() {
  std::ifstream info("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
  return fmt::format("{}, sturz {} {} {}", processor, version, git_commit, build_type);
}

fs::path cache_file(const SpeedCache& cache) {
  return cache.file.empty() ? fs::path() : cache.file.parent_path() / "map_speed.json";
}

bool read_cached(const fs::path& file, MapSpeed& speed) {
  std::ifstream in(file);
  const auto all = nlohmann::json::parse(in, nullptr, false);
  if (!all.is_object() || all.value("measured_on", "") != machine_key()) return false;
  for (const auto& [name, field] : named_speeds) {
    if (!all.contains(name) || !all[name].is_number()) return false;
    speed.*field = all[name].get<double>();
    if (!(speed.*field > 0)) return false;
  }
  return true;
}

void write_cached(const fs::path& file, const MapSpeed& speed) {
  nlohmann::ordered_json all{{"measured_on", machine_key()}};
  for (const auto& [name, field] : named_speeds) all[name] = speed.*field;
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  if (failed) return;
  try {
    write_text_atomic(file, all.dump(2) + "\n");
  } catch (const SetupError&) {
    // only a cache
  }
}

}  // namespace

bool has_materials(const Scenario& s) {
  return has_two_phases(s.mixture) || (s.grains.has_value() && s.fluid.has_value());
}

int map_planes(const HazardSpec& spec, bool erodes, bool materials) {
  Grid cell;
  cell.n_cols = cell.n_rows = 1;
  int planes = 0;
  for (const Layer& layer :
       hazard_layers(cell, spec, 0, 1, 0, {.left = false, .eroded = erodes, .phases = materials})
           .stack.layers)
    if (!layer.is_count()) planes += static_cast<int>(layer.n_planes());
  return planes;
}

MapCost predict_map_cost(const MapWork& work, const MapSpeed& speed) {
  const double touches = static_cast<double>(work.members) * work.cells_per_member;
  const double plane_cells = work.planes * work.cells;
  const int layers = work.materials ? n_peak_layers : static_cast<int>(PeakLayer::liquid) + 1;
  const double bytes_per_touch = 6 + layers * sizeof(float);
  const auto most_records = static_cast<double>(records_memory_bytes());
  const bool packed = work.members > most_member_files;
  // Of a pack, a pass reads nothing but the bands of rows that it keeps.
  const double passes =
      packed ? 1 : std::max(1.0, bytes_per_touch * touches / (0.75 * most_records));
  MapCost cost;
  cost.seconds = static_cast<double>(work.members) *
                     (packed ? speed.seconds_per_packed_member : speed.seconds_per_member) *
                     (1 + passes) +
                 touches * speed.seconds_per_touch + work.planes * speed.seconds_per_plane +
                 plane_cells * speed.seconds_per_plane_cell;
  const double page = std::min(work.cells, static_cast<double>(page_cells)) * work.planes;
  constexpr double bytes_per_page_cell = 4;
  constexpr double bytes_per_member = 1e3;  // its numbers, without its maps
  cost.memory_bytes = program_bytes + std::min(bytes_per_touch * touches, most_records) +
                      bytes_per_page_cell * page +
                      bytes_per_member * static_cast<double>(work.members);
  // As compressed as maps are of which a flow covers a third: docs/studies/forecasts.md.
  constexpr double page_bytes = 550e3, bytes_per_plane = 5.5e3, bytes_per_plane_cell = 1.57,
                   bytes_per_row = 1e3;
  // An empty GeoPackage; then areas with their style, an entry of the project and one of the
  // catalogue. Measured on the scene of tests/gis: 364 kB for 44 planes.
  constexpr double gis_bytes = 110e3, gis_bytes_per_plane = 5.8e3;
  cost.disk_bytes = page_bytes + gis_bytes + work.planes * (bytes_per_plane + gis_bytes_per_plane) +
                    bytes_per_plane_cell * plane_cells +
                    bytes_per_row * static_cast<double>(work.members);
  return cost;
}

MapSpeed map_speed(const SpeedCache& cache) {
  const fs::path file = cache_file(cache);
  MapSpeed speed;
  if (!cache.measure_again && !file.empty() && read_cached(file, speed)) return speed;
  speed = measured();
  if (!file.empty()) write_cached(file, speed);
  return speed;
}

}  // namespace sturz::workflow
