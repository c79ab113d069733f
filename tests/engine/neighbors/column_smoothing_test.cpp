// SPDX-License-Identifier: Apache-2.0
#include "engine/neighbors/column_smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

TEST(ColumnSmoothing, HasTheIntegralOne) {
  for (const double support_radius : {0.3, 1.0, 17.0}) {
    const ColumnSmoothing w{support_radius};
    const int n = 20000;
    const double step = support_radius / n;
    double integral = 0;
    for (int k = 0; k < n; ++k) {
      const double r = (k + 0.5) * step;
      integral += 2 * std::numbers::pi * r * w.value(r) * step;
    }
    EXPECT_NEAR(integral, 1, 1e-8) << support_radius;  // midpoints: (1/n)^2
  }
}

TEST(ColumnSmoothing, GradientIsTheDerivative) {
  const ColumnSmoothing w{2.5};
  const double step = 1e-5;
  for (double r = 0.01; r < 2.5; r += 0.07) {
    const double slope = (w.value(r + step) - w.value(r - step)) / (2 * step);
    EXPECT_NEAR(slope, -w.gradient(r) * r, 1e-9) << r;
  }
}

TEST(ColumnSmoothing, EndsSmoothlyAtItsSupportRadius) {
  const ColumnSmoothing w{2};
  for (const double r : {2.0, 2.1, 50.0}) {
    EXPECT_EQ(w.value(r), 0);
    EXPECT_EQ(w.gradient(r), 0);
  }
  EXPECT_NEAR(w.value(0), 7 / (std::numbers::pi * 4), 1e-15);
  EXPECT_LT(w.value(1.99), 1e-8);
  for (double r = 0; r < 1.9; r += 0.1) EXPECT_GT(w.value(r), w.value(r + 0.1));
}

TEST(ColumnSmoothing, ScalesWithItsSupportRadius) {
  const ColumnSmoothing one{1}, three{3};
  for (const double q : {0.0, 0.2, 0.55, 0.9}) {
    EXPECT_NEAR(three.value(3 * q), one.value(q) / 9, 1e-15);
    EXPECT_NEAR(three.gradient(3 * q), one.gradient(q) / 81, 1e-14);
  }
}

}  // namespace
}  // namespace sturz
