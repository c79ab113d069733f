// SPDX-License-Identifier: Apache-2.0
/// What came out of a batch: a table, outlines for GIS, and a page.
#pragma once

#include "ensemble/workflow/batch/batch.hpp"
#include "ensemble/workflow/batch/batch_state.hpp"

#include <string>

namespace sturz::workflow {

/// RFC 4180, a row per job. Columns `state`, `why`, `message`, `core_s` and `utilisation` tell of
/// this call and this machine; all others are a function of the results.
std::string summary_csv(const BatchDone&);

/// summary.csv, summary.html and, where results changed, outlines.gpkg. \throws IoError; Cancelled
void write_summary(BatchDone&, BatchState&, CancelFlag cancel);

}  // namespace sturz::workflow
