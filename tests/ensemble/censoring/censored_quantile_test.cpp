// SPDX-License-Identifier: Apache-2.0
#include "ensemble/censoring/censored_quantile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace sturz {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Negative numbers stand for "at least that much".
std::vector<Observation> sample(std::initializer_list<double> values) {
  std::vector<Observation> all;
  for (const double v : values)
    all.push_back({std::abs(v), v < 0 ? Known::at_least : Known::exactly});
  return all;
}

// Acute myelogenous leukemia (Miller 1981), weeks; medians and quartiles as survfit of R gives
// them.
const auto maintained = sample({9, 13, -13, 18, 23, -28, 31, 34, -45, 48, -161});
const auto not_maintained = sample({5, 5, 8, 8, 12, -16, 23, 27, 30, 33, 43, 45});
// 6-mercaptopurine against placebo (Freireich and others 1963), weeks.
const auto mercaptopurine = sample(
    {6, 6, 6, -6, 7, -9, 10, -10, -11, 13, 16, -17, -19, -20, 22, 23, -25, -32, -32, -34, -35});

TEST(CensoredQuantile, IsThePublishedKaplanMeierEstimate) {
  EXPECT_EQ(censored_quantile(maintained, 0.5, 0.95).value, 31);
  EXPECT_EQ(censored_quantile(not_maintained, 0.5, 0.95).value, 23);
  EXPECT_EQ(censored_quantile(mercaptopurine, 0.25, 0.95).value, 13);
  EXPECT_FALSE(censored_quantile(maintained, 0.5, 0.95).at_least);
}

TEST(CensoredQuantile, IsALowerBoundWhereHalfIsCensored) {
  // 12 of 21 are censored: what the curve says beyond hangs on them being like the others.
  const CensoredEstimate e = censored_quantile(mercaptopurine, 0.5, 0.95);
  EXPECT_TRUE(e.at_least);
  EXPECT_EQ(e.value, 16);  // the 11th of 21, every censored value taken as it is
  EXPECT_EQ(e.lower, 9);   // the 6th (Conover's table: ranks 6 and 16 of 21)
  EXPECT_EQ(e.upper, infinite);
  EXPECT_EQ(e.n_at_least, 12U);
}

TEST(CensoredQuantile, IsTheOrdinaryMedianWhereNothingIsCensored) {
  EXPECT_EQ(censored_quantile(sample({3, 1, 2}), 0.5, 0.95).value, 2);
  EXPECT_EQ(censored_quantile(sample({4, 1, 3, 2}), 0.5, 0.95).value, 2.5);
  EXPECT_EQ(censored_quantile(sample({7, 7, 7, 7}), 0.5, 0.95).value, 7);
  EXPECT_TRUE(std::isnan(censored_quantile({}, 0.5, 0.95).value));
  std::vector<Observation> many(20001);
  for (std::size_t i = 0; i < many.size(); ++i) many[i].value = static_cast<double>(i + 1);
  const CensoredEstimate e = censored_quantile(many, 0.5, 0.95);
  EXPECT_EQ(e.value, 10001);
  EXPECT_NEAR(e.lower, 10001 - 1.96 * std::sqrt(20001) / 2, 2);
  EXPECT_NEAR(e.upper, 10001 + 1.96 * std::sqrt(20001) / 2, 2);
}

TEST(CensoredQuantile, HasTheTabulatedRanks) {
  // Conover, Practical Nonparametric Statistics: median of n = 10: 2 and 9; 20: 6 and 15; 50: 18
  // and 33. Binomial tables, n = 20, p = 0.25: P(X <= 1) = 0.0243, P(X >= 10) = 0.0139: 2 and 10.
  const auto up_to = [](int n) {
    std::vector<Observation> all;
    for (int i = 1; i <= n; ++i) all.push_back({static_cast<double>(i)});
    return all;
  };
  for (const auto& [n, p, low, high] : {std::tuple{10, 0.5, 2., 9.},
                                        {20, 0.5, 6., 15.},
                                        {50, 0.5, 18., 33.},
                                        {20, 0.25, 2., 10.}}) {
    const CensoredEstimate e = censored_quantile(up_to(n), p, 0.95);
    EXPECT_EQ(e.lower, low) << n << ' ' << p;
    EXPECT_EQ(e.upper, high) << n << ' ' << p;
  }
  EXPECT_TRUE(std::isnan(censored_quantile(up_to(5), 0.5, 0.95).lower));
  EXPECT_TRUE(std::isnan(censored_quantile(up_to(5), 0.5, 0.95).upper));
  EXPECT_EQ(censored_quantile(up_to(6), 0.5, 0.95).upper, 6);
}

TEST(CensoredQuantile, LetsUnknownValuesLieAnywhere) {
  std::vector<Observation> values;
  for (int i = 1; i <= 18; ++i) values.push_back({static_cast<double>(i)});
  values.push_back({-5, Known::not_at_all});
  values.push_back({nan_d, Known::not_at_all});
  const CensoredEstimate e = censored_quantile(values, 0.5, 0.95);
  EXPECT_TRUE(std::isnan(e.value)) << "the unknown ones may be the longest: 9.5 of the 18 misleads";
  EXPECT_EQ(e.least, 8.5);  // both unknown ones below
  EXPECT_EQ(e.most, 10.5);  // both above
  EXPECT_EQ(e.lower, 4);    // rank 6 of 20 with both unknown ones below
  EXPECT_EQ(e.upper, 15);   // rank 15 of 20 with both above
  EXPECT_EQ(e.n, 20U);
  EXPECT_EQ(e.n_not_at_all, 2U);
  for (auto& v : values)
    if (v.value > 8) v.known = Known::not_at_all;
  const CensoredEstimate none = censored_quantile(values, 0.5, 0.95);
  EXPECT_TRUE(std::isnan(none.value)) << "more than half could be anything";
  EXPECT_EQ(none.upper, infinite);
  EXPECT_EQ(none.lower, -infinite);
}

TEST(CensoredQuantile, TakesACensoredValueThatIsMissingForUnknown) {
  // Length of a deposit of which nothing is left on the terrain: not a reason to forget the member.
  const std::vector<Observation> values{{1}, {2}, {3}, {nan_d, Known::at_least}, {nan_d}};
  const CensoredEstimate e = censored_quantile(values, 0.5, 0.95);
  EXPECT_EQ(e.n, 4U);
  EXPECT_EQ(e.n_not_at_all, 1U);
  EXPECT_TRUE(std::isnan(e.value));
  EXPECT_EQ(e.least, 1.5);
  EXPECT_EQ(e.most, 2.5);
}

TEST(CensoredQuantile, DoesNotTrustTheLastMemberAtRest) {
  // 36 members lost at the edge, three at rest before it, one that went elsewhere, farther: the
  // survival falls to 0 there, on the word of a single member.
  std::vector<Observation> values{{1200}, {1400}, {1500}, {2600}};
  for (int i = 0; i < 36; ++i) values.push_back({2400 + 2.0 * i, Known::at_least});
  const CensoredEstimate e = censored_quantile(values, 0.5, 0.95);
  EXPECT_TRUE(e.at_least);
  EXPECT_NEAR(e.value, 2433, 1);
  EXPECT_EQ(e.upper, infinite);
}

// ---- Coverage. Runouts are log-normal with median 1000; what a cut leaves of them varies.

struct Draw {
  std::mt19937_64 random{20261129};
  double uniform() { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; }
  double runout() {
    const double r = std::sqrt(-2 * std::log(uniform())), a = 6.283185307179586 * uniform();
    return 1000 * std::exp(0.4 * r * std::cos(a));
  }
};
constexpr double truth = 1000;
using Cut = std::function<double(double runout, Draw&)>;  // where that member would be lost

const Cut at_one_edge = [](double, Draw&) { return 950.0; };
const Cut at_random = [](double, Draw& d) { return 1100 * std::exp(0.5 * (d.uniform() - 0.3)); };
/// A creeping tail: cut in its last tenth.
const Cut shortly_before_the_end = [](double x, Draw& d) {
  return d.uniform() < 0.4 ? x * (0.9 + 0.1 * d.uniform()) : infinite;
};
/// Those that would run far leave sideways early, most of them.
const Cut far_ones_early = [](double x, Draw& d) {
  return x > 1050 ? 600 + 50 * d.uniform() : infinite;
};

std::vector<Observation> draw(int n, const Cut& cut, Draw& d) {
  std::vector<Observation> all;
  for (int i = 0; i < n; ++i) {
    const double x = d.runout(), c = cut(x, d);
    all.push_back(x <= c ? Observation{x, Known::exactly} : Observation{c, Known::at_least});
  }
  return all;
}

template <class Interval>
double coverage(int n, const Cut& cut, Interval interval) {
  constexpr int n_ensembles = 4000;
  Draw d;
  int covered = 0;
  for (int k = 0; k < n_ensembles; ++k) {
    const auto [lower, upper] = interval(draw(n, cut, d));
    covered += lower <= truth && truth <= upper;
  }
  return covered / static_cast<double>(n_ensembles);
}

std::pair<double, double> ours(const std::vector<Observation>& values) {
  const CensoredEstimate e = censored_quantile(values, 0.5, 0.95);
  return {e.lower, e.upper};
}

std::pair<double, double> naive(std::vector<Observation> values) {
  for (Observation& o : values) o.known = Known::exactly;
  return ours(values);
}

/// Brookmeyer & Crowley (1982) with the log-log transform: where the band of the survival curve
/// (Greenwood's variance) meets one half.
std::pair<double, double> brookmeyer_crowley(std::vector<Observation> values) {
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
    return a.value != b.value ? a.value < b.value : a.known < b.known;
  });
  double survival = 1, greenwood = 0, lower = infinite, upper = infinite;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].known != Known::exactly) continue;
    const auto at_risk = static_cast<double>(values.size() - i);
    survival *= (at_risk - 1) / at_risk;
    greenwood += at_risk > 1 ? 1 / (at_risk * (at_risk - 1)) : infinite;
    const double theta = 1.959964 * std::sqrt(greenwood) / std::abs(std::log(survival));
    const bool ends = survival <= 0;
    if (lower == infinite && (ends || std::pow(survival, std::exp(theta)) <= 0.5))
      lower = values[i].value;
    if (upper == infinite && (ends || std::pow(survival, std::exp(-theta)) <= 0.5))
      upper = values[i].value;
  }
  return {lower, upper};
}

TEST(CensoredQuantile, CoversTheTruthHoweverTheCutDependsOnTheValue) {
  const double error = 3 * std::sqrt(0.05 * 0.95 / 4000);
  for (const int n : {20, 40, 120}) {
    EXPECT_GE(coverage(n, at_one_edge, ours), 0.95 - error) << n;
    EXPECT_GE(coverage(n, at_random, ours), 0.95 - error) << n;
    EXPECT_GE(coverage(n, shortly_before_the_end, ours), 0.95 - error) << n;
    EXPECT_GE(coverage(n, far_ones_early, ours), 0.95 - error) << n;
  }
}

TEST(CensoredQuantile, IsNoWiderThanNeededWhereNothingIsCut) {
  const Cut never = [](double, Draw&) { return infinite; };
  EXPECT_NEAR(coverage(40, never, ours), 0.9615, 0.01);  // binomial: ranks 14 and 27 of 40
}

TEST(CensoredQuantile, NaiveIntervalsMissTheTruth) {
  EXPECT_EQ(coverage(40, at_one_edge, naive), 0) << "the edge lies before the median";
  EXPECT_LT(coverage(40, far_ones_early, naive), 0.2);
}

TEST(CensoredQuantile, IntervalsOfTheCurveMissItWhereTheFarOnesAreLostFirst) {
  EXPECT_GE(coverage(120, at_random, brookmeyer_crowley), 0.93) << "sound where it is meant for";
  EXPECT_LT(coverage(120, far_ones_early, brookmeyer_crowley), 0.8);
}

void expect_same(const CensoredEstimate& a, const CensoredEstimate& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  EXPECT_TRUE(same(a.value, b.value)) << a.value << " and " << b.value;
  EXPECT_TRUE(same(a.least, b.least) && same(a.most, b.most));
  EXPECT_TRUE(same(a.lower, b.lower)) << a.lower << " and " << b.lower;
  EXPECT_TRUE(same(a.upper, b.upper)) << a.upper << " and " << b.upper;
  EXPECT_EQ(a.at_least, b.at_least);
  EXPECT_EQ(a.n_at_least, b.n_at_least);
}

TEST(WeightedCensoredQuantile, OfEqualWeightsIsThatOfNone) {
  for (const auto& of : {maintained, not_maintained, mercaptopurine, sample({3, 5, -5, -8, -8, -9}),
                         sample({1, 2, 3, 4})})
    for (const double fraction : {0.25, 0.5, 0.9}) {
      const std::vector<double> weights(of.size(), 1.0 / static_cast<double>(of.size()));
      expect_same(weighted_censored_quantile(of, weights, fraction, 0.95),
                  censored_quantile(of, fraction, 0.95));
    }
}

TEST(WeightedCensoredQuantile, AWeightOfTwoIsAValueThatCameTwice) {
  const auto once = sample({2, 3, -4, 6, 7});
  const std::vector<double> weights{1, 2, 1, 3, 1};
  const auto often = sample({2, 3, 3, -4, 6, 6, 6, 7});
  EXPECT_EQ(weighted_censored_quantile(once, weights, 0.5, 0.95).value,
            censored_quantile(often, 0.5, 0.95).value);
  // Worth 64 / 16 = 4 members: too few for an end at 95 %, and no more than that is claimed.
  EXPECT_TRUE(std::isnan(weighted_censored_quantile(once, weights, 0.5, 0.95).lower));
  EXPECT_EQ(weighted_censored_quantile(once, std::vector<double>{1, 0, 0, 0, 0}, 0.5, 0.9).value,
            2);
}

}  // namespace
}  // namespace sturz
