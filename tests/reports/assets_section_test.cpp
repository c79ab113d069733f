// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections/sections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Asset asset(const std::string& name) {
  Asset a;
  a.name = name;
  a.vulnerability_class = "timber";
  a.value = 1000;
  return a;
}

TEST(AssetsSection, ListsTheMostProbableFirstAndMarksLowerBounds) {
  Assets assets;
  assets.has_classes = assets.has_values = true;
  assets.value_unit = "CHF";
  assets.list = {asset("far <1>"), asset("low"), asset("high")};
  RiskTable risk;
  risk.rows.resize(3);
  risk.rows[0].place = AssetPlace::outside;
  risk.rows[1].probability = 0.1;
  risk.rows[1].bounds_95 = {0.04, 0.23};
  AssetRisk& high = risk.rows[2];
  high.probability = 0.8;
  high.bounds_95 = {0.65, 0.97};
  high.not_known = 2;
  high.hit_cut_off = 1;
  high.thickness_m = {0.5, 1.25, 2};
  high.damage = {0.4, 0.05};
  high.loss = {400, 50};
  high.cut_off = "2 cut off before they hit";
  risk.total_loss = {412.3, 51};
  risk.n_without_loss = 2;
  ReportInput input;
  input.assets = &assets;
  input.risk = &risk;
  const std::string html = assets_html(input);
  EXPECT_LT(html.find(">high<"), html.find(">low<"));
  EXPECT_LT(html.find(">low<"), html.find("far &lt;1&gt;"));
  EXPECT_THAT(html, AllOf(HasSubstr("\u2265\u00A0"
                                    "80\u00A0% (65\u00A0% \u2013 97\u00A0%)"),
                          HasSubstr("\u2265\u00A0"
                                    "1.25 (0.5 \u2013 2)"),
                          HasSubstr("\u2265\u00A0"
                                    "400 \u00B1 50"),
                          HasSubstr("expected loss<small>CHF</small>")));
  EXPECT_THAT(html, HasSubstr("10\u00A0% (4\u00A0% \u2013 23\u00A0%)"));
  EXPECT_THAT(html, HasSubstr("beyond the known ground: nothing is known"));
  EXPECT_THAT(html, HasSubstr("by one event: \u2265\u00A0"
                              "412 \u00B1 51 CHF. That is without 2 of 3 assets, whose loss"));
}

TEST(AssetsSection, IsNotThereWithoutAssets) {
  ReportInput input;
  EXPECT_THAT(assets_html(input), IsEmpty());
}

}  // namespace
}  // namespace sturz
