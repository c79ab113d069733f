// SPDX-License-Identifier: Apache-2.0
/// Collects what the page of a results folder needs, and writes it.
#pragma once

#include "engine/core/cancel.hpp"
#include "engine/core/vec.hpp"
#include "engine/simulation/member_result.hpp"
#include "ensemble/gauges/gauge_statistics.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/sampling/design.hpp"
#include "ensemble/scores/score_table.hpp"
#include "ensemble/workflow/folder/manifest.hpp"
#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/observer.hpp"
#include "ensemble/workflow/results/asset_files.hpp"
#include "reports/page/report_input.hpp"
#include "scenarios/layers/layer_stack.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// How many cells a page's maps have at most: more are joined, see coarse_layers().
inline constexpr std::size_t page_cells = 450'000;

/// The member whose covered cells a page draws beside the observed outline.
struct NearestMember {
  std::optional<std::int64_t> member;  ///< nothing: none is scored
  Raster<std::uint8_t> cells;
};
/// That of the smallest misfit, see best_rows().
NearestMember nearest_member(const MemberParts&, const std::optional<ScoreTable>&,
                             const std::shared_ptr<const ObservedEvent>&);

/// What there is to show; absent parts are null or empty.
struct PageContent {
  std::span<const Overlay> overlays;    ///< drawn over the maps
  std::filesystem::path scenario_file;  ///< empty: that of the page's folder
  const LayerStack* hazard = nullptr;
  const LayerStack* peaks = nullptr;
  const DesignTable* design = nullptr;
  const Raster<double>* elevation = nullptr;
  std::span<const MemberSummary> members;
  std::span<const ConvergencePoint> convergence;
  const StopRecord* stop = nullptr;  ///< null: no stop rule
  double effective_members = 0;      ///< that weighted maps are worth; 0: members count alike
  std::span<const double> weights;   ///< of the valid members, where they do not count alike
  CancelFlag cancel;
  std::string where_mass_left;                    ///< in words
  const Raster<std::uint8_t>* release = nullptr;  ///< see release_footprint()
  std::span<const std::vector<Vec2>> observed;    ///< rings of the observed outline [m]
  const ScoreTable* scores = nullptr;             ///< rows in the order of `members`
  const PosteriorShown* posterior = nullptr;      ///< of a calibration; null: none
  const NearestMember* nearest = nullptr;
  const AssetFindings* risk = nullptr;    ///< null: the scene has no assets
  const FramesShown* frames = nullptr;    ///< null: nothing is played
  const GaugeFindings* gauges = nullptr;  ///< see gauge_files.hpp
  const MemberResult* run = nullptr;      ///< of a single run: its history and where its time went
};

/// `warnings` of a scene without those that its members have answered: what was said of the edge,
/// where every member kept all its mass.
std::vector<std::string> still_true(std::vector<std::string> warnings,
                                    std::span<const MemberSummary> members);

/// Writes report.html. \throws IoError; Cancelled
void write_page(const OutputFolder&, const Manifest&, const Scenario&, const PageContent&);

/// Writes the page of a results folder again, from its maps and members.
/// \param language one of page_languages(); empty: the scenario's
/// \return the page's file. \throws SetupError when the folder has no maps, or not those of its
///   members; Cancelled
std::filesystem::path rewrite_page(const std::filesystem::path& folder, Observer&,
                                   CancelFlag cancel = {}, const std::string& language = {});

/// \throws SetupError when the page has no table of texts for `language`, naming `asked` (key or
///   option); empty is English
void require_language(const std::string& language, const std::string& asked);

}  // namespace sturz::workflow
