// SPDX-License-Identifier: Apache-2.0
/// The page's parts as HTML text, one function each, in the order in which they are read.
#pragma once

#include "reports/figures/map_scene.hpp"
#include "reports/page/headline.hpp"
#include "reports/page/report_input.hpp"

#include <string>

namespace sturz {

/// What came out, in one sentence, and what that holds for; empty without a valid member.
struct PlainWords {
  std::string finding;  ///< what is reached, how likely, how soon, how sure
  std::string holds;    ///< under which conditions, on how many simulations
};
PlainWords plain_words(const ReportInput& input, const Headline& h);
std::string plain_words_html(const ReportInput& input, const Headline& h);

/// Title, one line of origin, links to the parts below.
std::string header_html(const ReportInput& input, const Headline& h);
/// What is cut off, where more members are than the scenario accepts; else empty text.
std::string banner_html(const ReportInput& input, const Headline& h);
/// One line that leads to the warnings below the map; empty text when there are none.
std::string attention_html(const ReportInput& input, const Headline& h);
/// Warnings of the run and of its members; empty text when there are none.
std::string warnings_html(const ReportInput& input, const Headline& h);
std::string headline_html(const ReportInput& input, const Headline& h);
/// Map panel, and still figures for readers without script. `scene`, `maps` may be null.
std::string map_html(const ReportInput& input, const Headline& h, const MapScene* scene,
                     const LayerStack* maps);
/// Least, middle and largest of each value that was drawn, for print; empty text without any.
std::string ranges_html(const ReportInput& input);
/// Beside the map on the printed sheet: what it shows, of what, by whom and when.
std::string title_block_html(const ReportInput& input, const Headline& h, const MapScene& scene,
                             const LayerStack& maps);
/// Travel, speeds and states over time of a single run, and what it left out; empty text for an
/// ensemble.
std::string motion_html(const ReportInput& input);
/// Arrivals, peaks and discharges at the scene's gauges; empty text where it has none.
std::string gauges_html(const ReportInput& input);
/// Sources of a region with their members and areas; empty text for one ensemble.
std::string sources_html(const ReportInput& input);
/// Grains and liquid beside each other and together; empty text where they are not told apart.
std::string phases_html(const ReportInput& input);
/// Share of members, intensities, damage and loss at each asset; empty text where the scene has
/// none.
std::string assets_html(const ReportInput& input);
/// How much of the mass of an ensemble's members was too loose for a scene without states; empty
/// text where that is not known or nothing was left out.
std::string left_out_html(const std::vector<MemberSummary>& members);
/// Places for histogram, scatter plots, convergence; the script fills them.
std::string charts_html(const ReportInput& input, const Headline& h);
/// What was observed beside what the nearest members give; empty text where nothing was observed.
std::string observed_html(const ReportInput& input, const Headline& h);
/// Uncertain values before and after, pairs, predictive check; empty text without a calibration.
std::string posterior_html(const ReportInput& input);
std::string members_html(const ReportInput& input, const Headline& h);
/// Description, timings, notes.
std::string computation_html(const ReportInput& input, const Headline& h);
/// Manifest and scenario text.
std::string provenance_html(const ReportInput& input);
/// How the numbers are meant.
std::string reading_html(const ReportInput& input);

/// Short name of a sampled key: its last part where that is unique, else the whole path.
std::string key_label(const ReportTable& samples, std::size_t column);

}  // namespace sturz
