// SPDX-License-Identifier: Apache-2.0
#include "ensemble/region/region_maps.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/layer_block.hpp"
#include "ensemble/hazard/map_units.hpp"
#include "ensemble/hazard/sample_quantile.hpp"
#include "ensemble/region/any_hit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace sturz {
namespace {

constexpr std::array peaks{PeakLayer::thickness, PeakLayer::speed, PeakLayer::energy,
                           PeakLayer::pressure};

std::size_t blocks_along(int n_cells) {
  return static_cast<std::size_t>((n_cells + MemberCells::block_edge - 1) /
                                  MemberCells::block_edge);
}

/// Which blocks of an extent some source came near to.
class SeenBlocks {
 public:
  SeenBlocks(const Window& extent, std::span<const RegionSource> sources)
      : extent_(extent),
        n_cols_(blocks_along(extent.n_cols)),
        seen_(n_cols_ * blocks_along(extent.n_rows), false) {
    for (const RegionSource& source : sources) {
      if (source.touched.n_cells() == 0) continue;
      const Window& t = source.touched;
      constexpr int m = map_margin_cells;
      const Window near =
          overlap(extent, {t.row0 - m, t.col0 - m, t.n_rows + 2 * m, t.n_cols + 2 * m});
      for (int row = first(near.row0 - extent.row0); row < end_row(near) - extent.row0;
           row += MemberCells::block_edge)
        for (int col = first(near.col0 - extent.col0); col < end_col(near) - extent.col0;
             col += MemberCells::block_edge)
          seen_[number(row, col)] = true;
    }
  }

  bool has(const Window& block) const {
    return seen_[number(block.row0 - extent_.row0, block.col0 - extent_.col0)];
  }

 private:
  static int first(int cell) { return cell / MemberCells::block_edge * MemberCells::block_edge; }
  std::size_t number(int row, int col) const {
    return static_cast<std::size_t>(row / MemberCells::block_edge) * n_cols_ +
           static_cast<std::size_t>(col / MemberCells::block_edge);
  }

  Window extent_;
  std::size_t n_cols_;
  std::vector<bool> seen_;
};

/// Lists in the order in which blocks pass by; sorted at the end.
class ListsInTheMaking {
 public:
  explicit ListsInTheMaking(const Grid& grid) { lists_.grid = grid; }

  void add(std::int64_t cell, std::span<const SourceHit> hits) {
    if (hits.empty()) return;
    lists_.cells.push_back(cell);
    lists_.hits.insert(lists_.hits.end(), hits.begin(), hits.end());
    lists_.begin.push_back(lists_.hits.size());
  }

  SourceLists finish() {
    std::vector<std::size_t> order(lists_.cells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return lists_.cells[a] < lists_.cells[b]; });
    SourceLists sorted;
    sorted.grid = lists_.grid;
    sorted.cells.reserve(order.size());
    sorted.begin.reserve(order.size() + 1);
    sorted.hits.reserve(lists_.hits.size());
    for (const std::size_t i : order) {
      sorted.cells.push_back(lists_.cells[i]);
      sorted.hits.insert(sorted.hits.end(),
                         lists_.hits.begin() + static_cast<std::ptrdiff_t>(lists_.begin[i]),
                         lists_.hits.begin() + static_cast<std::ptrdiff_t>(lists_.begin[i + 1]));
      sorted.begin.push_back(sorted.hits.size());
    }
    return sorted;
  }

 private:
  SourceLists lists_;
};

std::size_t sources_with_members(std::span<const RegionSource> sources) {
  return static_cast<std::size_t>(std::count_if(sources.begin(), sources.end(),
                                                [](const RegionSource& s) { return s.valid > 0; }));
}

/// From what members left in a cell to the values of all layers there.
class RegionStatistics {
 public:
  RegionStatistics(const RegionMembers& region, const RegionLayers& layers, const Window& extent,
                   const RegionContext& context, LayerSink& to)
      : region_(region),
        layers_(layers),
        extent_(extent),
        context_(context),
        to_(to),
        seen_(extent, region.sources),
        rows_(region.row_of_valid, region.n_rows),
        any_(sources_with_members(region.sources), rows_.n_valid()),
        lists_(layers.layers.stack.grid),
        n_quantiles_(layers.layers.stack.layers.size() > RegionLayers::first_peak
                         ? layers.layers.stack.layers[RegionLayers::first_peak].n_planes()
                         : 0) {}

  void add(const CellRows& rows) {
    if (!seen_.has(rows.block)) return;
    if (rows.window.row0 == rows.block.row0) begin(rows.block);
    block_->add(rows, [&](std::size_t i, std::size_t to) { cell(rows, i, to); });
  }
  SourceLists finish() { return lists_.finish(); }

 private:
  void begin(const Window& block) {
    if (context_.ground) ground_ = context_.ground(block);
    block_.emplace(layers_.layers, extent_,
                   KnownGround(ground_.get(), context_.whole_ground, region_.members.grid()), to_);
  }

  void cell(const CellRows& rows, std::size_t i, std::size_t to) {
    const auto members = rows.members_of(i);
    double expected = 0, highest = 0, thickest = -1;
    std::uint32_t best = 0;
    hits_.clear();
    largest_.assign(peaks.size() * n_quantiles_, 0);
    rows_.next_cell();
    any_.next_cell();
    for (std::size_t m = 0; m < members.size();) {
      const std::uint32_t source = region_.source_of_valid[members[m]];
      std::size_t end = m;
      while (end < members.size() && region_.source_of_valid[members[end]] == source) ++end;
      const std::int64_t hits = count_hits(rows, i, m, end);
      const auto n = static_cast<double>(region_.sources[source].valid);
      const double p = static_cast<double>(hits) / n;
      take_quantiles(rows, i, m, end, region_.sources[source].valid);
      if (p > 0) {
        hits_.push_back({source, static_cast<float>(p)});
        any_.add(hits, region_.sources[source].valid);
        expected += p;
        const double mean = mean_thickness(rows, i, m, end) / n;
        if (p > highest || (p == highest && mean > thickest))
          highest = p, thickest = mean, best = source + 1;
      }
      m = end;
    }
    put(to, highest, expected, best);
    const auto n_cols = static_cast<std::size_t>(rows.window.n_cols);
    const int row = rows.window.row0 + static_cast<int>(i / n_cols) - extent_.row0;
    const int col = rows.window.col0 + static_cast<int>(i % n_cols) - extent_.col0;
    lists_.add(std::int64_t{row} * extent_.n_cols + col, hits_);
  }

  std::int64_t count_hits(const CellRows& rows, std::size_t i, std::size_t m, std::size_t end) {
    const auto arrival = rows.of(PeakLayer::arrival, i);
    const auto members = rows.members_of(i);
    std::int64_t n = 0;
    for (; m < end; ++m) {
      if (std::isnan(arrival[m])) continue;  // the smoothing's tail beyond the last column
      ++n;
      rows_.hit(members[m]);
    }
    return n;
  }

  /// Of the members that touched the cell, in their order: the sum [m].
  static double mean_thickness(const CellRows& rows, std::size_t i, std::size_t m,
                               std::size_t end) {
    const auto h = rows.of(PeakLayer::thickness, i);
    double sum = 0;
    for (; m < end; ++m) sum += h[m];
    return sum;
  }

  void take_quantiles(const CellRows& rows, std::size_t i, std::size_t m, std::size_t end,
                      std::int64_t n_valid) {
    if (n_quantiles_ == 0) return;
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      const auto values = rows.of(peaks[k], i).subspan(m, end - m);
      sorted_.clear();
      std::copy_if(values.begin(), values.end(), std::back_inserter(sorted_),
                   [](float v) { return v > 0; });
      if (sorted_.empty()) continue;
      std::sort(sorted_.begin(), sorted_.end());
      const auto& levels = layers_.layers.stack.layers[RegionLayers::first_peak + k].axis.values;
      const std::size_t n_zeros = static_cast<std::size_t>(n_valid) - sorted_.size();
      for (std::size_t q = 0; q < levels.size(); ++q) {
        double& largest = largest_[k * n_quantiles_ + q];
        largest = std::max(largest, sample_quantile(sorted_, n_zeros, levels[q]));
      }
    }
  }

  void put_probability(RegionLayers::Place first, std::size_t to, double probability,
                       const ProbabilityBounds& bounds) {
    block_->put(first, 0, to, probability);
    block_->put(first + 1, 0, to, bounds.lower);
    block_->put(first + 2, 0, to, bounds.upper);
  }

  void put(std::size_t to, double highest, double expected, std::uint32_t best) {
    block_->put(RegionLayers::highest, 0, to, highest);
    put_probability(RegionLayers::any, to, any_.probability(), any_.bounds());
    put_probability(RegionLayers::any_rows, to, rows_.share(), rows_.bounds());
    block_->put(RegionLayers::expected, 0, to, expected);
    block_->put(RegionLayers::number, 0, to, static_cast<double>(hits_.size()));
    block_->put(RegionLayers::likeliest_source, 0, to, best);
    for (std::size_t k = 0; k < peaks.size(); ++k)
      for (std::size_t q = 0; q < n_quantiles_; ++q)
        block_->put(RegionLayers::first_peak + k, q, to,
                    largest_[k * n_quantiles_ + q] * map_unit(peaks[k]).per_si);
  }

  const RegionMembers& region_;
  const RegionLayers& layers_;
  Window extent_;
  const RegionContext& context_;
  LayerSink& to_;
  SeenBlocks seen_;
  RowCount rows_;
  AnyHit any_;
  ListsInTheMaking lists_;
  std::size_t n_quantiles_;
  std::shared_ptr<const Raster<double>> ground_;  // of the block
  std::optional<LayerBlock> block_;
  // Scratch of a cell.
  std::vector<SourceHit> hits_;
  std::vector<double> largest_;  // [peak][quantile], SI
  std::vector<float> sorted_;
};

void add_attributes(LayerStack& stack, const RegionMembers& region, const Window& extent,
                    const RegionContext& context) {
  const Grid& grid = region.members.grid();
  const auto n_valid = static_cast<std::ptrdiff_t>(sources_with_members(region.sources));
  stack.attributes = {
      {"number_of_sources", std::to_string(region.sources.size())},
      {"number_of_sources_without_valid_members",
       std::to_string(static_cast<std::ptrdiff_t>(region.sources.size()) - n_valid)},
      {"number_of_valid_members", std::to_string(region.source_of_valid.size())},
      {"probability_rule",
       "all probabilities hold if the sources release; none says how often they do. Sources "
       "without a valid member are in no map"},
      {"map_extent",
       fmt::format("blocks of {0} x {0} cells that some source touched, {1} cells around counted "
                   "in; rows {2} to {3} of {4} and columns {5} to {6} of {7} of the hazard grid, "
                   "counted from 0 in the north-west",
                   MemberCells::block_edge, map_margin_cells, extent.row0, end_row(extent) - 1,
                   grid.n_rows, extent.col0, end_col(extent) - 1, grid.n_cols)},
      {"value_rule",
       "0 where the ground is known and no member came, missing where it is not known and in "
       "blocks that no source touched"}};
  for (const auto& attribute : context.attributes) stack.attributes.push_back(attribute);
}

}  // namespace

SourceLists make_region_maps(const RegionMembers& region, std::span<const double> quantiles,
                             const RegionContext& context, LayerSink& to) {
  const MemberCells cells(region.members);
  expect(region.source_of_valid.size() == cells.n_members() &&
             region.row_of_valid.size() == cells.n_members(),
         "source and row of each valid member are known");
  const Window extent = map_extent(cells.touched(), region.members.grid());
  const auto& all = region.members.members();
  const auto n_censored = std::count_if(all.begin(), all.end(), [](const MemberSummary& m) {
    return is_valid(m.outcome) && is_censored(m.censoring);
  });
  RegionLayers layers = region_layers(grid_of(extent, region.members.grid()), region.sources,
                                      quantiles, static_cast<int>(n_censored),
                                      RowCount(region.row_of_valid, region.n_rows).n_valid());
  add_attributes(layers.layers.stack, region, extent, context);
  to.begin(layers.layers.stack);
  RegionStatistics statistics(region, layers, extent, context, to);
  std::vector<PeakLayer> read{PeakLayer::arrival};
  read.insert(read.end(), peaks.begin(), peaks.end());
  cells.visit(extent, read, context.memory_bytes, context.cancel,
              [&](const CellRows& rows) { statistics.add(rows); });
  SourceLists lists = statistics.finish();
  for (const RegionSource& source : region.sources) lists.sources.push_back(source.name);
  return lists;
}

}  // namespace sturz
