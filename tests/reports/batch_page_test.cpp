// SPDX-License-Identifier: Apache-2.0
#include "reports/batch/batch_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

BatchPage made_up() {
  BatchPage page;
  page.list = "slopes.yaml";
  page.when = "2026-11-30T06:00:00Z";
  page.program = "sturz 1.0.0 (abc)";
  page.core_s = 100;
  page.wall_s = 60;
  page.cores = 2;
  page.utilisation = 0.83;
  BatchPageRow good;
  good.job = "north <1>";
  good.state = "computed";
  good.why = "dem.tif changed (terrain.raster)";
  good.link = "north-0123abcd/report.html";
  good.valid = good.planned = 64;
  good.finished = 64;
  good.runout_m = {100, 150, 220};
  good.at_least = {false, false, true};
  good.area_any_m2 = 50000;
  good.area_half_m2 = 30000;
  good.n_assets = 3;
  good.asset = "school";
  good.asset_probability = 0.31;
  good.core_s = 90;
  good.utilisation = 0.9;
  BatchPageRow bad;
  bad.job = "broken";
  bad.state = "failed";
  bad.message = "terrain.raster = dem.tif: cannot be opened";
  page.rows = {good, bad};
  return page;
}

TEST(BatchPage, ShowsEveryJobWithItsLinkAndReason) {
  const std::string html = make_batch_page(made_up());
  EXPECT_THAT(html, HasSubstr("<a href=\"north-0123abcd/report.html\">north &lt;1&gt;</a>"));
  EXPECT_THAT(html, HasSubstr("dem.tif changed (terrain.raster)"));
  EXPECT_THAT(html, HasSubstr("150 m <small>100 \u2013 \u2265\u00A0220</small>"));
  EXPECT_THAT(html, HasSubstr("31\u00A0% <small>school</small>"));
  EXPECT_THAT(html, HasSubstr("<strong>broken</strong>: terrain.raster = dem.tif"));
  EXPECT_THAT(html, HasSubstr("<span class=\"state failed\">failed</span>"));
  EXPECT_THAT(html, Not(HasSubstr("Ended early")));
}

TEST(BatchPage, SaysWhyItEndedEarly) {
  BatchPage page = made_up();
  page.stop = "the stop file STOP is there";
  EXPECT_THAT(make_batch_page(page), HasSubstr("the stop file STOP is there. The same command"));
}

TEST(BatchPage, NeedsNothingBesideIt) {
  const std::string html = make_batch_page(made_up());
  for (const char* outside : {"http://", "https://", "<script", " style=\"", "<link", "<img"})
    EXPECT_THAT(html, Not(HasSubstr(outside))) << outside;
  EXPECT_THAT(html, HasSubstr("default-src 'none'; script-src 'none'; style-src 'sha256-"));
}

}  // namespace
}  // namespace sturz
