// SPDX-License-Identifier: Apache-2.0
/// Everything that a page may show, as its sections read it.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/core/vec.hpp"
#include "engine/simulation/member_result.hpp"
#include "engine/terrain/raster.hpp"
#include "ensemble/assets/asset_risk.hpp"
#include "ensemble/gauges/gauge_statistics.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/scores/score_table.hpp"
#include "scenarios/layers/layer_stack.hpp"
#include "scenarios/layers/source_lists.hpp"
#include "scenarios/overlays/overlay.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Named columns of numbers; rows in any order unless said otherwise, NaN where unknown.
struct ReportTable {
  std::vector<std::string> columns;
  std::vector<std::string> units;         ///< UDUNITS per column; may be empty
  std::vector<std::vector<double>> rows;  ///< [n][columns.size()]
};

/// What `sturz calibrate` found, as a page shows it.
struct PosteriorShown {
  struct Key {
    double before[3] = {}, after[3] = {};  ///< 5 %, 50 %, 95 %
    double variance_removed = 0;
    double best = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no best fit
  };
  struct Quantity {
    std::string name, unit;
    double observed = 0;
    double check[3] = {};  ///< predicted: 5 %, 50 %, 95 %
    bool has_held_out = false;
    double held_out[3] = {};  ///< the same by what the others tell
    double best_expected = std::numeric_limits<double>::quiet_NaN();  ///< by the emulator
    std::string best_computed{};  ///< words before the number, "at least" or "not known"
    double best_member = std::numeric_limits<double>::quiet_NaN();
    double q2 = std::numeric_limits<double>::quiet_NaN();  ///< of its emulator; NaN: none
    bool has_step = false;                                 ///< emulated on two sides
    bool ends_at_zero = false;  ///< a prediction was below 0, where no value is
  };
  struct Discrepancy {
    std::string kind;
    double mean = 0, lower = 0, upper = 0;  ///< share of the observed value; 5 % and 95 %
  };
  std::string origin;     ///< method, members, what they are worth: one sentence
  ReportTable rows;       ///< of equal weight
  std::vector<Key> keys;  ///< one per column of `rows`
  std::vector<Quantity> quantities;
  std::vector<std::pair<double, double>> reliability;  ///< nominal, inside
  double discrepancy_scale = 0;                        ///< of its prior; 0: none was allowed
  std::vector<Discrepancy> discrepancies;              ///< by kind of quantity
  std::vector<std::string> ridges, warnings;           ///< sentences
};

/// The sources of a region, whose maps are those of all of them.
struct RegionShown {
  struct Source {
    std::string name;
    std::string failure;                               ///< why it has no members; empty: it has
    std::int64_t planned = 0, valid = 0, cut_off = 0;  ///< members
    double release_volume_m3 = std::numeric_limits<double>::quiet_NaN();
    double possible_area_m2 = 0;   ///< that some member reaches
    double likely_area_m2 = 0;     ///< that half of the members reach
    double likeliest_area_m2 = 0;  ///< where no other source is more probable
  };
  std::vector<Source> sources;       ///< in the order of the features
  SourceLists lists;                 ///< on the cells of ReportInput::hazard
  std::int64_t members_planned = 0;  ///< of each source
  double touched_area_m2 = 0;        ///< that some source reaches
};

/// Two ensembles beside each other, the maps of the first in ReportInput::hazard.
struct ComparisonShown {
  std::string name_a, name_b;
  const LayerStack* b = nullptr;  ///< maps of the second, on the same cells
  std::size_t pairs = 0;          ///< 0: their members have nothing in common
  std::size_t valid_a = 0, valid_b = 0;
  std::size_t cut_off = 0;                 ///< members of both
  double least = 0, most = 0;              ///< P(B reaches) - P(A reaches) over the cells
  double less_m2 = 0, more_m2 = 0;         ///< where the interval of the difference leaves out 0
  std::vector<std::string> differences{};  ///< of the scenes: "key: A -> B"
};

/// One member's thickness over time, for the page to play.
struct FramesShown {
  std::int64_t member = 0;
  Grid grid;
  std::vector<double> times_s;                ///< rising; the last is the end
  std::vector<std::vector<float>> thickness;  ///< [times][grid.n_cells()] vertical [m]
};

struct ReportInput {
  std::string language = "en";  ///< one of page_languages()
  std::string title;
  std::string scenario_yaml;
  /// Version, git hash, compiler, seed, design, checksums of inputs, command, date ... in order.
  std::vector<std::pair<std::string, std::string>> manifest;
  const Raster<double>* elevation = nullptr;  ///< may be null: maps without relief
  const LayerStack* hazard = nullptr;         ///< maps of the ensemble; null for a single run
  const LayerStack* peaks = nullptr;          ///< maps of one member, used when `hazard` is null
  const MemberHistory* history = nullptr;     ///< of a single run; may be null or empty
  const FramesShown* frames = nullptr;        ///< may be null: nothing is played
  const GaugeFindings* gauges = nullptr;      ///< may be null or empty
  std::vector<MemberSummary> members;
  double effective_members = 0;  ///< that weighted maps are worth; 0: members count alike
  std::vector<double> weights;   ///< of the valid ones of `members`, in their order; or none
  ReportTable samples;           ///< sampled keys; one row per entry of `members`, or no rows
  std::vector<ConvergencePoint> convergence;  ///< may be empty
  std::string stop_rule;                      ///< what decided the number of members; may be empty
  std::vector<std::string> warnings;          ///< to be read before the maps
  std::vector<std::string> notes;             ///< what was resampled, corrected, left out
  std::vector<std::string> description;       ///< lines of `describe`: effects and why
  NamedSeconds timings;                       ///< by effect, all members together [s]
  NamedSeconds pass_timings;                  ///< by pass of a step, shown folded; may be empty [s]
  double elapsed_s = 0;                       ///< wall time of the whole run; 0 = unknown
  CancelFlag cancel;                 ///< looked at between maps; make_report then throws Cancelled
  std::int64_t n_planned = 0;        ///< members of the whole ensemble; 0: those that are here
  double max_censored_fraction = 0;  ///< of members; above it the page begins with a banner
  std::string where_mass_left;       ///< in words, may be empty
  const Raster<std::uint8_t>* release = nullptr;  ///< 1: covered at the start; may be null
  std::span<const std::vector<Vec2>> observed;    ///< closed rings of a mapped event [m]
  std::string observed_note;                      ///< what they are, in words; may be empty
  const ScoreTable* scores = nullptr;  ///< one row per entry of `members`; null: none is scored
  const Raster<std::uint8_t>* nearest = nullptr;  ///< covered by the best member; may be null
  std::int64_t nearest_member = 0;                ///< its number
  std::span<const Overlay> overlays;              ///< drawn over the maps
  /// Of the window of a grid as a JPEG file; null or empty bytes: there is no orthophoto.
  std::function<std::vector<std::uint8_t>(const Grid&)> orthophoto;
  const Assets* assets = nullptr;               ///< what may be hit; null: the scene names nothing
  const RiskTable* risk = nullptr;              ///< of these assets
  const RegionShown* region = nullptr;          ///< null: one ensemble; else `members` is empty
  const ComparisonShown* comparison = nullptr;  ///< null: one ensemble; else `members` is empty
  const PosteriorShown* posterior = nullptr;    ///< null: nothing was calibrated
  double resolved_thickness_m = 0;  ///< thickness thresholds below it are marked 'not resolved'
};

}  // namespace sturz
