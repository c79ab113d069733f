// SPDX-License-Identifier: Apache-2.0
#include "ensemble/risk/rate_maps.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/map_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz {
namespace {

struct LevelMap {
  PeakLayer source;
  const char *word, *what;
};
constexpr std::array<LevelMap, 4> level_maps{
    {{PeakLayer::thickness, "thickness", "largest vertical flow thickness"},
     {PeakLayer::speed, "speed", "largest mass-averaged speed"},
     {PeakLayer::energy, "energy", "largest kinetic energy per area"},
     {PeakLayer::pressure, "pressure", "largest dynamic pressure"}}};

/// Places of the layers in the stack.
struct Places {
  std::size_t rate = 0, error = 1, high = 2, levels = 3, intensity = 7, field = 8, highest = 9;
};

/// Every field that classes() may give.
std::vector<LayerClass> matrix_fields() {
  std::vector<LayerClass> fields;
  for (const auto& [intensity, row] : {std::pair{"medium", 3}, std::pair{"strong", 6}})
    for (const auto& [probability, column] :
         {std::pair{"low", 1}, std::pair{"medium", 2}, std::pair{"high", 3}})
      fields.push_back(
          {row + column, fmt::format("{} intensity {} probability", intensity, probability)});
  return fields;
}

HazardLayers layers_of(const RiskSpec& spec, const Grid& grid, int n_censored) {
  const LayerAxis periods{"return_period", "", "year", spec.return_periods_years};
  const std::string cut =
      n_censored > 0 ? "; a lower bound: the end of some members was not seen" : "";
  HazardLayers layers;
  LayerStack& stack = layers.stack;
  stack.grid = grid;
  const auto add = [&](Layer layer, bool by_period) {
    if (by_period) layer.axis = periods;
    layer.n_censored = n_censored;
    stack.layers.push_back(std::move(layer));
    layers.untouched.push_back(0);
  };
  using enum Quantity;
  add(plain_layer("annual_rate", {reached, Statistic::value}, "how often the cell is reached",
                  "year-1", "sum of frequency x members that reach it / valid members" + cut),
      false);
  add(plain_layer("annual_rate_standard_error", {other, Statistic::value},
                  "Monte Carlo standard error of annual_rate", "year-1",
                  "of independent members; frequencies are taken as exact"),
      false);
  add(plain_layer(
          "annual_rate_of_high_intensity", {intensity, Statistic::value, IntensityClass::high},
          "how often the cell has high intensity", "year-1",
          fmt::format("peak thickness > {:g} m and peak speed > {:g} m/s of one member that "
                      "reaches it{}",
                      spec.strong_thickness_m, spec.strong_speed_m_s, cut)),
      false);
  for (const LevelMap& map : level_maps)
    add(plain_layer(
            std::string(map.word) + "_return_level", {quantity_of(map.source), Statistic::value},
            std::string(map.what) + " that is reached or exceeded once in the return period",
            map_unit(map.source).name,
            "the largest peak v of a member with rate(X >= v) >= 1/T, of members that reach the "
            "cell; 0 where it is reached less often" +
                cut),
        true);
  add(plain_layer(
          "intensity_class", {other, Statistic::value},
          "intensity of a debris flow at least once in the return period: 3 strong, 2 medium, 0 "
          "none",
          "1", "Loat and Petrascheck (1997), BWW, BRP and BUWAL"),
      true);
  stack.layers.back().classes = {{2, "medium intensity"}, {3, "strong intensity"}};
  add(plain_layer(
          "matrix_field", {other, Statistic::value},
          "field of the matrix of intensity and probability, 4 to 9; 0 none", "1",
          "3 x (intensity - 1) + probability of the return period, 3 high, 2 medium, 1 low"),
      true);
  stack.layers.back().classes = matrix_fields();
  add(plain_layer("highest_matrix_field", {other, Statistic::value},
                  "largest matrix_field over the return periods", "1", ""),
      false);
  stack.layers.back().classes = matrix_fields();
  return layers;
}

/// One block after the other, as CellStatistics does it.
class RateStatistics {
 public:
  RateStatistics(const JoinedMembers& members, const RiskSpec& spec, const HazardLayers& layers,
                 const Window& extent, KnownGround ground, LayerSink& to)
      : spec_(spec),
        rates_(scenario_rates(spec, members)),
        scenario_of_(members.ensemble_of_valid()),
        block_(layers, extent, std::move(ground), to) {}

  void add(const CellRows& rows) {
    block_.add(rows, [&](std::size_t i, std::size_t to) { cell(rows, i, to); });
  }

 private:
  void cell(const CellRows& rows, std::size_t i, std::size_t cell) {
    const auto members = rows.members_of(i);
    const auto arrival = rows.of(PeakLayer::arrival, i), h = rows.of(PeakLayer::thickness, i),
               v = rows.of(PeakLayer::speed, i);
    std::vector<std::size_t> reached(rates_.size(), 0), strong(rates_.size(), 0);
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (std::isnan(arrival[m])) continue;
      const std::size_t scenario = scenario_of_[members[m]];
      ++reached[scenario];
      strong[scenario] += static_cast<double>(h[m]) > spec_.strong_thickness_m &&
                          static_cast<double>(v[m]) > spec_.strong_speed_m_s;
    }
    const double rate = annual_rate(rates_, reached), high = annual_rate(rates_, strong);
    block_.put(at_.rate, 0, cell, rate);
    block_.put(at_.error, 0, cell, annual_rate_error(rates_, reached));
    block_.put(at_.high, 0, cell, high);
    for (std::size_t q = 0; q < level_maps.size(); ++q) {
      const auto values = rows.of(level_maps[q].source, i);
      peaks_.clear();
      for (std::size_t m = 0; m < members.size(); ++m)
        if (!std::isnan(arrival[m])) peaks_.push_back({values[m], scenario_of_[members[m]]});
      const auto levels = return_levels(rates_, peaks_, spec_.return_periods_years);
      const double unit = map_unit(level_maps[q].source).per_si;
      for (std::size_t p = 0; p < levels.size(); ++p)
        block_.put(at_.levels + q, p, cell, levels[p] * unit);
    }
    classes(rate, high, cell);
  }

  void classes(double rate, double high, std::size_t cell) {
    int highest = 0;
    for (std::size_t p = 0; p < spec_.return_periods_years.size(); ++p) {
      const double period = spec_.return_periods_years[p];
      const int intensity = reaches_rate(high, 1 / period)   ? 3
                            : reaches_rate(rate, 1 / period) ? 2
                                                             : 0;
      const int probability = probability_class(spec_, period);
      const int field = intensity > 0 && probability > 0 ? 3 * (intensity - 1) + probability : 0;
      block_.put(at_.intensity, p, cell, intensity);
      block_.put(at_.field, p, cell, field);
      highest = std::max(highest, field);
    }
    block_.put(at_.highest, 0, cell, highest);
  }

  const RiskSpec& spec_;
  std::vector<ScenarioRate> rates_;
  const std::vector<std::size_t>& scenario_of_;
  LayerBlock block_;
  Places at_;
  std::vector<ScenarioPeak> peaks_;  // scratch
};

}  // namespace

std::vector<ScenarioRate> scenario_rates(const RiskSpec& spec, const JoinedMembers& members) {
  expect(spec.scenarios.size() == members.n_ensembles(), "each ensemble has its frequency");
  std::vector<ScenarioRate> rates;
  for (const RiskScenario& s : spec.scenarios) rates.push_back({s.frequency_per_year, 0});
  for (const std::size_t e : members.ensemble_of_valid()) ++rates[e].n_members;
  for (const ScenarioRate& r : rates) expect(r.n_members > 0, "each scenario has a valid member");
  return rates;
}

int probability_class(const RiskSpec& spec, double period_years) {
  const auto n = static_cast<int>(spec.probability_classes_years.size());
  for (int k = 0; k < n; ++k)
    if (period_years <= spec.probability_classes_years[static_cast<std::size_t>(k)]) return n - k;
  return 0;
}

void make_rate_maps(const JoinedMembers& members, const RiskSpec& spec, const RateContext& context,
                    LayerSink& to) {
  const MemberCells cells(members);
  const Window extent = map_extent(cells.touched(), members.grid());
  const auto n_censored = std::count_if(
      members.members().begin(), members.members().end(),
      [](const MemberSummary& m) { return is_valid(m.outcome) && is_censored(m.censoring); });
  HazardLayers layers =
      layers_of(spec, grid_of(extent, members.grid()), static_cast<int>(n_censored));
  layers.stack.attributes = context.attributes;
  to.begin(layers.stack);
  RateStatistics statistics(members, spec, layers, extent,
                            KnownGround(context.ground, context.whole_ground, members.grid()), to);
  cells.visit(extent,
              {PeakLayer::thickness, PeakLayer::speed, PeakLayer::energy, PeakLayer::pressure,
               PeakLayer::arrival},
              context.memory_bytes, context.cancel,
              [&](const CellRows& rows) { statistics.add(rows); });
}

}  // namespace sturz
