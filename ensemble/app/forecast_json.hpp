// SPDX-License-Identifier: Apache-2.0
/// A forecast for machines.
#pragma once

#include "ensemble/workflow/forecast/forecast.hpp"

#include <nlohmann/json.hpp>

namespace sturz::app {

/// Its keys stand in the user guide. Ranges are objects of likely, low and high; what is not known
/// is null.
nlohmann::ordered_json forecast_json(const workflow::Forecast&);

/// Computing time of this process so far [s].
double process_seconds();

}  // namespace sturz::app
