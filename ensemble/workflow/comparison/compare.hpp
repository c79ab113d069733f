// SPDX-License-Identifier: Apache-2.0
/// Two finished ensembles side by side: what a dam changes, how far two models differ.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/comparison/difference_maps.hpp"
#include "ensemble/workflow/observer.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct CompareRequest {
  std::filesystem::path a, b;  ///< folders of ensembles
  std::filesystem::path out;   ///< folder for the results, made where it is missing
  bool paired = true;          ///< false: members of the same number have nothing in common
};

struct Compared {
  std::size_t n_pairs = 0, n_a = 0, n_b = 0;  ///< pairs, and valid members
  std::size_t cut_off = 0;                    ///< of the members of both
  std::vector<std::string> differences;       ///< of the scenes: "key: A -> B"
  DifferenceSummary summary;
  std::vector<double> thickness_m;  ///< thresholds that both scenes ask for
  std::size_t n_assets = 0;
  std::filesystem::path maps;  ///< comparison.nc
  bool has_page = false;       ///< report.html: both have finished maps
};

/// Writes comparison.nc, comparison/*.tif with styles and list, report.html with both beside each
/// other, and, where both scenes have the
/// same assets, asset_differences.csv and .gpkg.
/// \throws SetupError: folders that are no finished ensembles or lie on other cells; with `paired`
///   members that did not draw the same, naming what differs; IoError; Cancelled
Compared compare(const CompareRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
