// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/vector_style.hpp"

#include "scenarios/layers/layer_stack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Legend probability() {
  Layer layer;
  layer.meaning = {Quantity::reached, Statistic::probability};
  layer.units = "1";
  return legend_for(layer);
}

TEST(VectorStyle, HasACategoryForEachClassInItsColour) {
  const Legend legend = probability();
  const std::string style = class_symbology(legend);
  EXPECT_THAT(style, HasSubstr("attr=\"class\""));
  for (std::size_t k = 0; k < legend.classes.size(); ++k) {
    const Rgb c = legend.classes[k].colour;
    EXPECT_THAT(style, HasSubstr("value=\"" + std::to_string(k + 1) + "\""));
    EXPECT_THAT(style, HasSubstr("k=\"color\" v=\"" + std::to_string(c.r) + "," +
                                 std::to_string(c.g) + "," + std::to_string(c.b) + ",216\""));
  }
  EXPECT_THAT(style, HasSubstr("label=\"&lt;\u00a05\u00a0%\""));
}

TEST(VectorStyle, OfAssetsGoesByTheirProbabilityAndIsGreyWhereNothingIsKnown) {
  const std::string style = site_symbology(SiteLayer::assets, Shape::point);
  EXPECT_THAT(style, HasSubstr("&quot;probability&quot; &gt;= 0.05 AND "
                               "&quot;probability&quot; &lt; 0.1"));
  EXPECT_THAT(style, HasSubstr("filter=\"ELSE\" label=\"not known\""));
  EXPECT_THAT(style, HasSubstr("fieldName=\"name\""));
  EXPECT_THAT(style, HasSubstr("class=\"SimpleMarker\""));
}

TEST(VectorStyle, FollowsTheShape) {
  EXPECT_THAT(site_symbology(SiteLayer::gauge, Shape::line), HasSubstr("class=\"SimpleLine\""));
  EXPECT_THAT(site_symbology(SiteLayer::release, Shape::polygon),
              HasSubstr("k=\"style\" v=\"no\""));
  EXPECT_THAT(site_symbology(SiteLayer::release, Shape::polygon), Not(HasSubstr("<labeling")));
  EXPECT_THAT(vector_style("<a/>", Shape::polygon),
              HasSubstr("<layerGeometryType>2</layerGeometryType>"));
}

}  // namespace
}  // namespace sturz
