// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/comparison/comparison_page.hpp"

#include "ensemble/workflow/results/report_page.hpp"
#include "ensemble/workflow/version.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "reports/page/report.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sturz::workflow {
namespace {

/// Two ensembles share what a page holds.
constexpr std::size_t cells_of_each = page_cells / 2;

/// Maps of one ensemble on cells that reach farther: no member came there.
class OnMoreCells final : public LayerSource {
 public:
  OnMoreCells(const LayerSource& maps, const Grid& cells) : maps_(maps), about_(maps.about()) {
    const Grid own = about_.grid;
    about_.grid = cells;
    row0_ = static_cast<int>(std::lround((cells.north_m - own.north_m) / own.cell_m));
    col0_ = static_cast<int>(std::lround((own.west_m - cells.west_m) / own.cell_m));
    rows_ = own.n_rows, cols_ = own.n_cols;
  }
  const LayerStack& about() const override { return about_; }
  void read(std::size_t layer, std::size_t plane, const Window& w,
            std::span<float> out) const override {
    const bool never = is_arrival(about_.layers[layer].meaning.quantity);
    std::fill(out.begin(), out.end(), never ? nan_f : 0.0F);
    const int r0 = std::max(w.row0, row0_), r1 = std::min(w.row0 + w.n_rows, row0_ + rows_);
    const int c0 = std::max(w.col0, col0_), c1 = std::min(w.col0 + w.n_cols, col0_ + cols_);
    if (r0 >= r1 || c0 >= c1) return;
    const Window own{r0 - row0_, c0 - col0_, r1 - r0, c1 - c0};
    std::vector<float> part(own.n_cells());
    maps_.read(layer, plane, own, part);
    for (int r = 0; r < own.n_rows; ++r)
      std::copy_n(
          part.begin() + static_cast<std::ptrdiff_t>(r) * own.n_cols, own.n_cols,
          out.begin() + static_cast<std::ptrdiff_t>(r0 + r - w.row0) * w.n_cols + c0 - w.col0);
  }

 private:
  const LayerSource& maps_;
  LayerStack about_;
  int row0_ = 0, col0_ = 0, rows_ = 0, cols_ = 0;
};

LayerStack maps_of(const OpenedEnsemble& ensemble, const Grid& cells, CancelFlag cancel) {
  const LayersFileReader maps(ensemble.finished.folder.hazard_nc());
  return coarse_layers(OnMoreCells(maps, cells), cells_of_each, cancel);
}

/// P(B) - P(A) beside the maps of A; ends of its interval stay in the file.
void add_differences(LayerStack& a, const LayerSource& differences, CancelFlag cancel) {
  for (Layer& layer : coarse_layers(differences, cells_of_each, cancel).layers)
    if (layer.meaning.statistic == Statistic::difference && layer.name.ends_with("_difference"))
      a.layers.push_back(std::move(layer));
}

/// What restricts the maps of either, said once where it is said of both.
std::vector<std::string> warnings_of(const std::array<OpenedEnsemble, 2>& both) {
  const auto of = [&](std::size_t k) {
    return still_true(both[k].finished.manifest.warnings, both[k].members->members());
  };
  const std::vector<std::string> a = of(0), b = of(1);
  const auto has = [](const std::vector<std::string>& list, const std::string& w) {
    return std::find(list.begin(), list.end(), w) != list.end();
  };
  std::vector<std::string> all;
  for (const std::string& w : a) all.push_back(has(b, w) ? w : fmt::format("A: {}", w));
  for (const std::string& w : b)
    if (!has(a, w)) all.push_back(fmt::format("B: {}", w));
  return all;
}

bool has_maps(const OpenedEnsemble& ensemble) {
  std::error_code ignored;
  return !ensemble.finished.manifest.hazard_hash.empty() &&
         std::filesystem::exists(ensemble.finished.folder.hazard_nc(), ignored);
}

}  // namespace

bool write_comparison_page(const std::filesystem::path& out,
                           const std::array<OpenedEnsemble, 2>& both,
                           const LayerSource& differences, const Compared& made,
                           CancelFlag cancel) {
  const std::filesystem::path file = out / "report.html";
  if (!has_maps(both[0]) || !has_maps(both[1])) {
    std::filesystem::remove(file);
    return false;
  }
  const Grid& cells = differences.about().grid;
  LayerStack a = maps_of(both[0], cells, cancel);
  const LayerStack b = maps_of(both[1], cells, cancel);
  add_differences(a, differences, cancel);
  const FinishedFolder& first = both[0].finished;
  const auto ground = ground_of_map(first.scenario, *first.inputs, cells);
  const double area = cells.cell_m * cells.cell_m;
  ComparisonShown shown{both[0].name(), both[1].name(), &b};
  shown.pairs = made.n_pairs, shown.valid_a = made.n_a, shown.valid_b = made.n_b;
  shown.least = made.summary.least, shown.most = made.summary.most;
  shown.less_m2 = static_cast<double>(made.summary.n_less) * area;
  shown.more_m2 = static_cast<double>(made.summary.n_more) * area;
  shown.cut_off = made.cut_off;
  shown.differences = made.differences;
  ReportInput input;
  if (!first.scenario.report.language.empty()) input.language = first.scenario.report.language;
  input.title = first.scenario.title;
  input.hazard = &a;
  input.comparison = &shown;
  input.elevation = ground.get();
  input.overlays = first.inputs->overlays;
  input.observed = first.inputs->observed;
  input.observed_note = first.scenario.hazard.observed_note;
  input.warnings = warnings_of(both);
  input.cancel = cancel;
  input.manifest = {{"program", fmt::format("sturz {} ({})", version, git_commit)},
                    {"ensemble A", both[0].name()},
                    {"maps of A", first.manifest.hazard_hash},
                    {"ensemble B", both[1].name()},
                    {"maps of B", both[1].finished.manifest.hazard_hash}};
  write_text_atomic(file, make_report(input));
  return true;
}

}  // namespace sturz::workflow
