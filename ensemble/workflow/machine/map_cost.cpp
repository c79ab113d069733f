// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/map_cost.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

constexpr int n_trial_members = 12;
constexpr int small_edge = 24, large_edge = 240;  // cells of the two made-up ensembles

struct NamedSpeed {
  const char* name;
  double MapSpeed::*field;
};
constexpr NamedSpeed named_speeds[] = {
    {"seconds_per_member", &MapSpeed::seconds_per_member},
    {"seconds_per_touch", &MapSpeed::seconds_per_touch},
    {"seconds_per_plane", &MapSpeed::seconds_per_plane},
    {"seconds_per_plane_cell", &MapSpeed::seconds_per_plane_cell}};

/// Goes away with the scope.
struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / fmt::format("sturz_maps_{}", ::getpid());
  TemporaryFolder() = default;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// Computing time of this thread: what others do on the machine meanwhile does not count.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A flow over a square, every value its own, as real ones are.
MemberResult made_up_member(std::int64_t number, int edge) {
  MemberResult m;
  m.member = number;
  m.outcome = Outcome::settled;
  m.grid = {edge, edge, 0, 1e4, 5, ""};
  m.window = {0, 0, edge, edge};
  for (int l = 0; l < n_peak_layers; ++l)
    for (int i = 0; i < edge * edge; ++i)
      m.layers[static_cast<std::size_t>(l)].push_back(static_cast<float>(
          (l + 1) * (1.1 + std::sin(0.01 * i + static_cast<double>(number) * 1.7))));
  return m;
}

struct Trial {
  double open_s = 0, statistics_s = 0, files_s = 0;
};

/// Swallows maps: statistics alone.
struct NoSink final : LayerSink {
  void begin(const LayerStack& /*about*/) override {}
  void put(std::size_t /*layer*/, std::size_t /*plane*/, const Window& /*window*/,
           std::span<const float> /*values*/) override {}
};

void write_all(const fs::path& folder, const LayerStack& maps) {
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
  write_map_files(folder / "hazard", reader, coarse_layers(reader, page_cells), {});
}

Trial measure(const fs::path& folder, int edge) {
  for (std::int64_t m = 0; m < n_trial_members; ++m)
    write_member(folder / "members", made_up_member(m, edge));
  Trial trial;
  const double begin = thread_seconds();
  const MemberStore store(folder / "members");
  const double opened = thread_seconds();
  NoSink nothing;
  make_hazard_map(store, HazardSpec{}, {}, nothing);
  const double counted = thread_seconds();
  const LayerStack maps = make_hazard_map(store, HazardSpec{}, {});
  const double begin_files = thread_seconds();
  write_all(folder, maps);
  trial.files_s = thread_seconds() - begin_files;
  trial.open_s = opened - begin;
  trial.statistics_s = counted - opened;
  return trial;
}

MapSpeed measured() {
  const TemporaryFolder folder;
  const Trial small = measure(folder.path / "small", small_edge);
  const Trial large = measure(folder.path / "large", large_edge);
  const auto touches = [](int edge) { return static_cast<double>(n_trial_members) * edge * edge; };
  const double planes = map_planes(HazardSpec{});
  MapSpeed speed;
  speed.seconds_per_touch =
      (large.statistics_s - small.statistics_s) / (touches(large_edge) - touches(small_edge));
  speed.seconds_per_touch = std::max(speed.seconds_per_touch, 1e-9);
  speed.seconds_per_member = (small.open_s + large.open_s) / (2.0 * n_trial_members);
  const double more_cells = planes * (large_edge * large_edge - small_edge * small_edge);
  speed.seconds_per_plane_cell = std::max((large.files_s - small.files_s) / more_cells, 1e-10);
  speed.seconds_per_plane = small.files_s / planes;
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

int map_planes(const HazardSpec& spec) {
  Grid cell;
  cell.n_cols = cell.n_rows = 1;
  int planes = 0;
  for (const Layer& layer : hazard_layers(cell, spec, 0, 1).stack.layers)
    if (!layer.is_count()) planes += static_cast<int>(layer.n_planes());
  return planes;
}

MapCost predict_map_cost(const MapWork& work, const MapSpeed& speed) {
  const double touches = static_cast<double>(work.members) * work.cells_per_member;
  const double plane_cells = work.planes * work.cells;
  constexpr double bytes_per_touch = 2.0 * (6 + n_peak_layers * sizeof(float));  // and growing room
  const double records =
      std::min(bytes_per_touch * touches, 2.0 * MemberCells::default_memory_bytes);
  const double passes =
      std::max(1.0, bytes_per_touch * touches / 2 / (0.75 * MemberCells::default_memory_bytes));
  MapCost cost;
  cost.seconds = static_cast<double>(work.members) * speed.seconds_per_member * (1 + passes) +
                 touches * speed.seconds_per_touch + work.planes * speed.seconds_per_plane +
                 plane_cells * speed.seconds_per_plane_cell;
  const double page = std::min(work.cells, static_cast<double>(page_cells)) * work.planes;
  constexpr double program_bytes = 90e6, bytes_per_page_cell = 6;
  cost.memory_bytes = program_bytes + records + bytes_per_page_cell * page;
  constexpr double bytes_per_plane = 20e3, bytes_per_plane_cell = 2 * sizeof(float);
  cost.disk_bytes = work.planes * bytes_per_plane + bytes_per_plane_cell * plane_cells;
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
