// SPDX-License-Identifier: Apache-2.0
/// Numbers as people read them, for descriptions, manifests, logs and the terminal.
#pragma once

#include <string>

namespace sturz::workflow {

/// "3 min 20 s", "1 h 05 min", "7.5 s", "0.84 s", "0.04 s".
std::string duration_text(double seconds);
/// 491000 -> "491 000", 6.91e-5 -> "6.91e-05": whole numbers for people, three digits under 100.
std::string grouped(double value);
/// With `decimals` decimals, a small one with three digits: 1573.31 -> "1573.3", 0.0853 ->
/// "0.0853".
std::string measure(double value, int decimals = 1);

}  // namespace sturz::workflow
