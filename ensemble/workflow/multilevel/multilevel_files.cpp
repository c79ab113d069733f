// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "ensemble/hazard/map_units.hpp"
#include "ensemble/workflow/multilevel/multilevel_results.hpp"
#include "ensemble/workflow/multilevel/multilevel_words.hpp"
#include "ensemble/workflow/results/asset_files.hpp"
#include "ensemble/workflow/results/hazard_file.hpp"
#include "ensemble/workflow/results/json_numbers.hpp"
#include "ensemble/workflow/results/map_files.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/files/text_files.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "io/site/map_ground.hpp"
#include "reports/fidelity/multilevel_page.hpp"
#include "scenarios/layers/coarse_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace sturz::workflow {
namespace {

Json headline_json(const MultilevelHeadline& h) {
  Json quantiles = Json::array();
  for (const QuantileEstimate& q : h.quantiles) {
    Json one{{"level", q.level}, {"value", number(q.value)}, {"bounds_90", interval(q.bounds_90)}};
    if (q.draws_needed > 0) {
      const bool lower = std::isinf(q.bounds_90.low), upper = std::isinf(q.bounds_90.high);
      one["not_told"] = lower && upper ? "both bounds" : lower ? "lower bound" : "upper bound";
      one["draws_needed"] = q.draws_needed;
    }
    quantiles.push_back(std::move(one));
  }
  return {{"name", h.name},
          {"units", h.units},
          {"mean", number(h.scalar.mean.mean)},
          {"bounds_90", interval(h.scalar.mean.bounds_90())},
          {"standard_error", number(h.scalar.mean.standard_error)},
          {"sampling_90", number(h.sampling)},
          {"resolution", number(h.resolution)},
          {"model", number(h.model)},
          {"model_of", h.model_of},
          {"model_standard_error", number(h.model_error)},
          {"standard_deviation", number(std::sqrt(h.scalar.variance))},
          {"quantiles", quantiles},
          {"draws", numbers(h.scalar.draws)},
          {"left_out", h.left_out},
          {"variances", numbers(h.scalar.variances)},
          {"squared_correlations", numbers(h.scalar.squared_correlations)},
          {"plain_cpu_s", number(h.plain_seconds)}};
}

Json level_json(const LevelShare& l) {
  return {{"name", l.name},
          {"used", l.used},
          {"members", l.members},
          {"valid", l.valid},
          {"censored", l.censoring.censored()},
          {"too_many_censored", l.censoring.too_many()},
          {"unpaired", l.unpaired},
          {"member_cpu_s", number(l.member_cpu_s)},
          {"cpu_s", number(l.seconds)},
          {"variance_shares", numbers(l.variance_shares)}};
}

Json maps_json(const MultilevelMade& made) {
  Json all = Json::array();
  for (const NamedMap& map : made.maps)
    for (std::size_t t = 0; t < map.maps.size(); ++t) {
      const MultilevelMap& m = map.maps[t];
      all.push_back(
          {{"name", map.name},
           {"threshold", map.thresholds.empty() ? Json(nullptr) : Json(map.thresholds[t])},
           {"doubtful_cells", m.doubtful},
           {"rms_standard_error", number(m.rms_error)},
           {"variances", numbers(m.variances)},
           {"plain_variance", number(m.plain_variance)},
           {"upper_bound_told_cells",
            std::count(m.told.values.begin(), m.told.values.end(), std::uint8_t{1})},
           {"correction_over_cells", 2 * m.smoothed_cells + 1},
           {"smoothing_error", number(m.smoothing_error)}});
    }
  return all;
}

Json expected_json(const ExpectedValue& e) {
  return {{"mean", number(e.mean)}, {"standard_error", number(e.standard_error)}};
}

Json assets_json(const MultilevelMade& made) {
  Json all = Json::array();
  for (std::size_t a = 0; made.assets != nullptr && a < made.assets->list.size(); ++a) {
    const AssetRisk& r = made.risk.table.rows[a];
    Json one{{"name", made.assets->list[a].name},
             {"place", to_string(r.place)},
             {"probability", number(r.probability)},
             {"bounds_90", interval({r.bounds_90.lower, r.bounds_90.upper})},
             {"exceedances", Json::array()}};
    for (const AssetExceedance& e : made.risk.exceedances)
      one["exceedances"].push_back({{"of", exceedance_text(e)},
                                    {"probability", number(e.of[a].share)},
                                    {"bounds_90", interval(e.of[a].bounds_90)}});
    if (made.assets->has_classes) one["expected_damage"] = expected_json(r.damage);
    if (made.assets->has_values) one["expected_loss"] = expected_json(r.loss);
    if (!r.cut_off.empty()) one["cut_off"] = r.cut_off;
    all.push_back(std::move(one));
  }
  return all;
}

std::string rule_of(const MultilevelMade& made) {
  std::string levels;
  for (const std::size_t p : made.used)
    levels += fmt::format("{}{} of {}", levels.empty() ? "" : ", ", made.levels[p].members,
                          made.levels[p].name);
  return fmt::format("multilevel estimate for {} from members: {}", made.levels.front().name,
                     levels);
}

/// No value is no promise.
std::string untold_note(const MultilevelMade& made) {
  return fmt::format(
      "; no value where it is not told: none of {} members of {} comes there and cheaper ones "
      "foretell none, so that their number alone speaks, which leaves up to {:.0f} % everywhere",
      made.dear_draws, made.levels.front().name, 100 * unseen_share(made.dear_draws));
}

/// Where its upper bound is not told, a probability is written as 0.
const char* const zero_note =
    "; 0 where it is below 0.5 % and no upper bound is told, which is no promise";

/// What a map says of members of which mass left or still moved, as plain maps say it.
std::string cut_note(Statistic statistic, std::int64_t n_censored) {
  if (n_censored == 0) return {};
  return statistic == Statistic::upper_bound
             ? "; not an upper bound of what was not seen"
             : fmt::format("; a lower bound: the end of {} members was not seen", n_censored);
}

/// One map and its bounds, all planes.
void add_layers(LayerStack& stack, const NamedMap& map, const MultilevelMade& made) {
  const std::int64_t n_censored = made.censored;
  const Quantity quantity = map.thresholds.empty() ? Quantity::reached : quantity_of(map.layer);
  const std::string what =
      map.thresholds.empty()
          ? "probability that the flow reaches the cell"
          : fmt::format("probability that {} exceeds the threshold", info(map.layer).long_name);
  const std::string monotone =
      map.thresholds.empty() ? "" : "; made monotone in the threshold (pool adjacent violators)";
  struct Kind {
    const char* suffix;
    Statistic statistic;
    Raster<double> MultilevelMap::*values;
  };
  for (const Kind& kind : {Kind{"", Statistic::probability, &MultilevelMap::probability},
                           Kind{"_lower", Statistic::lower_bound, &MultilevelMap::low},
                           Kind{"_upper", Statistic::upper_bound, &MultilevelMap::high}}) {
    const std::string bounds = kind.statistic == Statistic::probability ? "" : "90 % bounds; ";
    const bool upper = kind.statistic == Statistic::upper_bound;
    const std::string comment = bounds + rule_of(made) + ", within 0 and 1" + monotone +
                                (upper ? untold_note(made) : "") +
                                (kind.statistic == Statistic::probability ? zero_note : "") +
                                cut_note(kind.statistic, n_censored);
    const LayerMeaning meaning{quantity, kind.statistic};
    Layer layer = meaning.is_bound()
                      ? bound_layer(map.name + kind.suffix, meaning, what, 0.9, comment)
                      : plain_layer(map.name, meaning, what, "1", comment);
    layer.n_censored = static_cast<int>(n_censored);
    if (!map.thresholds.empty()) {
      const std::string word = map.name.substr(0, map.name.find("_exceedance"));
      layer.axis = {word + "_threshold", "", map_unit(map.layer).name, map.thresholds};
    }
    for (const MultilevelMap& one : map.maps)
      for (std::size_t i = 0; i < one.told.values.size(); ++i)
        layer.values.push_back(upper && one.told.values[i] == 0
                                   ? nan_f
                                   : static_cast<float>((one.*kind.values).values[i]));
    stack.layers.push_back(std::move(layer));
  }
}

LayerStack stack_of(const MultilevelJob& job, const MultilevelMembers& found,
                    const MultilevelMade& made) {
  LayerStack stack;
  stack.grid = made.maps.front().maps.front().probability.grid;
  const EnsembleJob& own = found.jobs.front();
  const HazardContext context = hazard_context(own.manifest, job.scene.scenario, own.design);
  stack.attributes = context.attributes;
  stack.attributes.emplace_back("estimator", rule_of(made));
  for (const NamedMap& map : made.maps) add_layers(stack, map, made);
  return stack;
}

MultilevelPageResult page_result(const MultilevelHeadline& h) {
  MultilevelPageResult r;
  r.name = h.name;
  r.units = h.units;
  r.mean = h.scalar.mean.mean;
  const Interval bounds = h.scalar.mean.bounds_90();
  r.below = r.mean - bounds.low, r.above = bounds.high - r.mean;
  r.resolution = h.resolution;
  r.model = h.model;
  for (const QuantileEstimate& q : h.quantiles)
    r.quantiles.push_back({q.level, q.value, q.bounds_90.low, q.bounds_90.high});
  return r;
}

/// Their table on the page.
void add_assets(MultilevelPage& page, const MultilevelMade& made) {
  if (made.assets == nullptr) return;
  for (const AssetExceedance& e : made.risk.exceedances)
    page.exceedances.push_back(exceedance_text(e));
  for (std::size_t a = 0; a < made.assets->list.size(); ++a) {
    const AssetRisk& r = made.risk.table.rows[a];
    MultilevelPageAsset asset{made.assets->list[a].name, {}};
    // Who was cut off after it hit did hit; how hard in the end is open.
    asset.shares.push_back({r.probability, r.bounds_90.lower, r.bounds_90.upper, r.not_known > 0});
    for (const AssetExceedance& e : made.risk.exceedances)
      asset.shares.push_back({e.of[a].share, e.of[a].bounds_90.low, e.of[a].bounds_90.high,
                              r.not_known + r.hit_cut_off > 0});
    page.assets.push_back(std::move(asset));
  }
}

void write_page(const MultilevelJob& job, const MultilevelMade& made, const LayerStack& coarse) {
  MultilevelPage page;
  page.title = made.title.empty() ? made.folder.filename().string() : made.title;
  page.when = utc_now();
  page.program = build_text(this_build());
  page.sentences = page_sentences(made);
  page.warnings = made.cut_off;
  page.warnings.insert(page.warnings.end(), made.warnings.begin(), made.warnings.end());
  for (const MultilevelHeadline& h : made.headlines) page.results.push_back(page_result(h));
  for (const LevelShare& l : made.levels)
    page.levels.push_back({l.name, l.used, static_cast<double>(l.members), l.member_cpu_s,
                           l.seconds / made.seconds, l.variance_shares});
  add_assets(page, made);
  page.maps = &coarse;
  if (!made.maps.empty()) page.upper_bound_note = upper_bound_text(made);
  const auto ground = ground_of_map(job.scene.scenario, job.scene.inputs, coarse.grid);
  page.elevation = ground.get();
  write_text_atomic(OutputFolder{made.folder}.report(), make_multilevel_page(page));
}

}  // namespace

std::string multilevel_json_text(const MultilevelMade& made) {
  Json json{{"title", made.title},
            {"estimator", made.used.size() > 1 ? "multilevel" : "plain"},
            {"levels", Json::array()},
            {"headlines", Json::array()},
            {"maps", maps_json(made)},
            {"assets", assets_json(made)},
            {"map_error", number(made.map_error)},
            {"map_plain_cpu_s", number(made.map_plain_seconds)},
            {"cpu_s", number(made.seconds)},
            {"failed_members", made.failed},
            {"censored_members", made.censored},
            {"cut_off", made.cut_off},
            {"missed", made.missed},
            {"warnings", made.warnings}};
  if (made.assets != nullptr && made.assets->has_values)
    json["total_loss"] = expected_json(made.risk.table.total_loss);
  for (const LevelShare& l : made.levels) json["levels"].push_back(level_json(l));
  for (const MultilevelHeadline& h : made.headlines) json["headlines"].push_back(headline_json(h));
  return json.dump(2) + "\n";
}

void write_multilevel_files(const MultilevelJob& job, const MultilevelMembers& found,
                            const MultilevelMade& made, CancelFlag cancel) {
  const OutputFolder folder{made.folder};
  write_text_atomic(folder.root / "multilevel.json", multilevel_json_text(made));
  if (made.maps.empty()) {
    const EnsembleJob& own = found.jobs.front();
    HazardContext context = hazard_context(own.manifest, job.scene.scenario, own.design);
    context.cancel = cancel;
    write_hazard(folder.hazard_nc(), found.stores.front(), job.scene.scenario.hazard, context);
  } else {
    write_layers(folder.hazard_nc(), stack_of(job, found, made));
  }
  const LayersFileReader maps(folder.hazard_nc());
  const Grid& grid = maps.about().grid;
  if (made.assets == nullptr)
    write_asset_files(folder, std::nullopt, grid);
  else
    write_asset_table(folder, levelled_features(*made.assets, made.risk, grid.crs_wkt));
  const LayerStack coarse = coarse_layers(maps, page_cells, cancel);
  if (job.scene.scenario.hazard.gis_files)
    write_map_files(folder.tif_folder(), maps, coarse, cancel);
  else
    remove_map_files(folder.tif_folder());
  // Pictures have their bounds, which coarse layers leave out: the maps as they are, where they
  // fit.
  const LayerStack shown =
      maps.about().grid.n_cells() <= page_cells ? read_layers(folder.hazard_nc()) : coarse;
  write_page(job, made, shown);
}

}  // namespace sturz::workflow
