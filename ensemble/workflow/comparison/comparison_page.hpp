// SPDX-License-Identifier: Apache-2.0
/// Two ensembles on one page, with a line between them that can be moved.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/comparison/compare.hpp"
#include "ensemble/workflow/folder/opened_ensemble.hpp"
#include "scenarios/layers/layer_stream.hpp"

#include <array>
#include <filesystem>

namespace sturz::workflow {

/// Writes report.html into `out`: the maps of A and the differences, those of B beside them, all on
/// the cells of the differences. Without the maps of both (hazard.nc, made anew by `sturz merge`)
/// no page is written, and an earlier one is removed. \param differences of comparison.nc \return
/// whether there is a page \throws SetupError, IoError; Cancelled
bool write_comparison_page(const std::filesystem::path& out,
                           const std::array<OpenedEnsemble, 2>& both,
                           const LayerSource& differences, const Compared&, CancelFlag cancel);

}  // namespace sturz::workflow
