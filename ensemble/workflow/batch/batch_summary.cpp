// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/batch_summary.hpp"

#include "engine/core/error.hpp"
#include "io/features/cell_polygons.hpp"
#include "io/features/feature_file.hpp"
#include "io/files/checksum.hpp"
#include "io/files/plain_text.hpp"
#include "io/files/text_files.hpp"
#include "reports/batch/batch_page.hpp"
#include "scenarios/layers/feature_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

/// From the results' folder, so that all of it may move.
std::string shown_folder(const BatchDone& done, const BatchRow& row) {
  return row.folder.empty() ? std::string() : row.folder.lexically_proximate(done.root).string();
}

const AssetChance* most_probable(const BatchFigures& figures) {
  const AssetChance* best = nullptr;
  for (const AssetChance& asset : figures.assets)
    if (asset.probability > (best == nullptr ? 0 : best->probability)) best = &asset;
  return best;
}

std::string chances_text(const BatchFigures& figures) {
  std::string text;
  for (const AssetChance& a : figures.assets)
    text += fmt::format("{}{}={}", text.empty() ? "" : "; ", a.name,
                        std::isnan(a.probability) ? "" : fmt::format("{:.4g}", a.probability));
  return text;
}

std::string at_least_text(const BatchFigures& figures) {
  constexpr std::array<const char*, 3> names{"q05", "q50", "q95"};
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (figures.at_least[i]) text += fmt::format("{}{}", text.empty() ? "" : " ", names[i]);
  return text;
}

/// Columns, filled row by row.
class Columns {
 public:
  explicit Columns(const BatchDone& done) : done_(done) { table_.wkb.resize(done.rows.size()); }
  template <class Get>
  void text(const char* name, Get get) {
    std::vector<std::string> values;
    for (const BatchRow& row : done_.rows) values.push_back(as_utf8(get(row)));
    table_.columns.push_back({name, std::move(values)});
  }
  template <class Get>
  void number(const char* name, Get get) {
    std::vector<double> values;
    for (const BatchRow& row : done_.rows) values.push_back(get(row));
    table_.columns.push_back({name, std::move(values)});
  }
  /// Of the rows that have results.
  template <class Get>
  void figure(const char* name, Get get) {
    number(name, [&](const BatchRow& r) { return r.figures ? double(get(*r.figures)) : nan_d; });
  }
  template <class Get>
  void figure_text(const char* name, Get get) {
    text(name, [&](const BatchRow& r) { return r.figures ? get(*r.figures) : std::string(); });
  }
  std::string csv() const { return to_csv(table_); }

 private:
  const BatchDone& done_;
  FeatureTable table_;
};

/// Which results outlines.gpkg shows.
std::string outlines_key(const BatchDone& done) {
  std::string text;
  for (const BatchRow& row : done.rows)
    if (row.figures)
      text +=
          fmt::format("{}\n{}\n{}\n", row.name, shown_folder(done, row), row.figures->hazard_hash);
  return text_checksum(text);
}

/// One feature of each job and level in which cells are reached; a layer for each coordinate
/// system.
class Outlines {
 public:
  void add(const BatchDone& done, const BatchRow& row) {
    const Raster<float> map = reached_map(row.folder);
    const std::string& crs = map.grid.crs_wkt;
    for (std::size_t i = 0; i < outline_levels.size(); ++i) {
      std::string wkb = cells_as_polygons(cells_reached(map, outline_levels[i]));
      if (wkb.empty()) continue;
      Layer& to = layers_[crs];
      to.wkb.push_back(std::move(wkb));
      to.job.push_back(row.name);
      to.level.push_back(level_text(outline_levels[i]));
      to.folder.push_back(shown_folder(done, row));
      to.at_least.push_back(outline_levels[i]);
      to.area.push_back(row.figures->area_m2[i]);
      to.valid.push_back(row.figures->valid);
    }
  }

  std::vector<FeatureTable> tables() && {
    std::vector<FeatureTable> all;
    for (auto& [crs, layer] : layers_) {
      FeatureTable& table = all.emplace_back();
      table.name = all.size() == 1 ? "outlines" : fmt::format("outlines_{}", all.size());
      table.crs_wkt = crs;
      table.wkb = std::move(layer.wkb);
      table.columns = {{"job", std::move(layer.job)},
                       {"level", std::move(layer.level)},
                       {"probability_at_least", std::move(layer.at_least)},
                       {"area_m2", std::move(layer.area)},
                       {"valid_members", std::move(layer.valid)},
                       {"folder", std::move(layer.folder)}};
    }
    return all;
  }

 private:
  struct Layer {
    std::vector<std::string> wkb, job, level, folder;
    std::vector<double> at_least, area;
    std::vector<std::int64_t> valid;
  };
  std::map<std::string, Layer> layers_;
};

void write_outlines(const BatchDone& done, BatchState& state, CancelFlag cancel) {
  const std::string key = outlines_key(done);
  std::error_code ignored;
  if (state.outlines_of == key && fs::exists(done.outlines, ignored)) return;
  Outlines outlines;
  for (const BatchRow& row : done.rows) {
    cancel.check();
    if (row.figures && row.figures->valid > 0) outlines.add(done, row);
  }
  const std::vector<FeatureTable> tables = std::move(outlines).tables();
  if (tables.empty())
    fs::remove(done.outlines, ignored);
  else
    write_geopackage(done.outlines, tables);
  state.outlines_of = key;
}

BatchPageRow page_row(const BatchDone& done, const BatchRow& row) {
  BatchPageRow out;
  out.job = as_utf8(row.name);
  out.title = as_utf8(row.title);
  out.state = to_string(row.state);
  out.why = as_utf8(row.why);
  out.message = as_utf8(row.message);
  out.single_run = row.single_run;
  out.utilisation = row.utilisation;
  if (!row.figures) return out;
  const BatchFigures& f = *row.figures;
  out.link = as_utf8(shown_folder(done, row)) + "/report.html";
  out.valid = f.valid;
  out.finished = f.finished;
  out.planned = f.planned;
  out.censored = f.censored;
  out.runout_m = f.runout_m;
  out.at_least = f.at_least;
  out.area_any_m2 = f.area_m2[0];
  out.area_half_m2 = f.area_m2[2];
  out.core_s = f.core_s;
  out.n_assets = f.assets.size();
  if (const AssetChance* best = most_probable(f)) {
    out.asset = as_utf8(best->name);
    out.asset_probability = best->probability;
  }
  return out;
}

std::string page_of(const BatchDone& done) {
  BatchPage page;
  page.list = as_utf8(fs::path(done.spec.source).filename().string());
  page.when = utc_now();
  page.program = build_text(this_build());
  page.stop = as_utf8(done.stop.text);
  page.core_s = done.core_s;
  page.wall_s = done.wall_s;
  page.utilisation = done.utilisation();
  page.cores = done.cores;
  page.low_utilisation = done.low_utilisation;
  for (const BatchRow& row : done.rows) page.rows.push_back(page_row(done, row));
  return make_batch_page(page);
}

}  // namespace

std::string summary_csv(const BatchDone& done) {
  Columns c(done);
  c.text("job", [](const BatchRow& r) { return r.name; });
  c.text("mode", [](const BatchRow& r) { return r.single_run ? "run" : "ensemble"; });
  c.text("state", [](const BatchRow& r) { return to_string(r.state); });
  c.text("why", [](const BatchRow& r) { return r.why; });
  c.text("message", [](const BatchRow& r) { return r.message; });
  using F = BatchFigures;
  c.figure("members", [](const F& f) { return f.planned; });
  c.figure("valid", [](const F& f) { return f.valid; });
  c.figure("failed", [](const F& f) { return f.failed(); });
  c.figure("censored", [](const F& f) { return f.censored; });
  c.figure("runout_q05_m", [](const F& f) { return f.runout_m[0]; });
  c.figure("runout_q50_m", [](const F& f) { return f.runout_m[1]; });
  c.figure("runout_q95_m", [](const F& f) { return f.runout_m[2]; });
  c.figure_text("runout_at_least", at_least_text);
  c.figure("area_any_m2", [](const F& f) { return f.area_m2[0]; });
  c.figure("area_p10_m2", [](const F& f) { return f.area_m2[1]; });
  c.figure("area_p50_m2", [](const F& f) { return f.area_m2[2]; });
  c.figure("assets", [](const F& f) { return f.assets.size(); });
  c.figure_text("highest_asset", [](const F& f) {
    const AssetChance* best = most_probable(f);
    return best == nullptr ? std::string() : best->name;
  });
  c.figure("highest_asset_probability", [](const F& f) {
    const AssetChance* best = most_probable(f);
    return best == nullptr ? nan_d : best->probability;
  });
  c.figure_text("asset_probabilities", chances_text);
  c.figure("core_s", [](const F& f) { return std::round(100 * f.core_s) / 100; });
  c.number("utilisation",
           [](const BatchRow& r) { return std::round(1000 * r.utilisation) / 1000; });
  c.text("folder", [&](const BatchRow& r) { return shown_folder(done, r); });
  c.figure_text("hazard_hash", [](const F& f) { return f.hazard_hash; });
  return c.csv();
}

void write_summary(BatchDone& done, BatchState& state, CancelFlag cancel) {
  done.csv = done.root / "summary.csv";
  done.page = done.root / "summary.html";
  done.outlines = done.root / "outlines.gpkg";
  write_text_atomic(done.csv, summary_csv(done));
  write_text_atomic(done.page, page_of(done));
  if (!cancel.raised()) write_outlines(done, state, cancel);  // else with the next call
}

}  // namespace sturz::workflow
