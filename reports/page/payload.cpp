// SPDX-License-Identifier: Apache-2.0
#include "reports/page/payload.hpp"

#include "ensemble/censoring/rank_agreement.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "reports/figures/cell_outline.hpp"
#include "reports/figures/codec.hpp"
#include "reports/figures/figures.hpp"
#include "reports/figures/legend.hpp"
#include "reports/figures/motion_charts.hpp"
#include "reports/page/crs_text.hpp"
#include "reports/page/headline.hpp"
#include "reports/page/overlay_payload.hpp"
#include "reports/page/region_payload.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/texts/text_table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sturz {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_scatter_members = 2000;
constexpr int steps = 4000;

/// Rounded to five significant digits: what a plot can show, and short in JSON. NaN becomes null.
Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 4);
  const double short_value = std::round(value / unit) * unit;
  return std::stod(plain_number(short_value, 5));
}

Json grid_json(const Grid& g) {
  return {{"cols", g.n_cols},
          {"rows", g.n_rows},
          {"west", g.west_m},
          {"north", g.north_m},
          {"cell", g.cell_m}};
}

Json plane_json(const std::vector<float>& values, int n_cols, int n_members) {
  const Quantised q = quantise(values, n_members);
  PackedCodes packed = pack_codes(q.codes, n_cols);
  return {{"square", q.square}, {"offset", q.offset},  {"factor", q.factor},
          {"nodata", q.nodata}, {"bits", packed.bits}, {"data", std::move(packed.data)}};
}

Json ground_json(const Raster<double>& ground) {
  std::vector<float> heights(ground.values.size(), nan_f);
  double lowest = INFINITY, highest = -INFINITY;
  for (const double z : ground.values)
    if (std::isfinite(z)) lowest = std::min(lowest, z), highest = std::max(highest, z);
  if (!(lowest <= highest)) return nullptr;
  // Steps of a quarter metre (finer on low relief): contours and hover need no more.
  const double factor =
      std::max(std::min(0.25, (highest - lowest) / 2000), (highest - lowest) / 65000);
  std::vector<std::uint16_t> codes;
  for (const double z : ground.values)
    codes.push_back(std::isfinite(z) && factor > 0
                        ? static_cast<std::uint16_t>(std::lround((z - lowest) / factor))
                        : static_cast<std::uint16_t>(std::isfinite(z) ? 0 : 65535));
  PackedCodes packed = pack_codes(codes, ground.grid.n_cols);
  return {{"grid", grid_json(ground.grid)},
          {"square", false},
          {"offset", lowest},
          {"factor", factor},
          {"nodata", 65535},
          {"bits", packed.bits},
          {"data", std::move(packed.data)}};
}

/// [[x0, y0, x1, y1], ...] around the cells that the release covers.
Json release_json(const Raster<std::uint8_t>* release) {
  Json lines = Json::array();
  if (release != nullptr)
    for (const MapLine& l : cell_outline(*release)) lines.push_back({l.x0, l.y0, l.x1, l.y1});
  return lines;
}

/// {"label": ..., "rings": [[[x, y], ...], ...]}; null where nothing was observed.
Json observed_json(const ReportInput& input) {
  if (input.observed.empty()) return nullptr;
  Json rings = Json::array();
  for (const auto& ring : input.observed) {
    Json points = Json::array();
    for (const Vec2& p : ring) points.push_back({p.x(), p.y()});
    rings.push_back(std::move(points));
  }
  return {{"label", observed_label(input.observed_note)}, {"rings", std::move(rings)}};
}

/// {"label": ..., "lines": [[x0, y0, x1, y1], ...]}; null where no member is scored.
Json nearest_json(const ReportInput& input) {
  if (input.nearest == nullptr) return nullptr;
  return {{"label", nearest_label(input.nearest_member, input.hazard == nullptr)},
          {"lines", release_json(input.nearest)}};
}

/// [{"kind": "grains", "label": ..., "lines": [[x0, y0, x1, y1], ...]}, ...]
Json fronts_json(const LayerStack& maps) {
  Json fronts = Json::array();
  for (const FrontMark& front : front_marks(maps)) {
    Json lines = Json::array();
    for (const MapLine& l : front.lines) lines.push_back({l.x0, l.y0, l.x1, l.y1});
    fronts.push_back(
        {{"kind", style_word(front.phase)}, {"label", front.label}, {"lines", std::move(lines)}});
  }
  return fronts;
}

Json legend_json(const Legend& legend) {
  Json classes = Json::array();
  for (const auto& c : legend.classes)
    classes.push_back({{"lower", c.lower}, {"label", c.label}, {"colour", hex_text(c.colour)}});
  return {{"title", legend.title},
          {"unit", legend.unit.label},
          {"unitFactor", legend.unit.factor},
          {"probability", legend.probability},
          {"clearZero", legend.clear_zero},
          {"diverging", legend.diverging},
          {"nominal", legend.nominal},
          {"classes", classes}};
}

/// Files say "members / valid members"; readers of the page get the number.
std::string shown_comment(const Layer& layer, int n_valid) {
  constexpr std::string_view counted = "members / valid members";
  if (!layer.comment.starts_with(counted)) return layer.comment;
  return tr("layer.share_of", n_valid) + layer.comment.substr(counted.size());
}

Json layer_json(const MapScene& scene, const LayerStack& maps, const Layer& layer,
                const ReportInput& input, int n_valid) {
  const LayerMeaning& meaning = layer.meaning;
  Json planes = Json::array();
  for (std::size_t k = 0; k < layer.n_planes(); ++k) {
    input.cancel.check();
    Json plane = plane_json(scene_plane(scene, layer, k, maps.grid), scene.cells.n_cols, n_valid);
    plane["label"] = plane_label(layer, k);
    plane["title"] = plane_title(layer, k);
    if (!layer.axis.values.empty()) {
      const double value = layer.axis.values[k];
      plane["axis"] = display_unit(layer.axis.units).factor * value;
      plane["resolved"] = !(meaning.statistic == Statistic::probability &&
                            layer.axis.units == "m" && value < input.resolved_thickness_m);
    }
    planes.push_back(std::move(plane));
  }
  return {{"name", layer.name},
          {"quantity", to_string(meaning.quantity)},
          {"quantityTitle", title(meaning.quantity)},
          {"material",
           phase_of(meaning.quantity) == Phase::both ? "" : style_word(phase_of(meaning.quantity))},
          {"short", short_title(meaning.quantity)},
          {"statistic", to_string(meaning.statistic)},
          {"longName", layer.long_name},
          {"comment", shown_comment(layer, n_valid)},
          {"axisUnit", display_unit(layer.axis.units).label},
          {"legend", legend_json(legend_for(layer))},
          {"planes", std::move(planes)}};
}

Json maps_json(const ReportInput& input, const MapScene& scene, const LayerStack& maps,
               int n_valid) {
  Json layers = Json::array();
  const Layer* first = default_layer(maps);
  int start = 0;
  for (const Layer* layer : shown_layers(maps)) {
    if (layer == first) start = static_cast<int>(layers.size());
    layers.push_back(layer_json(scene, maps, *layer, input, n_valid));
  }
  return {{"cells", grid_json(scene.cells)},
          {"ground", ground_json(scene.ground)},
          {"view", grid_json(scene.ground.grid)},
          {"start", start},
          {"system", system_text(maps.grid.crs_wkt)},
          {"release", release_json(input.release)},
          {"observed", observed_json(input)},
          {"nearest", nearest_json(input)},
          {"fronts", fronts_json(maps)},
          {"overlays", overlays_json(input.overlays)},
          {"orthophoto", orthophoto_json(input, scene.ground.grid)},
          {"layers", std::move(layers)}};
}

/// The maps of the second of two ensembles, to be seen beside those of the first.
Json beside_json(const ReportInput& input, const MapScene& scene) {
  const ComparisonShown& c = *input.comparison;
  Json layers = Json::array();
  for (const Layer* layer : shown_layers(*c.b))
    layers.push_back(layer_json(scene, *c.b, *layer, input, static_cast<int>(c.valid_b)));
  return {{"nameA", c.name_a},
          {"nameB", c.name_b},
          {"valid", c.valid_b},
          {"layers", std::move(layers)}};
}

/// Whether the runout grows with sampled key `k`, over the shown members.
Json agreement_json(const ReportInput& input, const std::vector<std::size_t>& rows, std::size_t k) {
  std::vector<double> parameter;
  std::vector<Observation> runout;
  for (const std::size_t i : rows) {
    const MemberSummary& m = input.members[i];
    if (!is_valid(m.outcome)) continue;
    parameter.push_back(input.samples.rows[i][k]);
    runout.push_back({m.scalars.runout_m, known(&MemberScalars::runout_m, m.scalars, m.censoring)});
  }
  const RankAgreement found = rank_agreement(parameter, runout);
  return {{"tau", rounded(found.tau)}, {"ordered", found.ordered}, {"pairs", found.pairs}};
}

/// An end that is not known becomes null, like one that cannot be told.
Json median_json(const CensoredEstimate& e) {
  return {{"median", rounded(e.value)},  {"least", rounded(e.least)}, {"most", rounded(e.most)},
          {"atLeast", e.at_least},       {"lower", rounded(e.lower)}, {"upper", rounded(e.upper)},
          {"open", std::isinf(e.upper)}, {"weighted", e.weighted}};
}

/// Columns of the scatter plots and the histogram: evenly thinned when there are very many.
Json members_json(const ReportInput& input) {
  const std::size_t n = input.members.size();
  const std::size_t stride = (n + max_scatter_members - 1) / max_scatter_members;
  Json numbers = Json::array(), outcomes = Json::array(), valid = Json::array();
  Json cut = Json::array();  // the runout is known to be at least what it is
  Json scalars = Json::object(), samples = Json::array();
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(1, stride)) rows.push_back(i);
  for (const std::size_t i : rows) {
    numbers.push_back(input.members[i].member);
    outcomes.push_back(to_string(input.members[i].outcome));
    valid.push_back(is_valid(input.members[i].outcome));
    cut.push_back(known(&MemberScalars::runout_m, input.members[i].scalars,
                        input.members[i].censoring) != Known::exactly);
  }
  const auto column = [&](double MemberScalars::*field) {
    Json values = Json::array();
    for (const std::size_t i : rows) values.push_back(rounded(input.members[i].scalars.*field));
    return values;
  };
  scalars["runout"] = column(&MemberScalars::runout_m);
  scalars["area"] = column(&MemberScalars::reached_area_m2);
  if (!input.samples.rows.empty())
    for (std::size_t k = 0; k < input.samples.columns.size(); ++k) {
      Json values = Json::array();
      for (const std::size_t i : rows) values.push_back(rounded(input.samples.rows[i][k]));
      const std::string unit =
          k < input.samples.units.size() ? display_unit(input.samples.units[k]).label : "";
      const double factor =
          k < input.samples.units.size() ? display_unit(input.samples.units[k]).factor : 1;
      samples.push_back({{"key", input.samples.columns[k]},
                         {"label", key_label(input.samples, k)},
                         {"unit", unit},
                         {"factor", factor},
                         {"agreement", agreement_json(input, rows, k)},
                         {"values", std::move(values)}});
    }
  return {{"total", n}, {"member", numbers},  {"outcome", outcomes}, {"valid", valid},
          {"cut", cut}, {"scalars", scalars}, {"samples", samples}};
}

/// What the convergence chart can follow, each with the number of members.
Json convergence_json(const std::vector<ConvergencePoint>& points) {
  struct Column {
    const char* key;  ///< of its text
    const char* unit;
    double factor;
    double ConvergencePoint::*field;
  };
  static constexpr Column columns[] = {
      {"convergence.area_50", "ha", 1e-4, &ConvergencePoint::area_likely_m2},
      {"convergence.area_5", "ha", 1e-4, &ConvergencePoint::area_possible_m2},
      {"convergence.mean_p", "%", 100, &ConvergencePoint::mean_probability_reached},
      {"convergence.half_width", "%", 100, &ConvergencePoint::mean_half_width}};
  Json n = Json::array(), series = Json::array();
  for (const auto& p : points) n.push_back(p.n_members);
  for (const auto& c : columns) {
    Json values = Json::array();
    for (const auto& p : points) values.push_back(rounded(c.factor * p.*c.field));
    series.push_back({{"label", tr(c.key)}, {"unit", c.unit}, {"values", values}});
  }
  return {{"n", n}, {"series", series}};
}

Json motion_json(const MemberHistory& history) {
  const auto numbers = [](const std::vector<double>& values) {
    Json all = Json::array();
    for (const double v : values) all.push_back(rounded(v));
    return all;
  };
  Json charts = Json::array();
  for (const MotionChart& chart : motion_charts(history)) {
    Json lines = Json::array();
    for (const MotionLine& line : chart.lines)
      lines.push_back({{"label", line.label.substr(0, line.label.find(':'))},
                       {"paint", line.paint},
                       {"values", numbers(line.values)}});
    charts.push_back({{"name", chart.name},
                      {"unit", chart.unit},
                      {"top", chart.top},
                      {"stacked", chart.stacked},
                      {"lines", lines}});
  }
  return {{"time", numbers(motion_times(history))}, {"charts", charts}};
}

/// The legend is that of the largest thickness over all times, so that colours can be followed.
Json frames_json(const ReportInput& input) {
  const FramesShown& frames = *input.frames;
  Layer layer;
  layer.meaning = {Quantity::thickness, Statistic::peak};
  layer.units = "m";
  Json times = Json::array(), planes = Json::array();
  for (std::size_t k = 0; k < frames.times_s.size(); ++k) {
    input.cancel.check();
    times.push_back(rounded(frames.times_s[k]));
    planes.push_back(plane_json(frames.thickness[k], frames.grid.n_cols, 0));
    layer.values.insert(layer.values.end(), frames.thickness[k].begin(), frames.thickness[k].end());
  }
  return {{"label",
           input.hazard == nullptr ? tr("frames.this_run") : tr("frames.member", frames.member)},
          {"grid", grid_json(frames.grid)},
          {"legend", legend_json(legend_for(layer))},
          {"times", std::move(times)},
          {"planes", std::move(planes)}};
}

}  // namespace

Quantised quantise(const std::vector<float>& values, int n_members) {
  Quantised q;
  float low = INFINITY, high = -INFINITY;
  bool whole = true, shares = n_members > 0 && n_members < 65535;
  for (const float v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v), high = std::max(high, v);
    whole = whole && v == std::floor(v) && v >= 0 && v < 65535;
    const double k = static_cast<double>(v) * n_members;
    shares = shares && v >= 0 && v <= 1 && std::abs(k - std::round(k)) < 1e-3;
  }
  const bool any = low <= high;
  if (any && shares) {
    q.factor = 1.0 / n_members;
    if (n_members < 255) q.nodata = 255;
  } else if (any && whole) {
    if (high < 255) q.nodata = 255;
  } else if (any) {
    q.square = low >= 0;
    q.factor = q.square ? high / (static_cast<double>(steps) * steps) : (high - low) / (steps - 1);
    // A whole number of steps: 0, which is no change in a map of differences, stays 0.
    q.offset = q.square ? 0 : q.factor > 0 ? q.factor * std::floor(low / q.factor) : low;
    q.nodata = steps + 1;
  }
  for (const float v : values) {
    if (!std::isfinite(v) || q.factor <= 0) {
      q.codes.push_back(static_cast<std::uint16_t>(std::isfinite(v) ? 0 : q.nodata));
      continue;
    }
    const double scaled = (v - q.offset) / q.factor;
    auto code = static_cast<std::uint16_t>(std::lround(q.square ? std::sqrt(scaled) : scaled));
    if (q.square && v > 0 && code == 0) code = 1;  // what was touched stays touched
    q.codes.push_back(code);
  }
  return q;
}

std::string report_payload(const ReportInput& input, const MapScene* scene,
                           const LayerStack* maps) {
  const Headline h = headline(input);
  const int valid =
      input.comparison != nullptr ? static_cast<int>(input.comparison->valid_a) : h.n_valid;
  Json page{{"z", 1.959964},  // of ensemble/hazard/wilson.hpp
            {"valid", valid},
            {"weighted", input.effective_members > 0},
            {"trials", input.effective_members > 0 ? input.effective_members : valid},
            {"single", input.hazard == nullptr},
            {"runout", median_json(h.runout_m)}};
  page["texts"] = Json::parse(script_texts());
  page["members"] = members_json(input);
  if (input.region != nullptr && scene != nullptr)
    page["region"] = sources_json(*input.region, *scene);
  if (input.frames != nullptr && scene != nullptr) page["frames"] = frames_json(input);
  if (input.history != nullptr) page["motion"] = motion_json(*input.history);
  page["convergence"] = convergence_json(input.convergence);
  if (scene != nullptr && maps != nullptr && default_layer(*maps) != nullptr)
    page["maps"] = maps_json(input, *scene, *maps, valid);
  if (scene != nullptr && input.comparison != nullptr) page["beside"] = beside_json(input, *scene);
  return page.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sturz
