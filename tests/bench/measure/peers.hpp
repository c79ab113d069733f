// SPDX-License-Identifier: Apache-2.0
/// What other particle codes do on one core, to stand beside the engine's figures.
#pragma once

#include "tests/bench/measure/table.hpp"

#include <string>

namespace sturz::bench {

/// A row per code: updates a second and core, and how many times as many `ours` are.
/// Sources: our own builds and runs of the named commits, 2 vCPU Xeon (Sapphire Rapids class,
/// AVX-512), one thread, smoothing length 1.3 spacings; +-20 %. \param scene  which scene of ours
/// the figure belongs to \param ours   [particle updates/s/core]
Table peers_table(const std::string& scene, double ours);

/// One plain sentence on the engine beside the two that bracket the field.
std::string peers_sentence(const std::string& scene, double ours);

}  // namespace sturz::bench
