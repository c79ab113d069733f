// SPDX-License-Identifier: Apache-2.0
/// What matters in a finished ensemble: every scalar against every uncertain value.
#pragma once

#include "engine/core/cancel.hpp"
#include "ensemble/censoring/rank_agreement.hpp"
#include "ensemble/sensitivity/morris.hpp"
#include "ensemble/sensitivity/sobol_indices.hpp"
#include "ensemble/workflow/observer.hpp"
#include "scenarios/choices.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

/// One result.
struct ResultSensitivity {
  std::string name, unit;
  std::int64_t n_exact = 0, n_censored = 0;  ///< valid members; the others are cut off
  std::vector<RankAgreement> ranks;          ///< [keys]; bounds count where they decide
  std::vector<MorrisMeasure> morris;         ///< [keys]; design morris
  std::optional<SobolIndices> direct;        ///< design saltelli
  std::optional<EmulatedIndices> emulated;   ///< any other design of unit-cube points
  std::string why_not;                       ///< a sentence where indices are missing
};

struct Sensitivity {
  Design design = Design::table;
  std::vector<std::string> keys, units;
  std::vector<ResultSensitivity> results;
  std::filesystem::path file;  ///< sensitivity.csv, written
  std::filesystem::path maps;  ///< sensitivity.nc, where asked for
};

struct SensitivityRequest {
  std::filesystem::path folder;      ///< of a finished ensemble
  std::vector<std::string> results;  ///< columns of members.csv; empty: the usual ones
  bool emulate = true;               ///< indices by emulator where the design gives none
  bool maps = false;                 ///< indices of each cell too; of a saltelli design
};

/// Reads the members of a folder and writes sensitivity.csv, and sensitivity.nc, beside them. Maps
/// of an earlier call go when none are asked for: they may be of other members than the table.
/// \throws SetupError: no ensemble, no uncertain value, an unknown result, maps of another design;
///   Cancelled
Sensitivity sensitivity_of(const SensitivityRequest&, Observer&, CancelFlag cancel = {});

}  // namespace sturz::workflow
