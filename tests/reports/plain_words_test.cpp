// SPDX-License-Identifier: Apache-2.0
// The finding in one sentence, the words of what is cut off, and the languages.
#include "reports/page/cut_off_text.hpp"
#include "reports/page/report.hpp"
#include "reports/page/sections/sections.hpp"
#include "reports/page/text.hpp"
#include "reports/texts/text_table.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlainWords, SayWhatIsReachedHowLikelyHowSoonAndHowSure) {
  const auto results = testing::make_up_results();
  const ReportInput input = results.ensemble_input();
  const Headline h = headline(input);
  const PlainWords words = plain_words(input, h);
  EXPECT_THAT(words.finding, HasSubstr("runs " + with_unit(h.runout_m.value, "m") +
                                       " or farther in half of the 31 simulations (95"));
  EXPECT_THAT(words.finding, HasSubstr(area_text(h.likely_area_m2.value) + " with a probability"));
  EXPECT_THAT(words.holds, HasSubstr("friction coefficient 0.1"));
  EXPECT_THAT(words.holds, HasSubstr("It rests on 31 simulations; 1 failed and does not count."));
}

TEST(PlainWords, TheLatestMedianArrivalIsThatOfTheLikelyArea) {
  const auto results = testing::make_up_results();
  const Layer& reached = *results.hazard.find("probability_of_reach");
  const Layer& arrival = *results.hazard.find("arrival_quantile");
  double last = 0;
  const std::size_t n = results.hazard.grid.n_cells();
  for (std::size_t i = 0; i < n; ++i)
    if (reached.values[i] >= 0.5F && arrival.axis.values.at(1) == 0.5)
      last = std::max<double>(last, arrival.values[n + i]);
  ASSERT_GT(last, 0);
  const ReportInput input = results.ensemble_input();
  EXPECT_THAT(plain_words(input, headline(input)).finding,
              HasSubstr("reached after about " + duration_text(std::round(last))));
}

TEST(PlainWords, CutOffMembersMakeItLowerBounds) {
  const auto results = testing::make_up_results({.edge = 0.45});
  const ReportInput input = results.ensemble_input();
  const PlainWords words = plain_words(input, headline(input));
  EXPECT_THAT(words.finding, HasSubstr("at least"));
  EXPECT_THAT(words.holds, HasSubstr("lower bounds"));
}

TEST(PlainWords, ARunSaysThatItIsOnlyOne) {
  const auto results = testing::make_up_results();
  const ReportInput input = results.single_input();
  EXPECT_THAT(plain_words(input, headline(input)).holds, HasSubstr("One simulation"));
  EXPECT_EQ(plain_words({}, headline({})).finding, "");
}

/// All kinds of what can be cut off.
std::vector<CensoringReport> reports() {
  std::vector<CensoringReport> all;
  for (const std::int64_t valid : {1, 12})
    for (const bool left : {false, true})
      for (const bool moving : {false, true})
        for (const int phases : {0, 1, 2, 3}) {
          CensoringReport r;
          r.valid = valid;
          r.left_terrain = left ? 1 : 0;
          r.still_moving = moving && (valid > 1 || !left) ? 1 : 0;
          r.settled = valid - r.left_terrain - r.still_moving;
          r.largest_lost_fraction = left ? 0.034 : 0;
          r.where = left ? "over the eastern edge" : "";
          r.phases = phases > 0;
          r.grains = {phases == 1 && left ? 1 : 0, phases == 2 ? 1 : 0, 0.2};
          r.liquid = {left ? 1 : 0, 1, 0.005};
          all.push_back(r);
        }
  return all;
}

TEST(CutOffText, IsInEnglishWhatEveryOtherDoorSays) {
  for (const CensoringReport& r : reports()) {
    EXPECT_EQ(cut_off_sentences(r), censoring_sentences(r));
    EXPECT_EQ(cut_off_counts(r), counts_text(r));
  }
}

TEST(Texts, SpeakTheLanguageOfTheInnermostScope) {
  EXPECT_THAT(page_languages(), ElementsAre("de", "en"));
  EXPECT_EQ(tr("nav.maps"), "Maps");
  EXPECT_EQ(shown_number(0.5), "0.5");
  {
    const LanguageScope german("de");
    EXPECT_EQ(tr("nav.maps"), "Karten");
    EXPECT_EQ(shown_number(-12345.678, 7), "\u221212\u202F345,68");
    EXPECT_EQ(plain_number(0.5), "0.5") << "for programs";
    {
      const LanguageScope english("en");
      EXPECT_EQ(shown_number(0.5), "0.5");
    }
    EXPECT_EQ(tr_count("attention", 1), "1 Hinweis schränkt diese Karten ein. Zuerst lesen:");
  }
  EXPECT_EQ(tr("nav.maps"), "Maps");
  EXPECT_THROW(tr("no.such.key"), std::logic_error);
  EXPECT_THROW(LanguageScope("xx"), std::logic_error);
}

TEST(Texts, AGermanPageSaysSo) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  input.language = "de";
  const std::string page = make_report(input);
  EXPECT_THAT(page, HasSubstr("<html lang=\"de\">"));
  EXPECT_THAT(page, HasSubstr("Wahrscheinlichkeit, dass die Masse ankommt"));
  EXPECT_THAT(page, Not(HasSubstr("Read this first")));
}

}  // namespace
}  // namespace sturz
