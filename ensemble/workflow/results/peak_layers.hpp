// SPDX-License-Identifier: Apache-2.0
/// The maps of one member over the whole hazard grid.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "scenarios/layers/layer_stack.hpp"

namespace sturz::workflow {

/// Six layers in SI units; cells that were never reached are NaN.
LayerStack peak_layers(const MemberResult&);

}  // namespace sturz::workflow
