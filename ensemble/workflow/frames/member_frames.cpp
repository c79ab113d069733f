// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/frames/member_frames.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/members/growing_ground.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "scenarios/assembly/assemble.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace sturz::workflow {
namespace {

constexpr const char* layer_name = "flow_thickness";
constexpr const char* member_attribute = "member";

/// What all frames touch, in the maps' grid; empty where there is nothing.
Window hull(const std::vector<ThicknessFrame>& frames) {
  Window all;
  for (const ThicknessFrame& frame : frames)
    if (frame.window.n_cells() > 0)
      all = all.n_cells() == 0 ? frame.window : joined(all, frame.window);
  return all;
}

std::vector<float> joined_cells(const ThicknessFrame& frame, const Window& hull, int factor,
                                const Grid& to) {
  std::vector<float> values(to.n_cells(), 0);
  const Window& w = frame.window;
  for (int row = 0; row < w.n_rows; ++row)
    for (int col = 0; col < w.n_cols; ++col) {
      float& cell = values[to.index((w.row0 + row - hull.row0) / factor,
                                    (w.col0 + col - hull.col0) / factor)];
      cell = std::max(cell, frame.values[static_cast<std::size_t>(row) * w.n_cols + col]);
    }
  return values;
}

}  // namespace

void FrameTaker::take(const SimulationParts& parts, bool last) {
  const double now = parts.state.time;
  if (!kept_.empty() && kept_.back().time_s >= now) return;
  if (!last && now < next_s_) return;
  kept_.push_back(thickness_frame(parts));
  next_s_ = now + interval_s_;
  if (kept_.size() < 2 * most_frames) return;
  std::size_t n = 1;
  // The first stays where it is: moved onto itself it would lose its values.
  for (std::size_t k = 2; k < kept_.size(); k += 2) kept_[n++] = std::move(kept_[k]);
  kept_.resize(n);
  interval_s_ *= 2;
}

std::optional<FramesShown> FrameTaker::frames(std::int64_t member, const Grid& maps) const {
  std::vector<ThicknessFrame> shown;
  const std::size_t step = (kept_.size() + most_frames - 1) / most_frames;
  for (std::size_t k = 0; k + 1 < kept_.size(); k += std::max<std::size_t>(1, step))
    shown.push_back(kept_[k]);
  if (!kept_.empty()) shown.push_back(kept_.back());
  const Window all = hull(shown);
  if (shown.size() < 2 || all.n_cells() == 0) return {};
  const int factor = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(all.n_cells()) / most_cells))));
  FramesShown out;
  out.member = member;
  out.grid = {.n_cols = (all.n_cols + factor - 1) / factor,
              .n_rows = (all.n_rows + factor - 1) / factor,
              .west_m = maps.west_m + all.col0 * maps.cell_m,
              .north_m = maps.north_m - all.row0 * maps.cell_m,
              .cell_m = factor * maps.cell_m,
              .crs_wkt = maps.crs_wkt};
  for (const ThicknessFrame& frame : shown) {
    out.times_s.push_back(frame.time_s);
    out.thickness.push_back(joined_cells(frame, all, factor, out.grid));
  }
  return out;
}

std::optional<std::size_t> middle_member(std::span<const MemberSummary> members) {
  const bool whole = std::any_of(members.begin(), members.end(), [](const MemberSummary& m) {
    return is_valid(m.outcome) && !is_censored(m.censoring);
  });
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_valid(members[i].outcome) && (!whole || !is_censored(members[i].censoring)))
      order.push_back(i);
  if (order.empty()) return {};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double left = members[a].scalars.runout_m, right = members[b].scalars.runout_m;
    return left != right ? left < right : members[a].member < members[b].member;
  });
  return order[order.size() / 2];
}

std::optional<FramesShown> frames_of_middle(const Scenario& scenario, const DesignTable& design,
                                            const SceneInputs& inputs,
                                            std::span<const MemberSummary> members,
                                            CancelFlag cancel) {
  const std::optional<std::size_t> middle = middle_member(members);
  if (!middle) return {};
  const std::int64_t number = members[*middle].member;
  const Scenario numbers = member_scenario(scenario, design, number);
  GrowingGround ground(scenario, inputs);
  FrameTaker taker;
  ground.computed([&](const SceneInputs& known) {
    taker = {};
    Simulation simulation = assemble(numbers, known, number, available_cores());
    RunControl control;
    control.frame_every_s = FrameTaker::first_interval_s;
    control.on_frame = [&](const ParticleFrame& frame) {
      if (frame.set_index == 0) taker.take(simulation.parts());
    };
    control.on_progress = [&](const Progress&) { return !cancel.raised(); };
    MemberResult result = simulation.run(control);
    taker.take(simulation.parts(), true);
    return result;
  });
  cancel.check();
  return taker.frames(number, inputs.hazard_grid);
}

void write_frames(const OutputFolder& folder, const FramesShown& frames) {
  LayerStack stack{.grid = frames.grid, .layers = {}, .attributes = {}};
  stack.attributes = {{"title", "Flow thickness over time of one member"},
                      {member_attribute, std::to_string(frames.member)}};
  Layer layer = plain_layer(layer_name, {Quantity::thickness, Statistic::value},
                            "vertical flow thickness", "m", "");
  layer.axis = {"frame_time", "", "s", frames.times_s};
  for (const auto& plane : frames.thickness)
    layer.values.insert(layer.values.end(), plane.begin(), plane.end());
  stack.layers.push_back(std::move(layer));
  write_layers(folder.frames_nc(), stack);
}

std::optional<FramesShown> read_frames(const OutputFolder& folder) {
  if (!std::filesystem::exists(folder.frames_nc())) return {};
  const LayersFileReader file(folder.frames_nc());
  const LayerStack& about = file.about();
  require(about.layers.size() == 1 && about.grid.n_cells() <= 4 * FrameTaker::most_cells,
          folder.frames_nc().string() + " (is not what `sturz` writes there). Delete it.");
  FramesShown frames;
  frames.grid = about.grid;
  frames.times_s = about.layers.front().axis.values;
  for (const auto& [name, value] : about.attributes)
    if (name == member_attribute) frames.member = std::strtoll(value.c_str(), nullptr, 10);
  for (std::size_t k = 0; k < frames.times_s.size(); ++k) {
    auto& plane = frames.thickness.emplace_back(about.grid.n_cells());
    file.read(0, k, {0, 0, about.grid.n_rows, about.grid.n_cols}, plane);
  }
  return frames;
}

}  // namespace sturz::workflow
