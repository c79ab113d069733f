// SPDX-License-Identifier: Apache-2.0
#include "reports/gis/qgis_style.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Layer layer(Quantity quantity, Statistic statistic, std::string units, std::vector<float> values) {
  Layer l;
  l.name = "map";
  l.meaning = {quantity, statistic};
  l.units = std::move(units);
  l.values = std::move(values);
  return l;
}

TEST(QgisStyle, DrawsTheClassesOfThePageAndNothingWhereNobodyCame) {
  const std::string style =
      qgis_style(layer(Quantity::reached, Statistic::probability, "1", {0, 0.5F, 1}));
  EXPECT_THAT(style, HasSubstr("<pixelListEntry min=\"0\" max=\"0\" percentTransparent=\"100\"/>"));
  // A share of exactly 5 % belongs to the class that begins there.
  EXPECT_THAT(style, HasSubstr("<item value=\"0.04999995\""));
  EXPECT_THAT(style, HasSubstr("value=\"inf\""));
  EXPECT_THAT(style, HasSubstr("label=\"&lt;\u00a05\u00a0%\""));
}

TEST(QgisStyle, KeepsTheFirstMomentOfAnArrival) {
  const std::string style =
      qgis_style(layer(Quantity::arrival, Statistic::quantile, "s", {nan_f, 0, 30}));
  EXPECT_THAT(style, Not(HasSubstr("percentTransparent")));
  EXPECT_THAT(style, HasSubstr(" s\""));
}

/// QGIS paints by upper ends: each field of the matrix lies below the end of its own class alone.
TEST(QgisStyle, HasOneClassForEachNumberOfALayerOfClasses) {
  Layer fields = layer(Quantity::other, Statistic::value, "1", {0, 4, 5, 7, 9});
  for (int field = 4; field <= 9; ++field)
    fields.classes.push_back({field, "field " + std::to_string(field)});
  const std::string style = qgis_style(fields);
  for (const char* item :
       {"<item value=\"4.999995\"", "<item value=\"5.999994\"", "<item value=\"6.999993\"",
        "<item value=\"7.999992\"", "<item value=\"8.999991\"", "label=\"7: field 7\""})
    EXPECT_THAT(style, HasSubstr(item));
}

TEST(QgisStyle, OfADifferenceReachesFromLessToMore) {
  const std::string style =
      qgis_style(layer(Quantity::reached, Statistic::difference, "1", {-0.3F, -0.1F}));
  EXPECT_THAT(style, HasSubstr("classificationMin=\"-1\""));
  EXPECT_THAT(style, HasSubstr("<item value=\"-0.5000005\""));
  EXPECT_THAT(style, HasSubstr("<item value=\"0\""));
  EXPECT_THAT(style, HasSubstr("label=\"less by 25\u201350\u00A0%\""));
}

TEST(QgisStyle, OfBoundsIsThatOfTheirProbability) {
  const Layer bound = layer(Quantity::thickness, Statistic::lower_bound, "1", {});
  const Layer probability = layer(Quantity::thickness, Statistic::probability, "1", {0.25F});
  EXPECT_EQ(qgis_style(bound), qgis_style(probability));
}

}  // namespace
}  // namespace sturz
