// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sensitivity/index_maps.hpp"

#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sturz {
namespace {

constexpr std::int64_t least_sets = 8;  // that say the rarer one of yes and no

/// Counts of two rows of 0 and 1 over the sets.
struct Pair {
  std::int64_t first = 0, second = 0, both = 0;

  void add(bool one, bool other) {
    first += one;
    second += other;
    both += one && other;
  }
  /// NaN where one of them is almost always the same.
  double correlation(std::int64_t n) const {
    const auto rarer = [n](std::int64_t hits) { return std::min(hits, n - hits); };
    if (rarer(first) < least_sets || rarer(second) < least_sets) return nan_d;
    const auto f = static_cast<double>(first), s = static_cast<double>(second),
               all = static_cast<double>(n);
    return (all * static_cast<double>(both) - f * s) / std::sqrt(f * (all - f) * s * (all - s));
  }
  /// Of rows that agree in every set but one, as far as r = 1 goes.
  double almost_one(std::int64_t n) const {
    const auto f = static_cast<double>(first), all = static_cast<double>(n);
    return 1 - all / (2 * f * (all - f));
  }
};

struct Interval {
  double lower = nan_d, upper = nan_d;
};
/// Fisher's, of a correlation r of the two rows.
Interval interval_of(const Pair& rows, double r, std::int64_t n) {
  const double wide = z_95 / std::sqrt(static_cast<double>(n - 3)), one = rows.almost_one(n);
  if (r > one) return {std::tanh(std::atanh(one) - wide), 1};
  if (r < -one) return {-1, std::tanh(std::atanh(-one) + wide)};
  return {std::tanh(std::atanh(r) - wide), std::tanh(std::atanh(r) + wide)};
}

std::string as_name(std::string key) {
  for (char& c : key)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  while (!key.empty() && key.back() == '_') key.pop_back();
  return key;
}

/// Where the layers of one result begin: for each key first and total with bounds, then the sets.
struct Result {
  PeakLayer source = PeakLayer::arrival;
  std::vector<float> thresholds;  ///< one plane each; empty: reached
  std::size_t begin = 0;

  std::size_t n_planes() const { return std::max<std::size_t>(1, thresholds.size()); }
};

class Layers {
 public:
  explicit Layers(const IndexMapRequest& request) {
    add(request, {PeakLayer::arrival, {}, 0}, "reach", "whether the cell is reached", {});
    if (request.thickness_m.empty()) return;
    Result thickness{PeakLayer::thickness, {}, 0};
    for (const double t : request.thickness_m)
      thickness.thresholds.push_back(static_cast<float>(t));
    add(request, thickness, "thickness_exceedance", "whether peak thickness exceeds the threshold",
        LayerAxis{"thickness_threshold", "", "m", request.thickness_m});
  }
  HazardLayers layers;
  std::vector<Result> results;

 private:
  void add(const IndexMapRequest& request, Result result, const std::string& word,
           const std::string& meaning, const LayerAxis& axis) {
    result.begin = layers.stack.layers.size();
    for (const std::string& key : request.keys)
      for (const char* index : {"first", "total"})
        for (const char* bound : {"", "_lower", "_upper"})
          add_layer(fmt::format("sobol_{}_{}_of_{}{}", index, as_name(key), word, bound),
                    fmt::format("Sobol' {} index of {}: {}{}", index, key, meaning,
                                *bound == 0 ? "" : ", bound of the 95 % interval"),
                    "Martinez' estimator over the sets of a Saltelli design", axis);
    add_layer(fmt::format("sobol_sets_of_{}", word),
              fmt::format("sets of members that count: {}", meaning),
              "sets with a member that is cut off before it exceeds are left out", axis);
    results.push_back(std::move(result));
  }
  void add_layer(std::string name, std::string long_name, std::string comment,
                 const LayerAxis& axis) {
    Layer layer;
    layer.name = std::move(name);
    layer.long_name = std::move(long_name);
    layer.units.assign(1, '1');  // g++ 12 warns of a literal here
    layer.comment = std::move(comment);
    layer.axis = axis;
    layers.stack.layers.push_back(std::move(layer));
    layers.untouched.push_back(nan_f);
  }
};

/// What is made of the members cell by cell.
class IndexStatistics {
 public:
  IndexStatistics(const Layers& layers, const MemberParts& members, const IndexMapRequest& request,
                  const Window& extent, LayerSink& to)
      : layers_(layers),
        n_dims_(request.keys.size()),
        block_(layers.layers, extent, KnownGround(nullptr, {}, members.grid()), to),
        untouched_(static_cast<std::size_t>(request.n_rows), Exceeds::not_known) {
    std::vector<const MemberSummary*> valid;
    for (const MemberSummary& m : members.members())
      if (is_valid(m.outcome) && m.member < request.n_rows) valid.push_back(&m);
    std::sort(valid.begin(), valid.end(),
              [](const auto* a, const auto* b) { return a->member < b->member; });
    for (const MemberSummary* m : valid) {
      rows_.push_back(static_cast<std::size_t>(m->member));
      if (!is_censored(m->censoring)) untouched_[rows_.back()] = Exceeds::no;
    }
  }

  void add(const CellRows& rows) {
    block_.add(rows, [&](std::size_t i, std::size_t to) {
      for (const Result& result : layers_.results)
        for (std::size_t plane = 0; plane < result.n_planes(); ++plane)
          cell(result, plane, rows, i, to);
    });
  }

 private:
  void cell(const Result& result, std::size_t plane, const CellRows& rows, std::size_t i,
            std::size_t to) {
    exceeds_ = untouched_;
    const std::span<const std::uint32_t> members = rows.members_of(i);
    const std::span<const float> values = rows.of(result.source, i);
    for (std::size_t m = 0; m < members.size(); ++m)
      if (result.thresholds.empty() ? !std::isnan(values[m]) : values[m] > result.thresholds[plane])
        exceeds_[rows_[members[m]]] = Exceeds::yes;
    const CellIndices found = cell_indices(exceeds_, n_dims_);
    std::size_t layer = result.begin;
    for (std::size_t k = 0; k < n_dims_; ++k)
      for (const CellIndex& index : {found.first[k], found.total[k]})
        for (const double value : {index.value, index.lower, index.upper})
          block_.put(layer++, plane, to, value);
    block_.put(layer, plane, to, static_cast<double>(found.n_sets));
  }

  const Layers& layers_;
  std::size_t n_dims_;
  LayerBlock block_;
  std::vector<std::size_t> rows_;   // of the design, by place among the valid members
  std::vector<Exceeds> untouched_;  // what members say that did not come
  std::vector<Exceeds> exceeds_;    // scratch
};

}  // namespace

CellIndices cell_indices(std::span<const Exceeds> rows, std::size_t n_dims) {
  CellIndices found;
  found.first.resize(n_dims);
  found.total.resize(n_dims);
  std::vector<Pair> with_a(n_dims), with_b(n_dims);
  const std::size_t set = n_dims + 2;
  for (std::size_t s = 0; (s + 1) * set <= rows.size(); ++s) {
    const auto of_set = rows.subspan(s * set, set);
    if (std::find(of_set.begin(), of_set.end(), Exceeds::not_known) != of_set.end()) continue;
    ++found.n_sets;
    const bool a = of_set[0] == Exceeds::yes, b = of_set[1] == Exceeds::yes;
    for (std::size_t k = 0; k < n_dims; ++k) {
      const bool mixed = of_set[2 + k] == Exceeds::yes;
      with_a[k].add(a, mixed);
      with_b[k].add(b, mixed);
    }
  }
  for (std::size_t k = 0; k < n_dims; ++k) {
    const double first = with_b[k].correlation(found.n_sets);
    const double others = with_a[k].correlation(found.n_sets);
    const Interval of_first = interval_of(with_b[k], first, found.n_sets);
    const Interval of_others = interval_of(with_a[k], others, found.n_sets);
    found.first[k] = {first, of_first.lower, of_first.upper};
    found.total[k] = {1 - others, 1 - of_others.upper, 1 - of_others.lower};
  }
  return found;
}

void make_index_maps(const MemberParts& members, const IndexMapRequest& request, LayerSink& to) {
  const MemberCells cells(members);
  const Window extent = map_extent(cells.touched(), members.grid());
  Layers layers(request);
  layers.layers.stack.grid = grid_of(extent, members.grid());
  to.begin(layers.layers.stack);
  IndexStatistics statistics(layers, members, request, extent, to);
  std::vector<PeakLayer> read{PeakLayer::arrival};
  if (!request.thickness_m.empty()) read.push_back(PeakLayer::thickness);
  cells.visit(extent, read, request.memory_bytes, request.cancel,
              [&](const CellRows& rows) { statistics.add(rows); });
}

}  // namespace sturz
