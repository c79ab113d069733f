// SPDX-License-Identifier: Apache-2.0
/// Writes the pages that the browser test opens: write_pages DIRECTORY [COLUMNS ROWS MEMBERS].
#include "ensemble/region/region_maps.hpp"
#include "reports/figures/figures.hpp"
#include "tests/reports/made_up_results.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace {

void write(const std::filesystem::path& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

/// The members of an ensemble as those of two sources, one of each two, and a third without any.
void write_region(const std::filesystem::path& path, const sturz::testing::MadeUpResults& results) {
  using namespace sturz;
  std::vector<RegionSource> sources{
      {"north <gully>", 16, 0, {}}, {"south gully", 16, 0, {}}, {"nowhere", 16, 0, {}}};
  std::vector<std::uint32_t> source_of;
  std::vector<std::int64_t> row_of;
  for (const MemberSummary& m : results.source->members()) {
    if (!is_valid(m.outcome)) continue;
    const std::uint32_t source = 2 * source_of.size() < results.source->members().size() ? 0 : 1;
    source_of.push_back(source);
    row_of.push_back(m.member % 16);
    ++sources[source].valid;
    sources[source].touched = whole_of(results.source->grid());
  }
  StackSink sink;
  const std::vector<double> quantiles{0.5, 0.95};
  RegionShown shown;
  shown.lists =
      make_region_maps({*results.source, sources, source_of, row_of, 16}, quantiles, {}, sink);
  shown.members_planned = 16;
  for (const RegionSource& s : sources) shown.sources.push_back({s.name, "", 16, s.valid});
  shown.sources[2].failure = "it lies beyond the terrain";
  ReportInput input;
  input.title = "A region";
  input.elevation = &results.elevation;
  input.hazard = &sink.stack;
  input.region = &shown;
  write(path, make_report(input));
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
  write_region(directory / "region.html", results);
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
