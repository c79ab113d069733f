// SPDX-License-Identifier: Apache-2.0
/// Writes the pages that the browser test opens: write_pages DIRECTORY [COLUMNS ROWS MEMBERS].
#include "reports/figures/figures.hpp"
#include "tests/reports/made_up_results.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace {

void write(const std::filesystem::path& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 1;
  using sturz::testing::make_up_results;
  const std::filesystem::path directory = argv[1];
  std::filesystem::create_directories(directory);
  sturz::testing::MadeUpScene scene;
  if (argc == 5) {
    scene.n_cols = std::atoi(argv[2]), scene.n_rows = std::atoi(argv[3]);
    scene.n_members = std::atoi(argv[4]);
    scene.cell_m = 2400.0 / scene.n_cols;
  }
  const auto results = make_up_results(scene);
  const auto input = results.ensemble_input();
  write(directory / "ensemble.html", sturz::make_report(input));
  write(directory / "single.html", sturz::make_report(results.single_input()));

  auto cut_scene = scene;
  cut_scene.edge = 0.45;
  const auto cut = make_up_results(cut_scene);
  write(directory / "cut.html", sturz::make_report(cut.ensemble_input()));

  auto phases_scene = scene;
  phases_scene.phases = true, phases_scene.edge = 0.55;
  const auto phases = make_up_results(phases_scene);
  write(directory / "phases.html", sturz::make_report(phases.ensemble_input()));
  write(directory / "phases_single.html", sturz::make_report(phases.single_input()));

  auto empty_scene = scene;
  empty_scene.n_members = 0;
  const auto empty = make_up_results(empty_scene);
  write(directory / "empty.html", sturz::make_report(empty.ensemble_input()));
}
