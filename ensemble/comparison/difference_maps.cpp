// SPDX-License-Identifier: Apache-2.0
#include "ensemble/comparison/difference_maps.hpp"

#include "engine/core/error.hpp"
#include "ensemble/comparison/paired_difference.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sturz {
namespace {

/// Layers of one event, one after the other in the stack.
enum Part : std::size_t {
  difference,
  lower,
  upper,
  unpaired_lower,
  unpaired_upper,
  smallest,
  largest,
  band_lower,
  band_upper,
  n_parts
};
struct PartText {
  const char *name, *meaning;
  Statistic statistic;
};
constexpr auto delta = Statistic::difference;
constexpr std::array<PartText, n_parts> part_texts{
    {{"difference", "P(B) - P(A)", delta},
     {"difference_lower", "lower end of its 95 % interval", delta},
     {"difference_upper", "upper end of its 95 % interval", delta},
     {"difference_unpaired_lower", "lower end of the interval as if members were no pairs", delta},
     {"difference_unpaired_upper", "upper end of the interval as if members were no pairs", delta},
     {"smallest", "the smaller one of P(A) and P(B)", Statistic::probability},
     {"largest", "the larger one of P(A) and P(B)", Statistic::probability},
     {"band_lower", "the lower one of both 95 % intervals' lower ends", Statistic::lower_bound},
     {"band_upper", "the upper one of both 95 % intervals' upper ends", Statistic::upper_bound}}};

/// What members do in a cell: bits for each member that touched it.
struct Deeds {
  std::vector<std::size_t> a, b;  ///< pairs of those that did it, rising
  std::int64_t n_a = 0, n_b = 0;  ///< all of them

  void clear() { a.clear(), b.clear(), n_a = n_b = 0; }
  PairCounts counts(std::size_t n_pairs) const {
    PairCounts c;
    std::size_t j = 0;
    for (const std::size_t pair : a) {
      while (j < b.size() && b[j] < pair) ++j;
      c.both += j < b.size() && b[j] == pair;
    }
    c.only_a = static_cast<std::int64_t>(a.size()) - c.both;
    c.only_b = static_cast<std::int64_t>(b.size()) - c.both;
    c.neither = static_cast<std::int64_t>(n_pairs) - c.both - c.only_a - c.only_b;
    return c;
  }
};

Layer made(const PartText& part, Quantity quantity, const std::string& event,
           const std::string& what, const std::string& comment, std::string units) {
  Layer layer;
  layer.name = fmt::format("{}_{}", event, part.name);
  layer.meaning = {quantity, part.statistic};
  layer.long_name = fmt::format("{}, probability that {}", part.meaning, what);
  layer.units = std::move(units);
  layer.comment = comment;
  if (layer.meaning.is_bound()) layer.confidence = 0.95;
  return layer;
}

HazardLayers layers_of(const Grid& grid, const std::vector<double>& thresholds, bool pairs) {
  const LayerAxis by_threshold{"thickness_threshold", "", "m", thresholds};
  const std::string comment =
      pairs ? "paired: Newcombe (1998), Stat. Med. 17, 2635-2650; unpaired: 873-890"
            : "no pairs: Newcombe (1998), Stat. Med. 17, 873-890";
  HazardLayers all;
  all.stack.grid = grid;
  std::vector<Layer>& layers = all.stack.layers;
  for (const PartText& part : part_texts)
    layers.push_back(
        made(part, Quantity::reached, "probability", "the cell is reached", comment, "1"));
  for (const PartText& part : part_texts) {
    if (thresholds.empty()) break;
    layers.push_back(made(part, Quantity::thickness, "thickness_exceedance",
                          "the largest vertical flow thickness exceeds the threshold", comment,
                          "1"));
    layers.back().axis = by_threshold;
  }
  all.untouched.assign(layers.size(), 0);
  return all;
}

class DifferenceStatistics {
 public:
  DifferenceStatistics(const MemberPairs& pairs, const std::vector<double>& thresholds,
                       const HazardLayers& layers, const Window& extent, KnownGround ground,
                       LayerSink& to)
      : pairs_(pairs), thresholds_(thresholds), block_(layers, extent, std::move(ground), to) {}

  void add(const CellRows& rows) {
    block_.add(
        rows, [&](const Window& block) { begin(block); },
        [&](std::size_t i, std::size_t to) { cell(rows, i, to); });
  }

  DifferenceSummary summary() {
    const auto middle = gains_.begin() + static_cast<std::ptrdiff_t>(gains_.size() / 2);
    summary_.n_cells = gains_.size();
    if (gains_.empty()) return summary_;
    std::nth_element(gains_.begin(), middle, gains_.end());
    summary_.median_gain = static_cast<double>(*middle);
    return summary_;
  }

 private:
  void begin(const Window& block) {
    block_.begin(block);
    // No member came: the intervals of two shares of 0.
    const auto n = static_cast<std::int64_t>(pairs_.n);
    const Deeds none;
    for (std::size_t cell = 0; cell < block.n_cells(); ++cell) {
      put_event(0, 0, cell, none, {0, 0, 0, n});
      for (std::size_t p = 0; p < thresholds_.size(); ++p)
        put_event(n_parts, p, cell, none, {0, 0, 0, n});
    }
  }

  template <class Did>
  void collect(const CellRows& rows, std::size_t i, Did did) {
    deeds_.clear();
    const auto members = rows.members_of(i);
    for (std::size_t m = 0; m < members.size(); ++m) {
      if (!did(m)) continue;
      const bool is_a = members[m] < pairs_.n_a;
      ++(is_a ? deeds_.n_a : deeds_.n_b);
      const std::size_t pair = pairs_.of_valid[members[m]];
      if (pair != no_pair) (is_a ? deeds_.a : deeds_.b).push_back(pair);
    }
  }

  void cell(const CellRows& rows, std::size_t i, std::size_t cell) {
    const auto arrival = rows.of(PeakLayer::arrival, i), h = rows.of(PeakLayer::thickness, i);
    collect(rows, i, [&](std::size_t m) { return !std::isnan(arrival[m]); });
    const PairCounts reached = deeds_.counts(pairs_.n);
    put_event(0, 0, cell, deeds_, reached);
    sum_up(reached);
    for (std::size_t p = 0; p < thresholds_.size(); ++p) {
      collect(rows, i, [&](std::size_t m) { return static_cast<double>(h[m]) > thresholds_[p]; });
      put_event(n_parts, p, cell, deeds_, deeds_.counts(pairs_.n));
    }
  }

  /// Of the members that have partners, as if they had none; of all where none has.
  DifferenceBounds unpaired(const Deeds& deeds, const PairCounts& counts) const {
    if (pairs_.n > 0) return unpaired_difference(counts.a(), counts.n(), counts.b(), counts.n());
    return unpaired_difference(deeds.n_a, static_cast<std::int64_t>(pairs_.n_a), deeds.n_b,
                               static_cast<std::int64_t>(pairs_.n_b));
  }

  void put_event(std::size_t first, std::size_t plane, std::size_t cell, const Deeds& deeds,
                 const PairCounts& counts) {
    const auto n_a = static_cast<std::int64_t>(pairs_.n_a);
    const auto n_b = static_cast<std::int64_t>(pairs_.n_b);
    const DifferenceBounds heaps = unpaired(deeds, counts);
    const DifferenceBounds own = pairs_.n > 0 ? paired_difference(counts) : heaps;
    const double a = static_cast<double>(deeds.n_a) / static_cast<double>(n_a);
    const double b = static_cast<double>(deeds.n_b) / static_cast<double>(n_b);
    const ProbabilityBounds of_a = wilson_interval(deeds.n_a, n_a);
    const ProbabilityBounds of_b = wilson_interval(deeds.n_b, n_b);
    const std::array<double, n_parts> numbers{own.difference,
                                              own.lower,
                                              own.upper,
                                              heaps.lower,
                                              heaps.upper,
                                              std::min(a, b),
                                              std::max(a, b),
                                              std::min(of_a.lower, of_b.lower),
                                              std::max(of_a.upper, of_b.upper)};
    for (std::size_t k = 0; k < n_parts; ++k) block_.put(first + k, plane, cell, numbers[k]);
  }

  /// Of `reached`: where and how much the pairs help.
  void sum_up(const PairCounts& counts) {
    const bool pairs = pairs_.n > 0;
    const DifferenceBounds heaps = unpaired(deeds_, counts);
    const DifferenceBounds own = pairs ? paired_difference(counts) : heaps;
    summary_.n_less += own.upper < 0;
    summary_.n_more += own.lower > 0;
    summary_.least = std::min(summary_.least, own.difference);
    summary_.most = std::max(summary_.most, own.difference);
    const std::int64_t hits = counts.a() + counts.b();
    if (pairs && hits > 0 && hits < 2 * counts.n())
      gains_.push_back(static_cast<float>(heaps.width() / own.width()));
  }

  const MemberPairs& pairs_;
  const std::vector<double>& thresholds_;
  LayerBlock block_;
  Deeds deeds_;  // scratch
  DifferenceSummary summary_;
  std::vector<float> gains_;
};

}  // namespace

DifferenceSummary make_difference_maps(const JoinedMembers& joined, const MemberPairs& pairs,
                                       const DifferenceContext& context, LayerSink& to) {
  expect(joined.n_ensembles() == 2 && pairs.n_a > 0 && pairs.n_b > 0,
         "two ensembles with members are compared");
  const MemberCells cells(joined);
  const Window extent = map_extent(cells.touched(), joined.grid());
  HazardLayers layers = layers_of(grid_of(extent, joined.grid()), context.thickness_m, pairs.n > 0);
  LayerStack& stack = layers.stack;
  stack.attributes = context.attributes;
  for (Layer& layer : stack.layers)
    layer.n_censored = static_cast<int>(std::count_if(
        joined.members().begin(), joined.members().end(),
        [](const MemberSummary& m) { return is_valid(m.outcome) && is_censored(m.censoring); }));
  to.begin(stack);
  DifferenceStatistics statistics(pairs, context.thickness_m, layers, extent,
                                  KnownGround(context.ground, context.whole_ground, joined.grid()),
                                  to);
  cells.visit(extent, {PeakLayer::thickness, PeakLayer::arrival}, context.memory_bytes,
              context.cancel, [&](const CellRows& rows) { statistics.add(rows); });
  return statistics.summary();
}

}  // namespace sturz
