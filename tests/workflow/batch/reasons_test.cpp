// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/batch/reasons.hpp"

#include "ensemble/workflow/batch/batch_features.hpp"
#include "ensemble/workflow/batch/batch_figures.hpp"
#include "ensemble/workflow/batch/plan.hpp"
#include "ensemble/workflow/members/utilisation.hpp"
#include "io/members/member_file.hpp"
#include "io/members/packs/pack_writer.hpp"
#include "tests/support/made_up_flows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace sturz::workflow {
namespace fs = std::filesystem;
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Reasons, FilesAreNamedWithTheirKey) {
  const InputIdentity before{"terrain.raster", "dem.tif", "10 x 10", {{"0/0", "aa"}}};
  InputIdentity now = before;
  now.parts["0/0"] = "bb";
  EXPECT_THAT(changed_files(input_differences({before}, {now})),
              ElementsAre("dem.tif changed (terrain.raster)"));
  EXPECT_THAT(changed_files({"something else entirely"}), ElementsAre("something else entirely"));
}

TEST(Reasons, OnlyInputsOfMapsAreInputsOfMaps) {
  const InputIdentity dem{"terrain.raster", "dem.tif", "", {{"0/0", "aa"}}};
  const InputIdentity houses{"assets.file", "houses.gpkg", "", {{"features", "aa"}}};
  InputIdentity other_dem = dem, other_houses = houses;
  other_dem.parts["0/0"] = "bb";
  other_houses.parts["features"] = "bb";
  EXPECT_THAT(changed_map_inputs({dem, houses}, {other_dem, other_houses}),
              ElementsAre("houses.gpkg changed (assets.file)"));
}

TEST(Reasons, AnotherProgramIsNamedByVersionOrCommit) {
  const Build mine = this_build();
  EXPECT_EQ(other_program({mine}), "");
  EXPECT_EQ(other_program({{"0.0.1", "abc"}, mine}), "program 0.0.1 -> " + mine.version);
  EXPECT_THAT(other_program({{mine.version, "abc"}}), HasSubstr("(abc) -> "));
}

TEST(Reasons, ManyAreCounted) {
  EXPECT_EQ(joined({"a", "b"}), "a; b");
  EXPECT_EQ(joined({"a", "b", "c", "d", "e", "f"}), "a; b; c; d and 2 more");
}

class Folders : public ::testing::Test {
 protected:
  Folders() : root_(fs::temp_directory_path() / ("sturz_results_" + std::to_string(::getpid()))) {}
  ~Folders() override { fs::remove_all(root_); }
  void add(const std::string& name) const {
    fs::create_directories(root_ / name);
    std::ofstream(root_ / name / "manifest.json") << "{}";
  }
  fs::path root_;
};

TEST_F(Folders, OfAnotherJobAreNotOlderResults) {
  add("slope-0a1b2c3d");
  add("slope-0a1b2c3d-2");
  add("slope-20261130-12345678");  // of the job slope-20261130
  add("slope-20261130-1234567a");
  EXPECT_THAT(
      results_of(root_ / "slope"),
      ::testing::UnorderedElementsAre(root_ / "slope-0a1b2c3d", root_ / "slope-0a1b2c3d-2"));
  EXPECT_EQ(results_of(root_ / "slope-20261130").size(), 2U);
}

TEST_F(Folders, MembersInPacksAndFilesAreCountedOnce) {
  const fs::path members = root_ / "members";
  const MemberOrigin origin{"sha256:0", "0", "0"};
  write_member(members, test::made_up_flow(0, 40), origin);
  {
    PackWriter pack(members, {1, 1});
    for (const int m : {0, 3, 4}) pack.append(test::made_up_flow(m, 40), origin);
  }
  std::ofstream(members / "000009.nc.123.part") << "unfinished";
  EXPECT_EQ(count_members(root_), 3);
  EXPECT_EQ(count_members(root_ / "nothing"), 0);
}

TEST(Features, EachIsAJobWithItsOverride) {
  BatchEntry entry;
  EXPECT_EQ(feature_jobs(entry, {}).size(), 1u) << "without features: the scenario as it is";
  entry.features = {"3", "\"upper part\""};
  const auto jobs = feature_jobs(entry, {});
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs[0].suffix, ".3");
  EXPECT_EQ(jobs[1].suffix, ".upper%20part") << "the rule of a region's folders";
  ASSERT_EQ(jobs[1].extra.size(), 2u);
  EXPECT_EQ(jobs[1].extra[0].key, "release.each_feature");
  EXPECT_EQ(jobs[1].extra[0].value, "false");
  EXPECT_EQ(jobs[1].extra[1].key, "release.feature");
  EXPECT_EQ(jobs[1].extra[1].value, "\"upper part\"");
}

TEST(Figures, CellsAreReachedFromTheirLevelOn) {
  Grid grid;
  grid.n_cols = 5;
  grid.n_rows = 1;
  Raster<float> p(grid);
  p.values = {0.0F, 0.05F, 0.1F, 0.5F, nan_f};
  EXPECT_THAT(cells_reached(p, 0).values, ElementsAre(0, 1, 1, 1, 0));
  EXPECT_THAT(cells_reached(p, 0.1).values, ElementsAre(0, 0, 1, 1, 0));
  EXPECT_THAT(cells_reached(p, 0.5).values, ElementsAre(0, 0, 0, 1, 0));
}

/// 16 members of 10 s on 4 cores, one thread each.
Utilisation well_used() {
  Utilisation u;
  u.members = 16;
  u.workers = u.cores = 4;
  u.threads = 1;
  u.core_s = u.busy_s = 160;
  u.longest_s = 10;
  u.wall_s = 41;
  return u;
}

TEST(Utilisation, IsSaidAndNotBlamedWhereItIsGood) {
  EXPECT_NEAR(well_used().fraction(), 160.0 / 164, 1e-12);
  EXPECT_THAT(utilisation_text(well_used()), HasSubstr("98 % of 4 cores"));
  EXPECT_EQ(low_utilisation(well_used()), "");
  EXPECT_EQ(utilisation_text({}), "");
}

TEST(Utilisation, TheLikelyCauseIsNamed) {
  Utilisation long_one = well_used();
  long_one.longest_s = 100;
  long_one.wall_s = 110;
  EXPECT_THAT(low_utilisation(long_one), HasSubstr("one member took"));
  Utilisation disk = well_used();
  disk.wall_s = 100;
  disk.storing_s = 60;
  EXPECT_THAT(low_utilisation(disk), HasSubstr("the disk is slow"));
  Utilisation busy = well_used();
  busy.wall_s = 100;
  busy.busy_s = 400;
  EXPECT_THAT(low_utilisation(busy), HasSubstr("other work on this machine"));
  Utilisation few = well_used();
  few.members = 5;
  few.core_s = few.busy_s = 50;
  few.wall_s = 26;
  few.longest_s = 12;
  EXPECT_THAT(low_utilisation(few), HasSubstr("5 members for 4 cores are few"));
  Utilisation one = well_used();
  one.workers = 1;
  one.wall_s = 160;
  EXPECT_THAT(low_utilisation(one), HasSubstr("1 member at a time"));
  few.wall_s = 9;
  few.core_s = few.busy_s = 10;
  EXPECT_EQ(low_utilisation(few), "") << "ten seconds tell nothing";
}

}  // namespace
}  // namespace sturz::workflow
