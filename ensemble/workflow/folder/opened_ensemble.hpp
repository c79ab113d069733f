// SPDX-License-Identifier: Apache-2.0
/// Finished ensembles that are read together.
#pragma once

#include "ensemble/sampling/design.hpp"
#include "ensemble/workflow/folder/finished_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "io/members/member_store.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace sturz::workflow {

/// A finished ensemble with its inputs, design and members.
struct OpenedEnsemble {
  FinishedFolder finished;
  DesignTable design;
  std::unique_ptr<const MemberStore> members;

  std::string name() const { return finished.folder.root.string(); }
};

/// Warns of members that are missing or damaged, and of members that stand in sets. Nothing of the
/// folder is changed.
/// \throws SetupError: no ensemble, a design whose members have no probability, inputs that cannot
/// be read or were changed, a changed scenario,
///   no valid member; Cancelled
OpenedEnsemble open_ensemble(const std::filesystem::path& folder, Observer&,
                             CancelFlag cancel = {});

/// \throws SetupError naming the two that differ, and how: cells, place or coordinate system of the
///   maps
void require_same_maps(std::span<const OpenedEnsemble>);

/// The assets that all of them have; null where none has any.
/// \throws SetupError naming the two that differ in names, geometries, classes, curves or values
std::shared_ptr<const Assets> common_assets(std::span<const OpenedEnsemble>);

/// A folder for results made from other results. \throws SetupError when it holds an ensemble or a
/// run
void require_free_of_results(const std::filesystem::path& folder);

}  // namespace sturz::workflow
