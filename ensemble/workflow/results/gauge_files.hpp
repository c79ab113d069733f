// SPDX-License-Identifier: Apache-2.0
/// gauges.csv and gauge_series.csv of a results folder.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/gauges/gauge_statistics.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "io/members/member_store.hpp"
#include "scenarios/scenario.hpp"

namespace sturz::workflow {

/// Of all valid members; empty where the scene has no gauges. \throws IoError, Cancelled
GaugeFindings find_gauges(const MemberStore&, const Scenario&, CancelFlag cancel = {});
/// The same of a single run.
GaugeFindings find_gauges(const MemberResult&);

/// Nothing where there are none. \throws IoError
void write_gauge_files(const OutputFolder&, const GaugeFindings&);

}  // namespace sturz::workflow
