// SPDX-License-Identifier: Apache-2.0
// What a region's maps hold besides their values.
#include "ensemble/hazard/map_units.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "ensemble/region/region_maps.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <utility>

namespace sturz {
namespace {

/// A name as a class may be called: letters, digits and single spaces.
std::string class_words(const std::string& name, std::size_t number) {
  std::string words;
  for (const char c : name) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (kept)
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  }
  if (words.ends_with(' ')) words.pop_back();
  return words.empty() ? fmt::format("source {}", number) : words;
}

Layer likeliest_layer(std::span<const RegionSource> sources) {
  Layer layer =
      plain_layer("most_likely_source", {Quantity::sources, Statistic::value},
                  "source that reaches the cell most often", "1",
                  "largest p of a source; of equal ones that with the larger mean peak "
                  "thickness there, of these the first; numbers as in sources.csv, 0 none");
  for (std::size_t i = 0; i < sources.size(); ++i)
    layer.classes.push_back({static_cast<int>(i) + 1, class_words(sources[i].name, i + 1)});
  return layer;
}

}  // namespace

RegionLayers region_layers(const Grid& grid, std::span<const RegionSource> of,
                           std::span<const double> quantiles, int n_censored, std::int64_t n_rows) {
  RegionLayers region;
  region.layers.stack.grid = grid;
  const std::string cut =
      n_censored > 0
          ? fmt::format("; a lower bound: the end of {} members was not seen", n_censored)
          : "";
  const auto add = [&](Layer layer, double untouched = 0) {
    layer.n_censored = n_censored;
    region.layers.stack.layers.push_back(std::move(layer));
    region.layers.untouched.push_back(static_cast<float>(untouched));
  };
  using enum Quantity;
  const auto add_probability = [&](const std::string& name, const std::string& meaning,
                                   const std::string& rule, const std::string& rule_of_bounds) {
    add(plain_layer(name, {sources, Statistic::probability}, meaning, "1", rule + cut));
    add(bound_layer(name + "_lower", {sources, Statistic::lower_bound}, meaning, 0.9,
                    rule_of_bounds + cut));
    add(bound_layer(
            name + "_upper", {sources, Statistic::upper_bound}, meaning, 0.9,
            rule_of_bounds + (n_censored > 0 ? "; not an upper bound of what was not seen" : "")),
        wilson_interval(0, n_rows, z_90).upper);
  };
  add(plain_layer(
      likeliest_source_layer, {reached, Statistic::probability},
      "probability that the cell is reached if its likeliest source releases", "1",
      "largest p of a source, p = its members that reach the cell / its valid members" + cut));
  add_probability(
      "probability_of_any_hit",
      "probability that some source reaches the cell if all release, independent",
      "1 - product of (1 - p) over the sources: each with uncertain values of its own",
      "90 %: 1 - product of (1 - bound of p) over the sources that come, bounds of Wilson; those "
      "that do not come count together as one that came in none of the rows of the design");
  add_probability("probability_of_any_hit_shared_values",
                  "probability that some source reaches the cell if all release with the same "
                  "values",
                  "share of the rows of the design in which some source reaches the cell",
                  "90 % Wilson interval of the share of rows");
  add(plain_layer("expected_number_of_sources", {Quantity::sources, Statistic::value},
                  "expected number of sources that reach the cell if all release", "1",
                  "sum of p over the sources" + cut));
  add(plain_layer("number_of_sources", {Quantity::sources, Statistic::value},
                  "number of sources of which some member reaches the cell", "1", "p > 0" + cut));
  add(likeliest_layer(of));
  if (quantiles.empty()) return region;
  constexpr std::pair<PeakLayer, const char*> peaks[] = {{PeakLayer::thickness, "thickness"},
                                                         {PeakLayer::speed, "speed"},
                                                         {PeakLayer::energy, "energy"},
                                                         {PeakLayer::pressure, "pressure"}};
  for (const auto& [source, word] : peaks) {
    Layer layer = plain_layer(
        std::string(word) + "_largest_quantile", {quantity_of(source), Statistic::source_quantile},
        fmt::format("largest of the sources' quantiles of {}", info(source).long_name),
        map_unit(source).name,
        "if that source releases: over all its valid members, 0 where one did not "
        "come" +
            cut);
    layer.cell_methods = "time: maximum";
    layer.axis = LayerAxis{"quantile", "", "1", {quantiles.begin(), quantiles.end()}};
    add(std::move(layer));
  }
  return region;
}

}  // namespace sturz
