// SPDX-License-Identifier: Apache-2.0
#include "reports/figures/legend.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

using enum Quantity;
using enum Statistic;

Layer layer(Quantity quantity, Statistic statistic, const std::string& units,
            std::vector<float> values, LayerAxis axis = {}) {
  Layer l;
  l.meaning = {quantity, statistic};
  l.units = units, l.values = std::move(values), l.axis = std::move(axis);
  return l;
}

TEST(ReportColours, GrowSteadilyDarker) {
  for (const Ramp ramp : {Ramp::hazard, Ramp::magnitude, Ramp::deposit, Ramp::neutral}) {
    const auto colours = ramp_colours(ramp, 24);
    for (std::size_t k = 1; k < colours.size(); ++k)
      EXPECT_LT(lightness(colours[k]), lightness(colours[k - 1]) - 0.005) << k;
  }
  const auto arrival = ramp_colours(Ramp::arrival, 24);
  EXPECT_LT(lightness(arrival.front()), lightness(arrival.back()));  // early is dark
}

TEST(ReportColours, OklabMeetsItsFixedPoints) {
  EXPECT_NEAR(lightness({0, 0, 0}), 0, 1e-9);
  EXPECT_NEAR(lightness({255, 255, 255}), 1, 1e-6);
  EXPECT_NEAR(lightness({255, 0, 0}), 0.627955, 1e-5);  // Ottosson's own table of sRGB red
  EXPECT_EQ(ramp_colours(Ramp::hazard, 2).front(), (Rgb{255, 238, 166}));
}

TEST(ReportLegend, PutsValuesIntoTheirClasses) {
  const Legend p = legend_for(layer(reached, probability, "1", {0, 0.5F, 1}));
  EXPECT_EQ(p.class_of(0), -1);
  EXPECT_EQ(p.class_of(nan_f), -1);
  EXPECT_EQ(p.class_of(0.01F), 0);
  EXPECT_EQ(p.class_of(0.1F), 2) << "0.1 as float is a little more than 0.1";
  EXPECT_EQ(p.class_of(0.5F), 4);
  EXPECT_EQ(p.class_of(1), 6);
  EXPECT_EQ(p.classes[4].label, "50\u201375\u00A0%");

  const Legend h = legend_for(layer(thickness, peak, "m", {0, 0.3F, 12}));
  ASSERT_EQ(h.classes.size(), 7U);
  EXPECT_EQ(h.classes.back().label, "\u2265\u00A010");
  EXPECT_EQ(h.class_of(12), 6);
  EXPECT_EQ(h.class_of(1.5F), 3);
  EXPECT_EQ(h.classes[3].label, "1\u20132");

  const Legend e = legend_for(layer(energy, peak, "J m-2", {2.4e6F}));
  EXPECT_EQ(e.unit.label, "kJ/m²");
  EXPECT_EQ(e.classes.back().label, "\u2265\u00A02000");
}

TEST(ReportLegend, ShowsTheEarliestArrivalToo) {
  const Legend t = legend_for(layer(arrival, peak, "s", {0, 31, 74, nan_f}));
  EXPECT_EQ(t.class_of(0), 0);
  EXPECT_EQ(t.class_of(nan_f), -1);
  EXPECT_EQ(t.class_of(74), static_cast<int>(t.classes.size()) - 1);
}

TEST(ReportLegend, GivesEachClassItsColourAndItsWords) {
  Layer fields = layer(other, Statistic::value, "1", {0, 4, 5, 7, 9});
  for (int field = 4; field <= 9; ++field)
    fields.classes.push_back({field, "words of " + std::to_string(field)});
  const Legend l = legend_for(fields);
  ASSERT_EQ(l.classes.size(), 6U);
  for (const int field : {4, 5, 7, 9})
    EXPECT_EQ(l.class_of(static_cast<float>(field)), field - 4) << field;
  EXPECT_EQ(l.class_of(0), -1);
  EXPECT_EQ(l.classes[3].label, "7: words of 7");
  for (std::size_t k = 1; k < l.classes.size(); ++k)
    EXPECT_NE(l.classes[k].colour, l.classes[k - 1].colour);
}

TEST(ReportLegend, OfDifferencesIsSymmetricAndPaintsWhatIsLess) {
  const Legend less = legend_for(layer(reached, difference, "1", {-0.9F, -0.3F, -0.01F, nan_f}));
  const Legend more = legend_for(layer(reached, difference, "1", {0, 0.9F}));
  ASSERT_EQ(less.classes.size(), 10U);
  ASSERT_EQ(more.classes.size(), 10U);
  for (const float d : {0.01F, 0.07F, 0.2F, 0.3F, 0.9F})
    EXPECT_EQ(less.class_of(d) + less.class_of(-d), 9) << d;
  EXPECT_EQ(less.class_of(-0.9F), 0);
  EXPECT_EQ(less.class_of(-1), 0);
  EXPECT_EQ(less.class_of(-0.3F), 1);
  EXPECT_EQ(less.class_of(-0.01F), 4);
  EXPECT_EQ(less.class_of(0), -1);
  EXPECT_EQ(less.class_of(nan_f), -1);
  EXPECT_EQ(less.classes[0].label, "less by \u2265\u00A050\u00A0%");
  EXPECT_EQ(more.classes[8].label, "more by 25\u201350\u00A0%");
  EXPECT_EQ(less.title, "Difference of the shares of the valid simulations");
  Layer weighted = layer(reached, probability, "1", {0.5F});
  EXPECT_EQ(legend_for(weighted).title, "Share of the valid simulations");
  weighted.comment = "weight of the members / weight of the valid members, weighted by posterior";
  EXPECT_EQ(legend_for(weighted).title, "Weighted share of the valid simulations");
}

TEST(ReportLegend, IsNeverEmpty) {
  EXPECT_FALSE(legend_for(layer(speed, peak, "m s-1", {0, 0})).classes.empty());
  EXPECT_FALSE(legend_for(layer(speed, peak, "m s-1", {nan_f})).classes.empty());
  EXPECT_FALSE(legend_for(layer(arrival, peak, "s", {nan_f})).classes.empty());
}

TEST(ReportLegend, NamesPlanesInWords) {
  const Layer p =
      layer(energy, probability, "1", {}, {"energy_threshold", "", "kJ m-2", {10, 100}});
  EXPECT_EQ(plane_label(p, 1), ">\u00A0100\u00A0kJ/m²");
  EXPECT_EQ(plane_title(p, 1), "Probability that kinetic energy per area exceeds 100\u00A0kJ/m²");
  const Layer q = layer(thickness, quantile, "m", {}, {"quantile", "", "1", {0.05, 0.5}});
  EXPECT_EQ(plane_label(q, 0), "5\u00A0% quantile");
  EXPECT_EQ(plane_title(q, 1), "Flow thickness, median");
  const Layer less = layer(thickness, difference, "1", {}, {"thickness_threshold", "", "m", {0.5}});
  EXPECT_EQ(plane_title(less, 0), "Probability that flow thickness exceeds 0.5\u00A0m: B less A");
}

TEST(ReportLegend, ShowsOnlyLayersThatSaySomething) {
  LayerStack maps;
  maps.grid.n_cols = maps.grid.n_rows = 1;
  maps.layers = {layer(members, count, "1", {3}),          layer(speed, mean, "m s-1", {nan_f}),
                 layer(reached, upper_bound, "1", {1}),    layer(thickness, peak, "m", {2}),
                 layer(reached, probability, "1", {0.5F}), layer(energy, peak, "J m-2", {1, 2, 3})};
  const auto shown = shown_layers(maps);
  ASSERT_EQ(shown.size(), 2U) << "no counts, no bounds, no NaN, no layer of another shape";
  EXPECT_EQ(default_layer(maps), &maps.layers[4]) << "P(reached)";
  maps.layers.clear();
  EXPECT_EQ(default_layer(maps), nullptr);
}

}  // namespace
}  // namespace sturz
