// SPDX-License-Identifier: Apache-2.0
/// The page of a batch: what came out of each job, with links to their own pages.
#pragma once

#include "engine/terrain/raster.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sturz {

struct BatchPageRow {
  std::string job, title;
  std::string state;  ///< "computed", "unchanged", "failed", "interrupted", "waiting", "skipped"
  std::string why, message;
  std::string link;  ///< to its page, from this one; empty: there is none
  std::int64_t valid = -1, finished = 0, planned = 0, censored = 0;  ///< valid < 0: not known
  bool single_run = false;
  std::array<double, 3> runout_m{nan_d, nan_d, nan_d};  ///< at 5, 50 and 95 %
  std::array<bool, 3> at_least{};
  double area_any_m2 = nan_d, area_half_m2 = nan_d;  ///< reached by any, with P >= 0.5
  std::string asset;                                 ///< the most probable one; empty: none
  double asset_probability = nan_d;
  std::size_t n_assets = 0;
  double core_s = nan_d, utilisation = nan_d;
};

struct BatchPage {
  std::string list;     ///< name of the list's file
  std::string when;     ///< UTC
  std::string program;  ///< with version
  std::string stop;     ///< why it ended before its end; empty: it did not
  double core_s = 0, wall_s = 0, utilisation = nan_d;  ///< of this call
  int cores = 1;
  std::string low_utilisation;
  std::vector<BatchPageRow> rows;
};

/// The whole page as UTF-8 text: no script, no other file, no network.
std::string make_batch_page(const BatchPage&);

}  // namespace sturz
