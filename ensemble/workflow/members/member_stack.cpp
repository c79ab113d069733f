// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/members/member_stack.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/map_units.hpp"
#include "ensemble/workflow/members/stored_members.hpp"
#include "ensemble/workflow/version.hpp"
#include "scenarios/layers/layer_meaning.hpp"

#include <fmt/core.h>

#include <optional>

namespace sturz::workflow {
namespace {

std::optional<PeakLayer> layer_called(const std::string& quantity) {
  for (int i = 0; i < n_peak_layers; ++i)
    if (to_string(quantity_of(static_cast<PeakLayer>(i))) == quantity)
      return static_cast<PeakLayer>(i);
  return {};
}

}  // namespace

std::string stack_quantities() {
  std::string all;
  for (int i = 0; i < n_peak_layers; ++i) {
    if (i > 0) all += ", ";
    all += to_string(quantity_of(static_cast<PeakLayer>(i)));
  }
  return all;
}

StackMade stack_members(const StackRequest& request, Observer& observer, CancelFlag cancel) {
  const auto layer = layer_called(request.quantity);
  require(layer.has_value(), fmt::format("--quantity {} (is none that members have). One of: {}.",
                                         request.quantity, stack_quantities()));
  const MemberStore store = open_members(request.folder, observer, cancel);
  const MapUnit unit = map_unit(*layer);
  MemberStack stack;
  stack.layer = *layer;
  stack.units = unit.name;
  stack.per_si = static_cast<float>(unit.per_si);
  stack.frequency = request.frequency_per_year;
  stack.attributes = {
      {"title", fmt::format("{} of each member of an ensemble", info(*layer).long_name)},
      {"source", fmt::format("sturz {} ({})", version, git_commit)},
      {"history", "written by sturz members --stack"}};
  return {write_member_stack(request.file, store, stack, cancel), stack.units};
}

}  // namespace sturz::workflow
