// SPDX-License-Identifier: Apache-2.0
/// One number that tells whether two maps hold the same bits.
#pragma once

#include "scenarios/layers/layer_stack.hpp"

#include <cstdint>

namespace sturz {

/// FNV-1a (64 bits) over the grid's numbers and each layer's name, units, axis and values. Left
/// out: the text of the coordinate system (it depends on the PROJ release), comments and global
/// attributes (they may hold a date).
std::uint64_t hash_of(const LayerStack&);

}  // namespace sturz
