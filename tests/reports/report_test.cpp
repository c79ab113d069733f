// SPDX-License-Identifier: Apache-2.0
#include "reports/page/report.hpp"

#include "reports/figures/figures.hpp"
#include "reports/page/sections/sections.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <string_view>

namespace sturz {
namespace {

/// Plain bool, so that a failure does not print a page of a megabyte.
bool holds(std::string_view page, std::string_view text) {
  return page.find(text) != std::string_view::npos;
}

/// The first element that is not closed in order; empty when the page nests well.
std::string nesting_error(std::string_view html) {
  static const std::set<std::string> empty_elements{"meta", "br", "input", "img", "!doctype"};
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string_view::npos; at = html.find('<', at)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string_view::npos) return "unfinished tag";
    const std::string_view tag = html.substr(at + 1, end - at - 1);
    const bool closing = tag.starts_with('/');
    const std::string name(tag.substr(closing, tag.find_first_of(" /\n", closing) - closing));
    at = end;
    if (tag.ends_with('/') || empty_elements.contains(name)) continue;
    if (closing) {
      if (open.empty() || open.back() != name) return "</" + name + ">";
      open.pop_back();
    } else {
      open.push_back(name);
      if (name == "script" || name == "style") at = html.find("</" + name, at);
    }
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

/// What the page's script would read.
nlohmann::json data_of(const std::string& page) {
  const std::string start = "id=\"sturz-data\">";
  const std::size_t from = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(Report, NestsWellInEveryCase) {
  const auto results = testing::make_up_results();
  EXPECT_EQ(nesting_error(make_report(results.ensemble_input())), "");
  EXPECT_EQ(nesting_error(make_report(results.single_input())), "");
  EXPECT_EQ(nesting_error(make_report({})), "");
  EXPECT_EQ(nesting_error("<p><b></p></b>"), "</p>") << "the checker itself must find errors";
}

TEST(Report, LetsNoUserTextBecomeMarkup) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  input.title = "</title><script>alert(1)</script>";
  input.warnings = {"<img src=x onerror=alert(1)>"};
  input.notes = {"</ul><script>alert(2)</script>"};
  input.samples.columns[0] = "</script><script>alert(3)</script>";
  const std::string page = make_report(input);
  EXPECT_FALSE(holds(page, "<script>alert"));
  EXPECT_FALSE(holds(page, "<img src=x"));
  EXPECT_EQ(nesting_error(page), "");
  EXPECT_EQ(count(page, "</script>"), report_has_script() ? 3U : 0U);
}

TEST(Report, NamesNothingOutsideItself) {
  std::string page = make_report(testing::make_up_results().ensemble_input());
  if (report_has_script()) page.erase(page.rfind("<script>"));  // the libraries' own words
  EXPECT_TRUE(holds(page, "default-src 'none'"));
  EXPECT_FALSE(holds(page, "src=\"http"));
  EXPECT_FALSE(holds(page, "<link"));
  EXPECT_FALSE(holds(page, "style=\"")) << "the policy would block inline styles";
  EXPECT_FALSE(holds(page, "@import"));
}

TEST(Report, HoldsWhatAReaderNeeds) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(results.ensemble_input());
  for (const char* text :
       {"Gully above the made-up village", "31 of 32", "Read this first", "Median runout",
        "95\u00A0% interval", "not resolved", "WGS 84 / UTM zone 33N", "friction_coefficient",
        "simulations per hour", "Median crown to toe, L", "H/L", "Median centre-of-mass travel",
        "(EPSG:32633)", "Share of the valid simulations", "sturz 0.1.0 (9f31c02)",
        "Probability that the flow arrives"})
    EXPECT_TRUE(holds(page, text));
  EXPECT_TRUE(holds(page, "bound by &lt;terrain contact&gt;")) << "why member 11 failed";
  EXPECT_EQ(count(page, "<figure>"), 6U) << "still figures";
}

TEST(Report, StaysSmall) {
  testing::MadeUpScene scene{
      .n_cols = 300, .n_rows = 200, .cell_m = 8, .n_members = 4, .n_failed = 0};
  const auto results = testing::make_up_results(scene);
  EXPECT_LT(make_report(results.ensemble_input()).size(), 1'500'000U);
}

TEST(Report, SaysThatNoMemberIsValid) {
  auto results = testing::make_up_results({.n_members = 0});
  ReportInput input = results.ensemble_input();
  EXPECT_TRUE(holds(make_report(input), "No member has finished yet"));
  input.members.resize(3);
  input.samples.rows.clear();
  for (auto& m : input.members) m.outcome = Outcome::failed, m.reason = "disk full";
  const std::string page = make_report(input);
  EXPECT_TRUE(holds(page, "None of the 3 members is valid"));
  EXPECT_TRUE(holds(page, "There is no map to show"));
  EXPECT_TRUE(holds(page, "disk full"));
  EXPECT_EQ(nesting_error(page), "");
}

/// The made-up ensemble with its longest members cut off by the end time, `n` of them.
ReportInput with_cut_members(const testing::MadeUpResults& results, int n) {
  ReportInput input = results.ensemble_input();
  input.max_censored_fraction = 0.05;
  for (MemberSummary& m : input.members) {
    if (!is_valid(m.outcome)) continue;
    m.censoring = n > 0 ? Censoring::still_moving : Censoring::none;
    m.outcome = n-- > 0 ? Outcome::out_of_time : Outcome::settled;
  }
  return input;
}

TEST(Report, BeginsWithWhatIsCutOffWhereThatIsMuch) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(with_cut_members(results, 20));
  const std::size_t banner = page.find("<section class=\"banner\"");
  ASSERT_NE(banner, std::string::npos);
  EXPECT_LT(banner, page.find("Read this first"));
  EXPECT_TRUE(holds(page, "20 of 31 simulations (65 %) are cut off."));
  EXPECT_TRUE(holds(page, "In 20 of them mass still moved at the end time."));
  EXPECT_TRUE(holds(page, "a longer numerics.end_time_s"));
  EXPECT_TRUE(holds(page, "upper end not known"));
  EXPECT_TRUE(holds(page, "20 of 31 cut off"));
  EXPECT_TRUE(holds(page, "at least: the member is cut off"));
  EXPECT_TRUE(holds(page, "11 settled, 20 out of time, 1 diverged"));
  EXPECT_EQ(nesting_error(page), "");
}

TEST(Report, APartOfAnEnsembleSaysSo) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  EXPECT_EQ(make_report(input).find("are missing here"), std::string::npos);
  input.n_planned = 40;
  const std::string page = make_report(input);
  EXPECT_NE(page.find("8 of the 40 planned members are missing here"), std::string::npos);
  EXPECT_NE(page.find("Ensemble of 32 of 40 members"), std::string::npos);
  EXPECT_NE(page.find(", 8 not computed yet"), std::string::npos);
}

TEST(Report, SaysWhatIsCutOffAmongTheWarningsWhereItIsLittle) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(with_cut_members(results, 1));
  EXPECT_FALSE(holds(page, "<section class=\"banner\""));
  EXPECT_TRUE(holds(page, "<li>1 of 31 simulations (3 %) are cut off."));
  const std::string clean = make_report(with_cut_members(results, 0));
  EXPECT_FALSE(holds(clean, "cut off."));
  EXPECT_FALSE(holds(clean, "at least: the member is cut off"));
}

TEST(Report, ASingleRunThatIsCutOffSaysSo) {
  const auto results = testing::make_up_results();
  ReportInput input = results.single_input();
  input.members.front().outcome = Outcome::left_terrain;
  input.members.front().censoring = Censoring::left_terrain;
  input.members.front().scalars.lost_fraction = 0.3;
  input.where_mass_left = "over the eastern edge (y 1 to 2)";
  const std::string page = make_report(input);
  EXPECT_TRUE(holds(page, "This result is cut off."));
  EXPECT_TRUE(
      holds(page, "ran off the known terrain over the eastern edge (y 1 to 2): 30 % of it."));
  EXPECT_TRUE(holds(page, "<dt>Runout</dt><dd class=\"value\">\u2265"));
}

TEST(Report, TheScriptKnowsWhichMembersAreCutOffAndWhichPairsCount) {
  if (!report_has_script()) GTEST_SKIP() << "built without the script bundle";
  const auto results = testing::make_up_results();
  const auto data = data_of(make_report(with_cut_members(results, 20)));
  int cut = 0;
  for (const auto& c : data["members"]["cut"]) cut += c.get<bool>();
  EXPECT_EQ(cut, 20);
  const auto& agreement = data["members"]["samples"][0]["agreement"];
  EXPECT_EQ(agreement["pairs"], 31 * 30 / 2);
  EXPECT_LE(agreement["ordered"].get<int>(), 31 * 30 / 2 - 20 * 19 / 2);
  EXPECT_TRUE(data["runout"]["open"].get<bool>());
}

TEST(Report, TakesOneMemberAsAnEnsembleOfOne) {
  const auto results = testing::make_up_results({.n_members = 1, .n_failed = 0});
  const std::string page = make_report(results.ensemble_input());
  EXPECT_TRUE(holds(page, "Ensemble of 1 member "));
  EXPECT_TRUE(holds(page, "too few simulations for an interval"));
  EXPECT_EQ(nesting_error(page), "");
}

TEST(Report, ShowsASingleRunFromItsPeaks) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(results.single_input());
  EXPECT_TRUE(holds(page, "Maps of the run"));
  EXPECT_TRUE(holds(page, "Peak flow thickness"));
  EXPECT_FALSE(holds(page, "Probability that"));
}

TEST(Report, TellsWhereTheTimeWentByEffectAndFoldedByPass) {
  const auto results = testing::make_up_results();
  const std::string single = make_report(results.single_input());
  const std::size_t effects = single.find(">kinetic theory</th>");
  const std::size_t folded = single.find("<summary>By pass of a step</summary>");
  const std::size_t passes = single.find(">pair sweep, dispersed groups</th>");
  ASSERT_NE(passes, std::string::npos);
  EXPECT_LT(effects, folded);
  EXPECT_LT(folded, passes);
  const std::string ensemble = make_report(results.ensemble_input());
  EXPECT_TRUE(holds(ensemble, ">kinetic theory</th>"));
  EXPECT_FALSE(holds(ensemble, "By pass of a step"));
}

TEST(Report, DrawsWithoutElevationAndWithoutAnyTouchedCell) {
  auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  input.elevation = nullptr;
  EXPECT_EQ(nesting_error(make_report(input)), "");
  for (auto& layer : results.hazard.layers)
    std::fill(layer.values.begin(), layer.values.end(), 0.0F);
  EXPECT_EQ(nesting_error(make_report(input)), "");
  for (auto& layer : results.hazard.layers)
    std::fill(layer.values.begin(), layer.values.end(), nan_f);
  EXPECT_TRUE(holds(make_report(input), "There is no map to show"));
}

TEST(Report, CutsHugeTablesButKeepsEveryFailedMember) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  const MemberSummary one = input.members.front();
  input.members.assign(3000, one);
  for (std::size_t k = 0; k < input.members.size(); ++k)
    input.members[k].member = static_cast<std::int64_t>(k);
  input.members[2999].outcome = Outcome::failed;
  input.samples.rows.assign(3000, {0.2, 0.1, 0.6, 0});
  const std::string page = make_report(input);
  EXPECT_TRUE(holds(page, "500 of 3000 members are shown"));
  EXPECT_TRUE(holds(page, "<tr class=\"lost\"><td class=\"n\" data-v=\"2999\">"));
  EXPECT_LT(page.size(), 2'000'000U);
}

TEST(Report, RefusesSamplesOfOtherMembers) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  input.samples.rows.pop_back();
  EXPECT_THROW(make_report(input), std::logic_error);
}

TEST(Report, IntervalsOfWeightedMapsAreOfWhatTheirMembersAreWorth) {
  if (!report_has_script()) GTEST_SKIP() << "built without the script bundle";
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  const auto alike = data_of(make_report(input));
  EXPECT_EQ(alike["trials"], 31);
  EXPECT_FALSE(alike["weighted"]);
  input.effective_members = 7.5;
  const auto weighted = data_of(make_report(input));
  EXPECT_EQ(weighted["trials"], 7.5);
  EXPECT_TRUE(weighted["weighted"]);
}

TEST(Report, GivesTheScriptEveryLayerAndMarksUnresolvedThresholds) {
  if (!report_has_script()) GTEST_SKIP() << "built without the script bundle";
  const auto results = testing::make_up_results();
  const auto data = data_of(make_report(results.ensemble_input()));
  EXPECT_EQ(data["valid"], 31);
  const auto& layers = data["maps"]["layers"];
  EXPECT_EQ(layers[data["maps"]["start"].get<std::size_t>()]["name"], "probability_of_reach");
  EXPECT_TRUE(layers[0]["comment"].get<std::string>().starts_with("share of the 31 valid simulat"));
  bool seen = false;
  for (const auto& layer : layers)
    if (layer["name"] == "thickness_exceedance") {
      seen = true;
      ASSERT_EQ(layer["planes"].size(), 4U);
      EXPECT_EQ(layer["planes"][3]["axis"], 2.0);
      EXPECT_EQ(layer["planes"][3]["resolved"], false);  // 2 m, half a spacing is 3.5 m
    } else if (layer["statistic"] == "probability" && layer["planes"].size() > 1) {
      EXPECT_EQ(layer["planes"][0]["resolved"], true) << layer["name"];
    }
  EXPECT_TRUE(seen);
  EXPECT_EQ(data["members"]["samples"].size(), 4U);
  EXPECT_EQ(data["members"]["samples"][0]["values"].size(), 32U);
}

TEST(ReportFigures, DrawReleaseAndNorthOnEveryMap) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(results.ensemble_input());
  EXPECT_EQ(count(page, "font-weight=\"700\" fill=\"#111\" text-anchor=\"middle\">N</text>"), 6U);
  EXPECT_EQ(count(page, "<span class=\"swatch release\"></span>release"), 6U);
  if (!report_has_script()) return;
  EXPECT_EQ(data_of(page)["maps"]["release"].size(), cell_outline(results.release).size());
}

TEST(ReportFigures, DrawTheObservedOutlineAndSayWhatItIs) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  EXPECT_EQ(count(make_report(input), "swatch observed\"></span>"), 0U);
  const std::vector<std::vector<Vec2>> rings = {{{100, 40}, {160, 40}, {160, 90}, {100, 40}}};
  input.observed = rings;
  input.observed_note = "mapped <2017>";
  const std::string page = make_report(input);
  EXPECT_EQ(count(page, "swatch observed\"></span>observed: mapped &lt;2017&gt;</li>"), 6U);
  EXPECT_EQ(count(page, "stroke-dasharray=\"7 4\""), 6U);
  if (!report_has_script()) return;
  const auto observed = data_of(page)["maps"]["observed"];
  EXPECT_EQ(observed["label"], "observed: mapped <2017>");
  EXPECT_EQ(observed["rings"][0][2], nlohmann::json({160, 90}));
  EXPECT_EQ(observed["rings"][0].size(), 4U);
}

TEST(Report, NamesKeysWithoutTheUnitThatStandsBesideThem) {
  const ReportTable samples{
      {"basal.turbulent_coefficient_m_s2", "erosion.growth_rate_per_m", "mixture.permeability_m2",
       "basal.viscosity_pa_s", "grains.density_kg_m3", "basal.friction_coefficient"},
      {"m s-2", "m-1", "m2", "Pa s", "kg m-3", "1"},
      {}};
  const char* labels[] = {
      "turbulent coefficient", "growth rate", "permeability", "viscosity", "density",
      "friction coefficient"};
  for (std::size_t k = 0; k < samples.columns.size(); ++k)
    EXPECT_EQ(key_label(samples, k), labels[k]);
}

TEST(Report, SaysWhoseClockTheTimesAreOf) {
  const auto results = testing::make_up_results();
  EXPECT_TRUE(holds(make_report(results.ensemble_input()), "By the clock, summed over"));
  EXPECT_TRUE(holds(make_report(results.ensemble_input()), "fade out up to two spacings"));
}

TEST(ReportFigures, ShowTheMostSevereOfJoinedCells) {
  LayerStack maps;
  maps.grid = {
      .n_cols = 1600, .n_rows = 1000, .west_m = 0, .north_m = 0, .cell_m = 1, .crs_wkt = ""};
  Layer thickness, arrival;
  thickness.name = "peak_thickness", thickness.units = "m";
  thickness.meaning = {Quantity::thickness, Statistic::peak};
  thickness.values.assign(maps.grid.n_cells(), 1);
  thickness.values[maps.grid.index(500, 801)] = 9;
  arrival.name = "arrival_time", arrival.units = "s";
  arrival.meaning = {Quantity::arrival, Statistic::peak};
  arrival.values.assign(maps.grid.n_cells(), nan_f);
  arrival.values[maps.grid.index(501, 800)] = 7;
  arrival.values[maps.grid.index(501, 801)] = 5;
  maps.layers = {thickness, arrival};
  const MapScene scene = make_map_scene(maps, nullptr);
  ASSERT_EQ(scene.coarsening, 2);
  const std::size_t joined = scene.cells.index(250, 400);
  EXPECT_EQ(scene_plane(scene, maps.layers[0], 0, maps.grid)[joined], 9);
  EXPECT_EQ(scene_plane(scene, maps.layers[1], 0, maps.grid)[joined], 5);
}

}  // namespace
}  // namespace sturz
