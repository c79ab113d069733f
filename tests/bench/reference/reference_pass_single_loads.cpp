// SPDX-License-Identifier: Apache-2.0
#define STURZ_REFERENCE single_loads
#include "tests/bench/reference/reference_pass_body.hpp"

namespace sturz::bench {

const ReferencePass reference_single_loads{"single loads",
                                           &STURZ_REFERENCE::gather_records,
                                           &STURZ_REFERENCE::sum_pairs,
                                           &STURZ_REFERENCE::update_particles,
                                           &STURZ_REFERENCE::meet_ground,
                                           &STURZ_REFERENCE::drift};

}  // namespace sturz::bench
