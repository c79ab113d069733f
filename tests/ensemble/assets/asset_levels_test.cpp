// SPDX-License-Identifier: Apache-2.0
// Assets over several levels, on a family of levels with known probabilities.
#include "ensemble/assets/asset_levels.hpp"

#include "tests/ensemble/fidelity/multilevel/normal_draws.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

constexpr double edge = 0.5244;  // of a standard normal number: 30 % lie above it

struct Family {
  std::vector<AssetHits> levels;
  std::vector<LevelDraw> draws;
};

/// A member's thickness at the asset is x - edge where that is above 0, else it does not come. x is
/// N(0, 1) at level 0; level 1 has another noise and is thinner, so that it comes less often.
Family family(std::size_t n_dear, std::size_t n_cheap, std::uint64_t stream) {
  Family f;
  f.levels.resize(2);
  for (AssetHits& level : f.levels) level.of.resize(1);
  const double noise = 0.3;
  for (std::size_t k = 0; k < n_cheap; ++k) {
    const auto number = static_cast<std::int64_t>(k);
    const double z = normal(stream, k);
    for (std::size_t l = k < n_dear ? 0 : 1; l < 2; ++l) {
      AssetHits& level = f.levels[l];
      const double x = (z + noise * normal(stream + 1 + l, k)) / std::sqrt(1 + noise * noise);
      const double depth = x - edge - (l == 0 ? 0 : 0.3);
      if (depth > 0) {
        AssetHit hit;
        hit.member = level.members.size();
        hit.thickness_m = static_cast<float>(depth);
        hit.pressure_pa = 1e4F * hit.thickness_m;
        level.of[0].push_back(hit);
      }
      level.members.push_back(number);
      level.censoring.push_back(Censoring::none);
    }
    f.draws.push_back({number, k < n_dear ? std::size_t{0} : std::size_t{1}, {}});
  }
  return f;
}

Assets one_asset() {
  Assets assets;
  assets.curves = {{"road", PeakLayer::thickness, {{0, 0}, {2, 1}}}};
  assets.has_classes = assets.has_values = true;
  assets.value_unit = "CHF";
  Asset a;
  a.name = "bridge";
  a.vulnerability_class = "road";
  a.curve = 0;
  a.value = 100;
  a.wkb = "geometry";
  a.cells = {0};
  a.on_known_ground = true;
  assets.list = {a};
  return assets;
}

/// Of a hit by 30 %: deeper than 0.317 m in 20 %, than 0.757 m in 10 %, above 3.17 kPa in 20 %.
std::vector<AssetExceedance> wanted() {
  return {{PeakLayer::thickness, 0.3172, {}},
          {PeakLayer::thickness, 0.7572, {}},
          {PeakLayer::pressure, 3.172, {}}};
}

LevelledRisk assessed(const Family& f) {
  return assess_levels(one_asset(), f.levels, f.draws, wanted());
}

/// 24 dear draws, 400 cheap ones. Of 400 repeats a share of 0.9 scatters by 0.015 (one standard
/// deviation of a binomial).
TEST(AssetsOverLevels, HoldTheirProbabilitiesAndDoNotLean) {
  constexpr int repeats = 400;
  constexpr double truth[] = {0.3, 0.2, 0.1, 0.2};
  double mean[4] = {}, squares[4] = {}, covered[4] = {};
  for (int r = 0; r < repeats; ++r) {
    const LevelledRisk risk =
        assessed(family(24, 400, 700000 + 10 * static_cast<std::uint64_t>(r)));
    const AssetRisk& hit = risk.table.rows.front();
    std::vector<ShareEstimate> shares{
        {hit.probability, {hit.bounds_90.lower, hit.bounds_90.upper}}};
    for (const AssetExceedance& e : risk.exceedances) shares.push_back(e.of.front());
    for (int i = 0; i < 4; ++i) {
      const ShareEstimate& s = shares[static_cast<std::size_t>(i)];
      EXPECT_LE(s.bounds_90.low, s.share);
      EXPECT_GE(s.bounds_90.high, s.share);
      EXPECT_LE(s.share, hit.probability);
      const double error = s.share - truth[i];
      mean[i] += error / repeats;
      squares[i] += error * error / repeats;
      covered[i] += s.bounds_90.low <= truth[i] && truth[i] <= s.bounds_90.high ? 1.0 / repeats : 0;
    }
    EXPECT_LE(shares[2].share, shares[1].share);
    EXPECT_LE(shares[2].bounds_90.high, shares[1].bounds_90.high);
  }
  for (int i = 0; i < 4; ++i) {
    const double error = std::sqrt(squares[i]), plain = std::sqrt(truth[i] * (1 - truth[i]) / 24);
    EXPECT_GE(covered[i], 0.85) << i;
    // Held within 0 and 1 and made monotone, the rarest leans by a little.
    EXPECT_LT(std::abs(mean[i]), 4 * error / std::sqrt(repeats) + 0.005) << i;
    EXPECT_LT(error, plain) << i;
  }
}

/// With Student's 90 % of 23 degrees. The standard error itself scatters much where most members
/// have no damage: of 200 repeats the median is three quarters of the true error, one is twelve
/// times it.
TEST(AssetsOverLevels, KnowTheirDamage) {
  constexpr int repeats = 200;
  // E min(max(x - edge, 0) / 2, 1) of a standard normal x: by both ends of the curve.
  const auto above = [](double c) {
    return std::exp(-c * c / 2) / std::sqrt(2 * std::numbers::pi) - c * (1 - normal_share(c));
  };
  const double truth = (above(edge) - above(edge + 2)) / 2;
  double mean = 0, squares = 0, covered = 0;
  for (int r = 0; r < repeats; ++r) {
    const LevelledRisk risk =
        assessed(family(24, 400, 800000 + 10 * static_cast<std::uint64_t>(r)));
    const AssetRisk& row = risk.table.rows.front();
    EXPECT_NEAR(row.loss.mean, 100 * row.damage.mean, 1e-9);
    EXPECT_NEAR(risk.table.total_loss.mean, row.loss.mean, 1e-6);
    mean += row.damage.mean / repeats;
    squares += (row.damage.mean - truth) * (row.damage.mean - truth) / repeats;
    covered +=
        std::abs(row.damage.mean - truth) < 1.714 * row.damage.standard_error ? 1.0 / repeats : 0;
  }
  EXPECT_NEAR(mean, truth, 4 * std::sqrt(squares / repeats));
  EXPECT_GE(covered, 0.85);
}

/// None of 24 comes: up to 1 - 0.05^(1/24) may still do so.
TEST(AssetsOverLevels, LeaveWhatTheNumberOfDearMembersLeaves) {
  Family f = family(24, 400, 900000);
  for (AssetHits& level : f.levels) level.of[0].clear();
  const AssetRisk r = assessed(f).table.rows.front();
  EXPECT_EQ(r.probability, 0);
  EXPECT_EQ(r.bounds_90.lower, 0);
  EXPECT_GE(r.bounds_90.upper, 1 - std::pow(0.05, 1.0 / 24) - 1e-12);
}

TEST(AssetsOverLevels, CountCutOffMembersInTheUpperEnd) {
  Family f = family(24, 400, 910000);
  const LevelledRisk before = assessed(f);
  std::size_t place = 0;  // of a member that did not come
  while (std::any_of(f.levels[0].of[0].begin(), f.levels[0].of[0].end(),
                     [&](const AssetHit& h) { return h.member == place; }))
    ++place;
  f.levels[0].censoring[place] = Censoring::still_moving;
  const LevelledRisk after = assessed(f);
  const AssetRisk &a = before.table.rows.front(), &b = after.table.rows.front();
  EXPECT_EQ(b.not_known, 1);
  EXPECT_EQ(a.probability, b.probability);
  EXPECT_EQ(a.bounds_90.lower, b.bounds_90.lower);
  EXPECT_GT(b.bounds_90.upper, a.bounds_90.upper);
  EXPECT_GT(after.exceedances[0].of[0].bounds_90.high, before.exceedances[0].of[0].bounds_90.high);
  EXPECT_THAT(b.cut_off, HasSubstr("cut off before they hit: probabilities, damage, loss at"));
}

TEST(AssetsOverLevels, OfOneLevelAreThoseOfPlainEnsembles) {
  Family f = family(24, 400, 920000);
  f.levels.resize(1);
  f.draws.resize(24);
  const LevelledRisk risk = assessed(f);
  const RiskTable plain = assess_assets(one_asset(), f.levels.front());
  EXPECT_EQ(risk.table.rows.front().probability, plain.rows.front().probability);
  EXPECT_EQ(risk.table.rows.front().bounds_95.upper, plain.rows.front().bounds_95.upper);
  EXPECT_EQ(risk.table.rows.front().damage.mean, plain.rows.front().damage.mean);
}

TEST(AssetsOverLevels, WriteColumnsOfWhatIsKnown) {
  const Family f = family(24, 400, 930000);
  const std::string csv = to_csv(levelled_features(one_asset(), assessed(f), ""));
  EXPECT_THAT(csv, HasSubstr("probability,probability_lower_90,probability_upper_90,"
                             "expected_damage,expected_damage_standard_error,expected_loss_CHF"));
  EXPECT_THAT(csv, HasSubstr("thickness_gt_0_7572_m,thickness_gt_0_7572_m_lower_90"));
  EXPECT_THAT(csv, HasSubstr("pressure_gt_3_172_kpa,"));
  EXPECT_THAT(csv, HasSubstr(",multilevel\n"));
  EXPECT_THAT(csv, ::testing::Not(HasSubstr("_q50_")));
}

}  // namespace
}  // namespace sturz::test
