// SPDX-License-Identifier: Apache-2.0
/// The page of a region.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/workflow/region/region_job.hpp"
#include "ensemble/workflow/region/region_members.hpp"
#include "scenarios/layers/layer_stack.hpp"
#include "scenarios/layers/source_lists.hpp"

namespace sturz::workflow {

/// Writes report.html. \param coarse the maps in as few cells as a page shows
/// \param extent the maps' place in the members' grid \throws IoError; Cancelled
void write_region_page(const RegionJob&, const StoredMembers&, SourceLists lists, LayerStack coarse,
                       const Window& extent, CancelFlag cancel);

}  // namespace sturz::workflow
