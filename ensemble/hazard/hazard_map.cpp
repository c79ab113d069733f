// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/hazard_map.hpp"

#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/member_tiles.hpp"
#include "ensemble/hazard/sample_quantile.hpp"
#include "ensemble/hazard/swiss_intensity.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <type_traits>

namespace sturz {
namespace {

/// Intensity looks at arrival, thickness and speed together; the other layers come one by one.
constexpr int blocks_at_once = 3;

class CellWriter {
 public:
  CellWriter(HazardLayers& out, std::size_t n_members)
      : out_(out), n_(static_cast<std::int64_t>(n_members)) {
    for (std::int64_t hits = 0; hits <= n_; ++hits) bounds_.push_back(wilson_interval(hits, n_));
  }

  void reached(CellBlock& arrival) {
    for_cells(arrival, [&](std::size_t cell, std::span<const float> members) {
      const auto hits =
          std::count_if(members.begin(), members.end(), [](float t) { return !std::isnan(t); });
      put_probability(out_.reached, 0, cell, hits);
      if (hits > 0 && out_.arrival_quantile) {
        sort_where(members, [](float t) { return !std::isnan(t); });
        put_quantiles(*out_.arrival_quantile, cell, 0);
      }
    });
  }

  void quantity(const QuantityLayers& to, CellBlock& block) {
    for_cells(block, [&](std::size_t cell, std::span<const float> members) {
      sort_where(members, [](float v) { return v > 0; });
      if (sorted_.empty()) return;  // untouched: the layers hold its values already
      if (to.exceedance) put_exceedance(*to.exceedance, cell);
      if (to.mean) {
        double sum = 0;
        for (const float v : members) sum += v;  // in member order
        put(*to.mean, 0, cell, sum / static_cast<double>(n_));
      }
      if (to.quantile) put_quantiles(*to.quantile, cell, members.size() - sorted_.size());
    });
  }

  void intensity(CellBlock& thickness, CellBlock& speed, CellBlock& arrival) {
    for_cells(thickness, [&](std::size_t cell, std::span<const float> h, std::size_t i) {
      std::int64_t high = 0, medium = 0;
      const std::span<const float> v = speed.cell(i), arrived = arrival.cell(i);
      for (std::size_t m = 0; m < h.size(); ++m) {
        const bool is_high = is_high_debris_flow_intensity(h[m], v[m]);
        high += is_high;
        medium += !is_high && !std::isnan(arrived[m]);
      }
      put(out_.high_intensity, 0, cell, share(high));
      put(out_.medium_intensity, 0, cell, share(medium));
    });
  }

 private:
  /// Calls visit(cell of the grid, values of the members[, cell of the tile]) for each cell.
  template <class Visit>
  void for_cells(CellBlock& block, Visit visit) const {
    const Window& tile = block.tile();
    for (std::size_t i = 0; i < tile.n_cells(); ++i) {
      const int row = tile.row0 + static_cast<int>(i / static_cast<std::size_t>(tile.n_cols));
      const int col = tile.col0 + static_cast<int>(i % static_cast<std::size_t>(tile.n_cols));
      const std::size_t cell = out_.stack.grid.index(row, col);
      if constexpr (std::is_invocable_v<Visit, std::size_t, std::span<const float>, std::size_t>)
        visit(cell, block.cell(i), i);
      else
        visit(cell, block.cell(i));
    }
  }

  double share(std::int64_t hits) const {
    return static_cast<double>(hits) / static_cast<double>(n_);
  }

  void put(std::size_t layer, std::size_t plane, std::size_t cell, double value) {
    out_.stack.layers[layer].values[plane * out_.stack.grid.n_cells() + cell] =
        static_cast<float>(value);
  }

  void put_probability(const ProbabilityLayers& to, std::size_t plane, std::size_t cell,
                       std::int64_t hits) {
    put(to.probability, plane, cell, share(hits));
    put(to.lower, plane, cell, bounds_[static_cast<std::size_t>(hits)].lower);
    put(to.upper, plane, cell, bounds_[static_cast<std::size_t>(hits)].upper);
  }

  /// From sorted_: those beyond the threshold are its tail.
  void put_exceedance(const ProbabilityLayers& to, std::size_t cell) {
    for (std::size_t plane = 0; plane < to.thresholds.size(); ++plane) {
      const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), to.thresholds[plane]);
      put_probability(to, plane, cell, sorted_.end() - above);
    }
  }

  void put_quantiles(std::size_t layer, std::size_t cell, std::size_t n_zeros) {
    const std::vector<double>& fractions = out_.stack.layers[layer].axis.values;
    for (std::size_t q = 0; q < fractions.size(); ++q)
      put(layer, q, cell, sample_quantile(sorted_, n_zeros, fractions[q]));
  }

  template <class Keep>
  void sort_where(std::span<const float> members, Keep keep) {
    sorted_.clear();
    std::copy_if(members.begin(), members.end(), std::back_inserter(sorted_), keep);
    std::sort(sorted_.begin(), sorted_.end());
  }

  HazardLayers& out_;
  std::int64_t n_;
  std::vector<ProbabilityBounds> bounds_;  // of each possible number of hits
  std::vector<float> sorted_;              // scratch
};

void write_tile(const Window& tile, const MemberTiles& members, const HazardLayers& layers,
                CellWriter& writer, std::array<CellBlock, blocks_at_once>& blocks) {
  auto& [arrival, thickness, other] = blocks;
  members.read(PeakLayer::arrival, tile, arrival);
  writer.reached(arrival);
  for (const QuantityLayers& quantity : layers.quantities) {
    CellBlock& block = quantity.source == PeakLayer::thickness ? thickness : other;
    members.read(quantity.source, tile, block);
    writer.quantity(quantity, block);
    if (quantity.source == PeakLayer::speed) writer.intensity(thickness, other, arrival);
  }
}

std::string list_of(const std::vector<MemberSummary>& members, auto chosen) {
  std::vector<std::int64_t> numbers;
  for (const MemberSummary& m : members)
    if (chosen(m.outcome)) numbers.push_back(m.member);
  std::sort(numbers.begin(), numbers.end());
  return fmt::format("{}", fmt::join(numbers, ","));
}

std::int64_t count_of(const std::vector<MemberSummary>& members, auto chosen) {
  return std::count_if(members.begin(), members.end(),
                       [&](const MemberSummary& m) { return chosen(m.outcome); });
}

/// "depth_averaged" or, where members differ, "depth_averaged (30), full_stress (2)".
std::string formulations_text(const std::vector<MemberSummary>& members) {
  std::map<std::string, std::size_t> counts;
  for (const MemberSummary& m : members)
    if (is_valid(m.outcome)) ++counts[m.formulation];
  std::string text;
  for (const auto& [name, count] : counts)
    text += (text.empty() ? "" : ", ") + name +
            (counts.size() > 1 ? " (" + std::to_string(count) + ")" : "");
  return text;
}

void add_attributes(LayerStack& stack, const std::vector<MemberSummary>& members,
                    const HazardContext& context) {
  const auto add = [&](const char* name, const std::string& text) {
    stack.attributes.emplace_back(name, text);
  };
  const auto invalid = [](Outcome o) { return !is_valid(o); };
  const auto late = [](Outcome o) { return o == Outcome::out_of_time; };
  const auto gone = [](Outcome o) { return o == Outcome::left_terrain; };
  const auto planned =
      context.n_planned > 0 ? context.n_planned : static_cast<std::int64_t>(members.size());
  add("number_of_planned_members", std::to_string(planned));
  add("number_of_finished_members", std::to_string(members.size()));
  add("number_of_valid_members", std::to_string(count_of(members, is_valid)));
  add("number_of_failed_members", std::to_string(count_of(members, invalid)));
  add("failed_members", list_of(members, invalid));
  add("out_of_time_members", list_of(members, late));
  add("left_terrain_members", list_of(members, gone));
  add("formulations", formulations_text(members));
  add("member_rule",
      "members that settled, ran out of time or left the terrain count; diverged, failed and "
      "cancelled ones are excluded");
  for (const auto& attribute : context.attributes) stack.attributes.push_back(attribute);
}

/// The spacing below half of which thickness means nothing; columns thin out continuously, so 0
/// where all valid members are such.
double unresolved_spacing(const std::vector<MemberSummary>& members, const HazardContext& context) {
  const bool particles = std::any_of(members.begin(), members.end(), [](const MemberSummary& m) {
    return is_valid(m.outcome) && m.formulation != to_string(Formulation::depth_averaged);
  });
  return particles ? context.spacing_m : 0;
}

}  // namespace

LayerStack make_hazard_map(const MemberSource& members, const HazardSpec& spec,
                           const HazardContext& context) {
  const MemberTiles tiles(members, context.memory_limit_bytes, blocks_at_once);
  HazardLayers layers =
      empty_hazard_layers(members.grid(), spec, unresolved_spacing(members.members(), context),
                          static_cast<std::int64_t>(tiles.n_members()));
  CellWriter writer(layers, tiles.n_members());
  std::array<CellBlock, blocks_at_once> blocks;
  for (const Window& tile : tiles.tiles()) write_tile(tile, tiles, layers, writer, blocks);
  add_attributes(layers.stack, members.members(), context);
  return std::move(layers.stack);
}

}  // namespace sturz
