// SPDX-License-Identifier: Apache-2.0
/// What accuracy costs in one formulation: the same draws computed at several spacings.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/simulation/member_parts.hpp"
#include "ensemble/fidelity/checked_error.hpp"
#include "ensemble/fidelity/error_curve.hpp"
#include "ensemble/fidelity/map_distance.hpp"
#include "ensemble/fidelity/power_law.hpp"
#include "ensemble/fidelity/refinement.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// The members of one spacing; number k drew the same at every spacing.
struct Rung {
  double spacing_m = 0;
  const MemberParts* members = nullptr;
};

/// One number per member, over the spacings.
struct ResultAccuracy {
  std::string name, units;     ///< of scalar_table()
  std::int64_t n_members = 0;  ///< valid at every spacing, with that result fully known there
  Refinement refinement;
  std::vector<double> member_rms;  ///< [n_spacings] of each member's distance from its finest
  double spread = nan_d;           ///< standard deviation over the members at the finest spacing
  /// Standard deviation of one member's result under a displacement of its uncertain values too
  /// small to matter (1e-7 of their distance from the median), at the finest spacing that it was
  /// looked at; NaN: not looked at. No spacing tells less than this apart.
  double noise = nan_d;

  ErrorCurve member_errors, mean_errors;  ///< expected, in the result's unit (error_model.hpp)

  /// What errors are relative to: the size of the mean at the finest spacing.
  double scale() const;
  /// Expected error of one member, root mean square over them, over scale().
  double member_error(double spacing_m) const;
  /// Expected error of the mean over very many members, over scale().
  double mean_error(double spacing_m) const;
};

/// P(peak thickness > threshold) beside that of the finest spacing.
struct MapAccuracy {
  double threshold_m = 0;
  std::vector<MapDistance> distances;  ///< [n_spacings], the last one zero
  double noise =
      nan_d;  ///< relative distance from the map of the displaced members; NaN: not looked at
  ErrorCurve errors;  ///< expected area between the map and its limit over the mean area
};

struct LadderAccuracy {
  std::string formulation;
  std::vector<double> spacings_m;     ///< coarsest first
  std::vector<double> member_cpu_s;   ///< [n_spacings] mean over the common valid members
  PowerLaw seconds;                   ///< of member_cpu_s over spacing
  std::vector<std::int64_t> members;  ///< valid at every spacing
  std::int64_t n_asked = 0;           ///< members per spacing, as they were asked for
  std::vector<ResultAccuracy> results;
  /// Results that no member lets one know at every spacing: all were cut off at one or another.
  std::vector<std::string> not_told;
  std::vector<MapAccuracy> maps;
  std::vector<CheckedError> checked;  ///< by the held-out spacing; empty: none
  double held_out_m = nan_d;
};

/// What a ladder is looked at by.
struct LadderQuestions {
  std::vector<std::string> results;  ///< names of scalar_table()
  std::vector<double> thickness_m;   ///< thresholds of maps
  std::uint64_t seed = 1;            ///< of resampling
  Rung held_out = {};                ///< a finer one to check by; no members: none
};

/// \param rungs coarsest first; all on one grid
/// \param displaced the members of one rung with their values displaced; null: none
/// \param displaced_rung which rung that is
/// \throws SetupError when no member is valid at every spacing; Cancelled
LadderAccuracy ladder_accuracy(std::string formulation, std::span<const Rung> rungs,
                               const MemberParts* displaced, std::size_t displaced_rung,
                               const LadderQuestions&, CancelFlag cancel = {});

/// Results of members at another way of computing them, beside a rung: what an effect changes.
struct Change {
  std::string name, units;
  double mean = nan_d;            ///< of the other, less that of the rung, over common members
  double standard_error = nan_d;  ///< of it, by pairs
  double rung_mean = nan_d;
  std::int64_t n_members = 0;
};
std::vector<Change> changes(const MemberParts& rung, const MemberParts& other,
                            std::span<const std::string> results);
/// Mean computing time of the other's valid members over that of the same members of the rung.
double seconds_ratio(const MemberParts& rung, const MemberParts& other);

}  // namespace sturz
