// SPDX-License-Identifier: Apache-2.0
/// Which part of an ensemble one process computes.
#pragma once

namespace sturz::workflow {

/// Part k of n of the members, 1 <= k <= n.
struct Shard {
  int k = 1, n = 1;
};

}  // namespace sturz::workflow
