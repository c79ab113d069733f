// SPDX-License-Identifier: Apache-2.0
/// Writes the pages that the browser test opens: write_pages DIRECTORY [COLUMNS ROWS MEMBERS].
#include "ensemble/region/region_maps.hpp"
#include "reports/figures/figures.hpp"
#include "reports/figures/png.hpp"
#include "tests/reports/made_up_results.hpp"

#include <fmt/format.h>

#include <cmath>
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

/// Layers as text, for the browser to compare with; NaN as null.
void write_layers_json(const std::filesystem::path& path, const sturz::testing::MadeUpResults& r) {
  const auto& g = r.hazard.grid;
  const auto list = [](const float* values, std::size_t n) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i)
      text += std::isnan(values[i]) ? std::string("null,") : fmt::format("{:.9g},", values[i]);
    if (!text.empty()) text.pop_back();
    return fmt::format("[{}]", text);
  };
  const sturz::Layer& thickness = *r.hazard.find("thickness_quantile");
  const std::string json = fmt::format(
      "{{\"grid\":{{\"west\":{},\"north\":{},\"cell\":{},\"cols\":{},\"rows\":{}}},"
      "\"road\":[[413000,4651400],[413900,4651900]],"
      "\"probability_of_reach\":{},\"median_thickness\":{}}}",
      g.west_m, g.north_m, g.cell_m, g.n_cols, g.n_rows,
      list(r.hazard.find("probability_of_reach")->values.data(), g.n_cells()),
      list(thickness.values.data() + g.n_cells(), g.n_cells()));
  write(path, json);
}

/// Houses and a road, and a grey picture in place of a photo.
void write_overlays(const std::filesystem::path& path, sturz::ReportInput input) {
  using namespace sturz;
  const std::vector<Overlay> overlays = {
      {"Houses <new>",
       {{OverlayFeature::Kind::polygon,
         {{{413200, 4651700}, {413260, 4651700}, {413260, 4651760}, {413200, 4651700}}},
         "chapel"},
        {OverlayFeature::Kind::point, {{{413500, 4651800}}}, "well"}}},
      {"Roads", {{OverlayFeature::Kind::line, {{{413000, 4651400}, {413900, 4651900}}}, "pass"}}}};
  input.overlays = overlays;
  input.orthophoto = [](const Grid&) {
    return grey_png(std::vector<std::uint8_t>{40, 200, 90, 160}, 2, 2);
  };
  write(path, make_report(input));
}

/// A run that thins out from its peak to its deposit.
void write_frames(const std::filesystem::path& path, const sturz::testing::MadeUpResults& r) {
  using namespace sturz;
  FramesShown frames{0, r.peaks.grid, {}, {}};
  const Layer &peak = *r.peaks.find("peak_thickness"),
              &deposit = *r.peaks.find("deposit_thickness");
  for (int k = 0; k <= 8; ++k) {
    frames.times_s.push_back(7.5 * k);
    auto& plane = frames.thickness.emplace_back(deposit.values);
    for (std::size_t i = 0; i < plane.size(); ++i)
      plane[i] += static_cast<float>(8 - k) / 8 * (peak.values[i] - plane[i]);
  }
  ReportInput input = r.single_input();
  input.frames = &frames;
  write(path, make_report(input));
}

/// Two ensembles beside each other: the second has half the probabilities.
void write_comparison(const std::filesystem::path& path, const sturz::ReportInput& of) {
  using namespace sturz;
  LayerStack a = *of.hazard, b = *of.hazard;
  Layer difference = *a.find("probability_of_reach");
  difference.name = "probability_difference";
  difference.meaning.statistic = Statistic::difference;
  for (Layer& layer : b.layers)
    if (layer.name == "probability_of_reach")
      for (float& v : layer.values) v /= 2;
  for (float& v : difference.values) v /= -2;
  a.layers.push_back(difference);
  ComparisonShown shown{"out/as it is", "out/with a <dam>", &b};
  shown.pairs = shown.valid_a = shown.valid_b = 31;
  shown.least = -0.5, shown.less_m2 = 2.5e5;
  shown.differences = {"terrain.dams: none -> 1"};
  ReportInput input;
  input.title = of.title;
  input.hazard = &a;
  input.elevation = of.elevation;
  input.comparison = &shown;
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
  write_layers_json(directory / "ensemble_layers.json", results);
  write_overlays(directory / "overlays.html", input);
  write_frames(directory / "frames.html", results);
  write_comparison(directory / "comparison.html", input);
  auto german = results.ensemble_input();
  german.language = "de";
  write(directory / "german.html", sturz::make_report(german));
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

  // As large as a page gets: 500 x 500 cells, more than twenty planes.
  auto large_scene = scene;
  large_scene.n_cols = large_scene.n_rows = 500, large_scene.cell_m = 5;
  large_scene.n_members = 12;
  const auto large = make_up_results(large_scene);
  write(directory / "large.html", sturz::make_report(large.ensemble_input()));

  auto empty_scene = scene;
  empty_scene.n_members = 0;
  const auto empty = make_up_results(empty_scene);
  write(directory / "empty.html", sturz::make_report(empty.ensemble_input()));
}
