// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/censoring_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::HasSubstr;

MemberSummary member(Outcome outcome, Censoring censoring, double lost = 0) {
  MemberSummary m;
  m.outcome = outcome;
  m.censoring = censoring;
  m.scalars.lost_fraction = lost;
  return m;
}

std::vector<MemberSummary> ensemble() {
  std::vector<MemberSummary> all(28, member(Outcome::settled, Censoring::none));
  all.insert(all.end(), 3, member(Outcome::out_of_time, Censoring::still_moving));
  all.insert(all.end(), 8, member(Outcome::left_terrain, Censoring::left_terrain, 0.42));
  all.push_back(member(Outcome::out_of_time, Censoring::left_and_moving, 0.88));
  all.push_back(member(Outcome::failed, Censoring::none));
  return all;
}

TEST(CensoringReport, CountsValidMembersOnceEach) {
  const CensoringReport r = censoring_report(ensemble(), 0.05);
  EXPECT_EQ(r.valid, 40);
  EXPECT_EQ(r.settled, 28);
  EXPECT_EQ(r.censored(), 12);
  EXPECT_EQ(r.left(), 9);
  EXPECT_EQ(r.moving(), 4);
  EXPECT_DOUBLE_EQ(r.fraction(), 0.3);
  EXPECT_DOUBLE_EQ(r.largest_lost_fraction, 0.88);
  EXPECT_EQ(counts_text(r),
            "28 settled, 3 out of time, 8 left the terrain, 1 left the terrain and still moved");
}

TEST(CensoringReport, IsTooMuchAboveTheAcceptedShareOnly) {
  EXPECT_TRUE(censoring_report(ensemble(), 0.29).too_many());
  EXPECT_FALSE(censoring_report(ensemble(), 0.3).too_many());
  EXPECT_FALSE(censoring_report({}, 0).too_many());
}

TEST(CensoringReport, SaysWhatWasCutHowManyWhereAndWhatToDo) {
  CensoringReport r = censoring_report(ensemble(), 0.05);
  r.where = "over the eastern edge (y 100 to 200)";
  std::string all;
  for (const std::string& sentence : censoring_sentences(r)) all += sentence + " ";
  EXPECT_THAT(all, HasSubstr("12 of 40 simulations (30 %) are cut off."));
  EXPECT_THAT(all, HasSubstr("In 9 of them mass ran off the known terrain over the eastern edge "
                             "(y 100 to 200), up to 88 % of a simulation's mass."));
  EXPECT_THAT(all, HasSubstr("In 4 of them mass still moved at the end time."));
  EXPECT_THAT(all, HasSubstr("lower bound"));
  EXPECT_THAT(all, HasSubstr("larger terrain.raster"));
  EXPECT_THAT(all, HasSubstr("longer numerics.end_time_s"));
}

MemberSummary wet_member(double grains, double liquid) {
  const bool left = grains > 0 || liquid > 0;
  MemberSummary m =
      member(left ? Outcome::left_terrain : Outcome::settled,
             left ? Censoring::left_terrain : Censoring::none, 0.7 * grains + 0.3 * liquid);
  m.scalars.solid_lost_fraction = grains, m.scalars.liquid_lost_fraction = liquid;
  return m;
}

std::string text_of(const CensoringReport& r) {
  std::string all;
  for (const std::string& sentence : censoring_sentences(r)) all += sentence + " ";
  return all;
}

TEST(CensoringReport, SaysWhichMaterialLeftAndHowMuchOfIt) {
  std::vector<MemberSummary> all(5, wet_member(0, 0));
  all.push_back(wet_member(0, 0.4));
  all.push_back(wet_member(0, 0.1));
  CensoringReport r = censoring_report(all, 0.05);
  EXPECT_EQ(r.censored(), 2);
  EXPECT_EQ(r.grains.left, 0);
  EXPECT_EQ(r.liquid.left, 2);
  EXPECT_DOUBLE_EQ(r.liquid.largest_lost_fraction, 0.4);
  EXPECT_THAT(text_of(r), HasSubstr("up to 12 % of a simulation's mass: grains in 0, liquid in 2 "
                                    "(up to 40 % of a simulation's liquid)."));
  EXPECT_THAT(text_of(r), HasSubstr("No grains left: what is said of grains alone is whole."));
  EXPECT_THAT(one_line(r), HasSubstr("; grains left in 0, liquid in 2)"));
  all.push_back(wet_member(0.05, 0.2));
  r = censoring_report(all, 0.05);
  EXPECT_EQ(r.grains.left, 1);
  EXPECT_EQ(r.liquid.censored, 3);
  EXPECT_THAT(text_of(r), testing::Not(HasSubstr("No grains left")));
  EXPECT_THAT(text_of(censoring_report({&all.back(), 1}, 0)),
              HasSubstr("(5 % of the grains, 20 % of the liquid)."));
  EXPECT_FALSE(censoring_report(ensemble(), 0.05).phases);
  EXPECT_THAT(text_of(censoring_report(ensemble(), 0.05)), testing::Not(HasSubstr("liquid")));
}

TEST(CensoringReport, AdvisesOnlyWhatHelps) {
  const std::vector<MemberSummary> late(2, member(Outcome::out_of_time, Censoring::still_moving));
  std::string all;
  for (const std::string& s : censoring_sentences(censoring_report(late, 0))) all += s + " ";
  EXPECT_THAT(all, ::testing::Not(HasSubstr("terrain.raster")));
  EXPECT_THAT(all, HasSubstr("longer numerics.end_time_s"));
  const std::vector<MemberSummary> rest(2, member(Outcome::settled, Censoring::none));
  EXPECT_TRUE(censoring_sentences(censoring_report(rest, 0)).empty());
}

TEST(MemberWarnings, CountSentencesThatDifferInNumbersOnly) {
  std::vector<MemberSummary> all(3);
  all[0].warnings = "5 % of the mass took off; thin flow";
  all[1].warnings = "7.5 % of the mass took off";
  const auto found = member_warnings(all);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].count, 2);
  EXPECT_EQ(found[0].text, "5 to 7.5 % of the mass took off");
  EXPECT_EQ(found[1].count, 1);
  const std::vector<std::string> known{"3 % of the mass took off"};
  EXPECT_EQ(member_warnings(all, known).size(), 1U) << "said before, with another number";
}

TEST(MemberWarnings, ShowTheWorstMemberAndNotTheFirst) {
  std::vector<MemberSummary> all(4);
  all[0].warnings = "energy: 2.3 % (more than 5 % either way)";
  all[1].warnings = "energy: -12 % (more than 5 % either way)";
  all[2].warnings = "energy: 7.5 % (more than 5 % either way)";
  all[3].warnings = "thin flow";
  const auto found = member_warnings(all);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].text, "energy: -12 to 7.5 % (more than 5 % either way)");
  EXPECT_EQ(found[1].text, "thin flow");
}

}  // namespace
}  // namespace sturz
