// SPDX-License-Identifier: Apache-2.0
/// The page of a study of what accuracy costs.
#pragma once

#include "engine/terrain/raster.hpp"
#include "ensemble/fidelity/ladder.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz {

/// What a result is off by, relative to it; NaN: not known.
struct CostPageParts {
  std::string result;
  double sampling = nan_d, resolution = nan_d, model = nan_d;
};

struct CostPageLadder {
  const LadderAccuracy* ladder = nullptr;
  std::vector<std::string> sentences;  ///< its cheapest spacing, its best split, what is not told
  std::vector<CostPageParts> parts;    ///< of the planned members at the finest spacing
};

/// Two ways of computing side by side, pair by pair.
struct CostPageChange {
  std::string title;
  std::span<const Change> changes;
};

struct CostPage {
  std::string title, when, program;
  std::string planned;  ///< "512 planned members"
  double wanted_error = 0.05;
  std::vector<CostPageLadder> ladders;
  std::vector<std::string> multilevel;  ///< sentences; may be empty
  std::vector<CostPageChange> changes;
  std::vector<std::string> warnings;
};

/// The whole page as UTF-8 text: no script, no other file, no network.
std::string make_cost_page(const CostPage&);

}  // namespace sturz
