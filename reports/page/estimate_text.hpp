// SPDX-License-Identifier: Apache-2.0
/// Estimates in words that say how far they are known.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"

#include <functional>
#include <string>

namespace sturz {

/// A number with its unit, as the estimate's texts shall write it.
using NumberWriter = std::function<std::string(double)>;

/// "812 m", or "≥ 2 440 m" where the median lies beyond what was seen, or "not known".
std::string value_text(const CensoredEstimate&, const NumberWriter&);

/// "95 % interval 800 m – 830 m"; "... from 2 435 m, no upper end known"; why there is none.
std::string interval_text(const CensoredEstimate&, const NumberWriter&);

/// "12 of 40 cut off" where some values are not fully known; else empty.
std::string cut_text(const CensoredEstimate&);

}  // namespace sturz
