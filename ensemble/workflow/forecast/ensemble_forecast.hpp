// SPDX-License-Identifier: Apache-2.0
/// The forecast of an ensemble that is about to be computed.
#pragma once

#include "ensemble/workflow/forecast/forecast.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"

#include <optional>

namespace sturz::workflow {

/// Of what the job has still to do, from a second of trial; nothing where all is over so soon that
/// looking would not pay. Warns where it is more than ten minutes. The scene's predicted seconds
/// are those of the forecast from then on. \throws Cancelled
/// \param start_s computing time that starting took
std::optional<Forecast> forecast_of(EnsembleJob&, const SpeedCache&, double start_s, Observer&,
                                    CancelFlag cancel = {});

}  // namespace sturz::workflow
