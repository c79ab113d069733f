// SPDX-License-Identifier: Apache-2.0
// Full-stress members from the priors' corners and random points: each one ends with a name, keeps
// its ledger, and does nothing that gravity cannot do. STURZ_HARD_MEMBERS=1856 runs all.
#include "tests/hard/random_members.hpp"

#include "tests/hard/expect_holds.hpp"
#include "tests/hard/priors.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace sturz::test {
namespace {

void expect_survival(const RandomMembers& members, const std::vector<int>& numbers) {
  for (const int number : numbers) {
    const std::string name =
        fmt::format("{}, {}, member {}", members.ground(), to_string(members.states()), number);
    const Survival s = members.run(number);
    fmt::print(
        "{}: {}, {:.0f} particles, {:.0f} steps, {:.2f} s, residual {:.1e}, created {:.3f}, "
        "numerical {:.3f}, lowest {:.2f} dx, speed {:.2f}, step {:.2f}\n",
        name, to_string(s.outcome), s.particles, s.steps, s.seconds, s.energy_residual,
        s.created_energy, s.numerical_share, s.lowest_dx, s.speed_ratio, s.mean_dt_ratio);
    expect_holds(name, checks_of(s));
  }
}

/// Members a set where STURZ_HARD_MEMBERS asks for no others.
int a_set() { return hard_members(28) / 4; }

TEST(RandomMembers, CornersOfAllSetsCombineEveryThreeNumbers) {
  std::set<int> corners;
  for (int set = 0; set < 4; ++set)
    for (const int row : drawn(7, set))
      if (row < n_corners) corners.insert(row);
  ASSERT_EQ(corners.size(), 16);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j)
      for (int k = 0; k < j; ++k) {
        std::set<int> met;
        for (const int row : corners)
          met.insert((row >> i & 1) + 2 * (row >> j & 1) + 4 * (row >> k & 1));
        EXPECT_EQ(met.size(), 8) << i << j << k;
      }
}

TEST(RandomMembers, SurviveSteepGround) {
  expect_survival(RandomMembers::on_steep_ground(States::dense_only), drawn(a_set(), 0));
  expect_survival(RandomMembers::on_steep_ground(States::all), drawn(a_set(), 1));
}

/// The one of the corners with dense grains alone that threw a grain at 1.27 times free fall.
TEST(RandomMembers, NoGrainIsThrownOffTheFootOfASlope) {
  expect_survival(RandomMembers::on_steep_ground(States::dense_only), {60});
}

/// 58 diverged and 419 threw a grain at nine times the speed of free fall where isolated particles
/// came back; in 206 a handful of grains bounced off the foot of the slope and threw one at 1.2
/// times.
TEST(RandomMembers, IsolatedParticlesThatRejoinAndGrainsThatHitTheGroundAreNotThrown) {
  expect_survival(RandomMembers::on_steep_ground(States::all), {58, 206, 419});
}

TEST(RandomMembers, SurviveMonteMarsicano) {
  const std::string folder = STURZ_SHARED_DIR "/data/marsicano_tinitaly";
  if (!std::filesystem::exists(folder + "/marsicano_10m.tif"))
    GTEST_SKIP() << "shared data marsicano_tinitaly is not there";
  expect_survival(RandomMembers::on_marsicano(folder, States::dense_only), drawn(a_set(), 2));
  expect_survival(RandomMembers::on_marsicano(folder, States::all), drawn(a_set(), 3));
}

}  // namespace
}  // namespace sturz::test
