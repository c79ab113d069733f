// SPDX-License-Identifier: Apache-2.0
// The finding in one sentence says no more than is known.
#include "reports/page/headline.hpp"
#include "reports/page/sections/sections.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class PlainWordsOfAssets : public ::testing::Test {
 protected:
  PlainWordsOfAssets() {
    for (const char* name : {"hut", "farm", "road"}) {
      assets_.list.emplace_back();
      assets_.list.back().name = name;
    }
    risk_.rows.resize(3);
    for (AssetRisk& row : risk_.rows) row.probability = 0;
  }
  std::string finding() {
    ReportInput input = results_.ensemble_input();
    input.assets = &assets_;
    input.risk = &risk_;
    return plain_words(input, headline(input)).finding;
  }
  void lies_beyond(std::size_t k) {
    risk_.rows[k] = {};
    risk_.rows[k].place = AssetPlace::outside;
  }

  testing::MadeUpResults results_ = testing::make_up_results();
  Assets assets_;
  RiskTable risk_;
};

TEST_F(PlainWordsOfAssets, OfThoseBeyondTheKnownGroundNothingIsSaid) {
  EXPECT_THAT(finding(), HasSubstr("None of the 3 assets is hit by any simulation."));
  lies_beyond(1);
  EXPECT_THAT(finding(), AllOf(HasSubstr("None of the 2 assets is hit"),
                               HasSubstr("Of 1 asset beyond the known ground nothing is known.")));
  lies_beyond(0);
  lies_beyond(2);
  EXPECT_THAT(finding(), AllOf(Not(HasSubstr("None of")),
                               HasSubstr("Of 3 assets beyond the known ground nothing is known.")));
}

TEST_F(PlainWordsOfAssets, ALowerBoundIsCalledOneAndAQuantileIsNoMinimum) {
  AssetRisk& farm = risk_.rows[1];
  farm.probability = 0.25;
  farm.bounds_95 = {0.13, 0.6};
  farm.arrival_s = {31, 35, 40};
  EXPECT_THAT(finding(), AllOf(HasSubstr("1 of 3 assets"), HasSubstr("farm, with 25\u00A0% (13"),
                               HasSubstr("simulations that hit it take 31 s or less"),
                               Not(HasSubstr("earliest"))));
  farm.not_known = 3;
  EXPECT_THAT(finding(), HasSubstr("farm, with at least 25\u00A0% (13"));
}

}  // namespace
}  // namespace sturz
