// SPDX-License-Identifier: Apache-2.0
#define STURZ_PLAIN_LANES
#define STURZ_ISA isa_plain
#include "engine/effects/columns/sweep.hpp"
#include "engine/effects/phases/sweep.hpp"
#include "engine/effects/sweep/body.hpp"
#include "engine/effects/sweep/fused_sweep.hpp"

namespace sturz {

extern const Sweeps sweeps_plain;
const Sweeps sweeps_plain{&STURZ_ISA::dense_sweep, &STURZ_ISA::kinetic_sweep,
                          &STURZ_ISA::tight_list, &STURZ_ISA::column_sweep,
                          &STURZ_ISA::across_sweep};

}  // namespace sturz
