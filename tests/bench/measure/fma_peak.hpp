// SPDX-License-Identifier: Apache-2.0
/// What one core can do at most: independent fused multiply-adds on registers, nothing else.
#pragma once

#include "engine/effects/sweep/fused_sweep.hpp"

namespace sturz::bench {

/// Runs about a millisecond's worth of fused multiply-adds as wide as the instruction set.
/// \return floating-point operations done (two per multiply-add and lane)
double fma_burst(InstructionSet);

}  // namespace sturz::bench
