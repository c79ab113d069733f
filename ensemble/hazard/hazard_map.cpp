// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/hazard_map.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/cell_statistics.hpp"
#include "ensemble/hazard/hazard_layers.hpp"
#include "ensemble/hazard/weighting/weighted_sample.hpp"
#include "ensemble/hazard/weighting/weighted_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace sturz {
namespace {

std::string list_of(const std::vector<MemberSummary>& members, auto chosen) {
  std::vector<std::int64_t> numbers;
  for (const MemberSummary& m : members)
    if (chosen(m)) numbers.push_back(m.member);
  std::sort(numbers.begin(), numbers.end());
  return fmt::format("{}", fmt::join(numbers, ","));
}

std::int64_t count_of(const std::vector<MemberSummary>& members, auto chosen) {
  return std::count_if(members.begin(), members.end(),
                       [&](const MemberSummary& m) { return chosen(m); });
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
  const auto valid = [](const MemberSummary& m) { return is_valid(m.outcome); };
  const auto invalid = [](const MemberSummary& m) { return !is_valid(m.outcome); };
  // Any mass that left counts, as everywhere; the outcome names shares over 1 % only.
  const auto late = [&](const MemberSummary& m) { return valid(m) && is_moving(m.censoring); };
  const auto gone = [&](const MemberSummary& m) { return valid(m) && has_left(m.censoring); };
  const auto planned =
      context.n_planned > 0 ? context.n_planned : static_cast<std::int64_t>(members.size());
  add("number_of_planned_members", std::to_string(planned));
  add("number_of_finished_members", std::to_string(members.size()));
  add("number_of_valid_members", std::to_string(count_of(members, valid)));
  add("number_of_failed_members", std::to_string(count_of(members, invalid)));
  add("failed_members", list_of(members, invalid));
  add("out_of_time_members", list_of(members, late));
  add("left_terrain_members", list_of(members, gone));
  const bool phases = std::any_of(members.begin(), members.end(), [&](const MemberSummary& m) {
    return valid(m) && is_kept(PeakLayer::solid, m.censoring, m.scalars);
  });
  const auto gone_of = [&](Phase phase) {
    return list_of(members, [&, phase](const MemberSummary& m) {
      return gone(m) && has_left(censoring_of(phase, m.scalars, m.censoring));
    });
  };
  if (phases) {
    add("left_terrain_members_of_grains", gone_of(Phase::grains));
    add("left_terrain_members_of_liquid", gone_of(Phase::liquid));
  }
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

void add_extent(LayerStack& stack, const Window& extent, const Grid& grid, bool touched) {
  const std::string cells = fmt::format(
      "rows {} to {} of {} and columns {} to {} of {} of the hazard grid, counted from 0 "
      "in the north-west",
      extent.row0, end_row(extent) - 1, grid.n_rows, extent.col0, end_col(extent) - 1, grid.n_cols);
  stack.attributes.emplace_back(
      "map_extent", touched ? fmt::format("what valid members touched and {} cells around: {}",
                                          map_margin_cells, cells)
                            : fmt::format("no valid member moved; for an empty map: {}", cells));
  stack.attributes.emplace_back(
      "value_rule",
      "0 where the ground is known and no member came, missing where it is not known; arrival is "
      "missing where no member came");
}

/// What some valid member has of the maps that not all scenes have.
HazardExtras extras_of(const std::vector<MemberSummary>& members) {
  HazardExtras extras;
  for (const MemberSummary& m : members) {
    if (!is_valid(m.outcome)) continue;
    extras.left |= is_kept(PeakLayer::left, m.censoring, m.scalars);
    extras.eroded |= is_kept(PeakLayer::eroded, m.censoring, m.scalars);
    extras.phases |= is_kept(PeakLayer::solid, m.censoring, m.scalars);
    extras.n_censored_grains += is_censored(censoring_of(Phase::grains, m.scalars, m.censoring));
    extras.n_censored_liquid += is_censored(censoring_of(Phase::liquid, m.scalars, m.censoring));
  }
  return extras;
}

/// What is read of each member; nothing for what no member has.
std::vector<PeakLayer> read_layers_of(const HazardExtras& extras) {
  std::vector<PeakLayer> layers;
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto layer = static_cast<PeakLayer>(i);
    if (layer == PeakLayer::left && !extras.left) continue;
    if (layer == PeakLayer::eroded && !extras.eroded) continue;
    if (is_of_materials(layer) && !extras.phases) continue;
    layers.push_back(layer);
  }
  return layers;
}

}  // namespace

Window map_extent(const Window& touched, const Grid& grid) {
  Window extent;
  if (touched.n_cells() > 0) {
    extent.row0 = std::max(0, touched.row0 - map_margin_cells);
    extent.col0 = std::max(0, touched.col0 - map_margin_cells);
    extent.n_rows = std::min(grid.n_rows, end_row(touched) + map_margin_cells) - extent.row0;
    extent.n_cols = std::min(grid.n_cols, end_col(touched) + map_margin_cells) - extent.col0;
  } else {
    extent.n_rows = std::min(grid.n_rows, empty_map_cells);
    extent.n_cols = std::min(grid.n_cols, empty_map_cells);
    extent.row0 = (grid.n_rows - extent.n_rows) / 2;
    extent.col0 = (grid.n_cols - extent.n_cols) / 2;
  }
  return extent;
}

void make_hazard_map(const MemberParts& members, const HazardSpec& spec,
                     const HazardContext& context, LayerSink& to) {
  const MemberCells cells(members);
  const Window extent = map_extent(cells.touched(), members.grid());
  const std::vector<MemberSummary>& all = members.members();
  const auto n_censored = std::count_if(all.begin(), all.end(), [](const MemberSummary& m) {
    return is_valid(m.outcome) && is_censored(m.censoring);
  });
  HazardExtras extras = extras_of(all);
  const bool weighted = !context.weights.empty();
  expect(!weighted || context.weights.size() == cells.n_members(), "a weight for each member");
  if (weighted) extras.effective_members = effective_size(context.weights);
  HazardLayers layers =
      hazard_layers(grid_of(extent, members.grid()), spec, unresolved_spacing(all, context),
                    static_cast<std::int64_t>(cells.n_members()), n_censored, extras);
  layers.stack.attributes.emplace_back("number_of_censored_members", std::to_string(n_censored));
  add_attributes(layers.stack, members.members(), context);
  if (weighted)
    layers.stack.attributes.emplace_back("weighting", weighting_text(*extras.effective_members));
  add_extent(layers.stack, extent, members.grid(), cells.touched().n_cells() > 0);
  to.begin(layers.stack);
  const KnownGround ground(context.ground, context.whole_ground, members.grid());
  const auto pass_by = [&](auto statistics) {
    cells.visit(extent, read_layers_of(extras), context.memory_bytes, context.cancel,
                [&](const CellRows& rows) {
                  statistics.add(rows);
                  if (context.convergence != nullptr) context.convergence->add(rows);
                });
  };
  if (weighted)
    pass_by(WeightedStatistics(layers, context.weights, extent, ground, to));
  else
    pass_by(CellStatistics(layers, cells.n_members(), extent, ground, to));
}

LayerStack make_hazard_map(const MemberParts& members, const HazardSpec& spec,
                           const HazardContext& context) {
  StackSink sink;
  make_hazard_map(members, spec, context, sink);
  return std::move(sink.stack);
}

}  // namespace sturz
