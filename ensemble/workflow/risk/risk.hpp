// SPDX-License-Identifier: Apache-2.0
/// From several ensembles of one site, each with a frequency, to maps and assets by year.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/workflow/observer.hpp"
#include "scenarios/risk/risk_spec.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sturz::workflow {

struct RiskRequest {
  std::filesystem::path file;  ///< risk file, see io/risk/risk_file.hpp
  std::filesystem::path out;   ///< folder for the results, made where it is missing
};

struct RiskMade {
  struct Scenario {
    std::string folder;
    double frequency_per_year = 0;
    std::int64_t valid = 0, cut_off = 0;  ///< members
  };
  std::vector<Scenario> scenarios;
  std::vector<double> return_periods_years;
  double highest_rate = 0;  ///< annual rate of the cell that is reached most often [1/year]
  std::size_t n_assets = 0;
  std::string value_unit;            ///< of the loss; empty: no values
  ExpectedValue total_loss;          ///< by year, of the assets that have one; NaN: not known
  std::size_t n_without_loss = 0;    ///< assets that it leaves out
  std::filesystem::path maps;        ///< risk.nc
  std::filesystem::path assets_csv;  ///< empty: no assets
};

/// Writes risk.nc, risk/*.tif with styles and list, and, where the scenes have assets,
/// assets_by_year.csv and .gpkg.
/// \throws SetupError: a wrong risk file, folders that are no finished ensembles, are named twice,
///   lie on other cells or have other assets; IoError; Cancelled
RiskMade make_risk(const RiskRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
