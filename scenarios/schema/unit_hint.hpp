// SPDX-License-Identifier: Apache-2.0
/// What a number outside its range was probably meant to be.
#pragma once

#include "scenarios/schema/schema.hpp"

#include <string>

namespace sturz {

/// One sentence, or empty: "Was it in another unit?", "Was it an angle in degrees? ...".
std::string unit_hint(const KeyInfo&, double value);

}  // namespace sturz
