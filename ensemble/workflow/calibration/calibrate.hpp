// SPDX-License-Identifier: Apache-2.0
/// An ensemble, what was observed, and what is then known of the uncertain values.
///
///   DIR/                the ensemble of the scene, as `sturz ensemble` leaves it
///   DIR/active/K.csv    points that round K chose; DIR/active/K/ their members
///   DIR/best/           the member at the best fit
///   DIR/posterior.csv   rows of equal weight; a table for `ensemble.table`
///   DIR/posterior.json  all numbers
///   DIR/weights.csv     weight of each member that was drawn, for `sturz merge --posterior`
#pragma once

#include "ensemble/calibration/calibration.hpp"
#include "ensemble/workflow/calibration/chosen_members.hpp"
#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/results/maps.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sturz::workflow {

struct CalibrateRequest {
  EnsembleRequest ensemble;
  std::optional<PosteriorMethod> method;
  double discrepancy = default_discrepancy;
  int active_rounds = 0;
  int active_members = 0;  ///< of each round; 0: two per uncertain value, four at least
  bool check_best = true;  ///< compute the member at the best fit
};

/// One uncertain value before and after: 5 %, 50 %, 95 %, in its unit.
struct KeySummary {
  std::string key, unit;
  double prior[3] = {}, posterior[3] = {};
  double variance_removed = 0;  ///< in the unit cube of the prior
  std::optional<double> best;   ///< at the best fit
};

/// Where a posterior was found: elsewhere its values may mean something else.
struct FoundAt {
  std::string formulation;
  double spacing_m = 0, release_volume_m3 = 0;
  std::int64_t members = 0;  ///< of the ensemble
};

/// One of the events that a posterior was found with, see shared_events.hpp.
struct EventUsed {
  std::string name, folder, members_hash;
  double release_volume_m3 = 0;
  std::int64_t n_valid = 0;
};

struct Calibrated {
  Calibration found;
  std::vector<KeySummary> keys;
  std::vector<std::vector<double>> values;              ///< [points of the posterior][keys]
  std::vector<std::int64_t> members;                    ///< of found.member_weights
  std::int64_t n_drawn = 0, n_chosen = 0;               ///< valid members that were used
  std::optional<std::vector<Observation>> best_member;  ///< [observed], really computed
  double discrepancy = 0;
  std::uint64_t seed = 0;
  FoundAt at;
  std::string members_hash;       ///< of the ensemble, as its maps know it; empty: of several
  std::string observation_hash;   ///< of what it was calibrated with; empty: of several
  std::vector<EventUsed> events;  ///< of finished ensembles
};

/// Members that were chosen, behind those that were drawn.
void append(CalibrationData&, const ChosenMembers&);
/// Takes the chosen members away again where the method weighs members, which they are not drawn
/// for. \return a sentence where that is so, else empty
std::string leave_to_emulators(CalibrationData&, const CalibrationSettings&);

/// \throws SetupError before anything is computed: the scene has no `observation`, no uncertain
///   value, or a design that is not drawn from the prior
EnsembleJob prepare_calibration(const CalibrateRequest&, Observer&);

/// After the members of the job were computed and its maps made: rounds of chosen members, the
/// posterior, its check on a real member. Its files are written before that check, whose member may
/// fail or be interrupted, and stand without it. \param maps of the job
/// \throws SetupError; Cancelled
Calibrated calibrate_ensemble(const CalibrateRequest&, const EnsembleJob&, const MapsMade& maps,
                              Observer&, const std::atomic<bool>& cancel);

/// Each uncertain value before and after. \pre values, posterior, best fit and identifiability are
/// there
std::vector<KeySummary> key_summaries(const Scenario&, const Calibrated&);

/// Where the scene of a job would find its posterior.
FoundAt found_at(const Scene&);

}  // namespace sturz::workflow
