// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/cluster/recent_members.hpp"

#include "io/members/member_file.hpp"
#include "io/members/packs/pack_writer.hpp"
#include "tests/support/made_up_flows.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <random>

namespace sturz::workflow {
namespace {
namespace fs = std::filesystem;
using Indices = std::vector<std::size_t>;

TEST(RecentMembers, AreTheYoungestFilesWhateverTheirNumbers) {
  EXPECT_EQ(written_last({{0, 50, 0}, {1, 90, 0}, {2, 70, 0}, {3, 80, 0}}, 2), (Indices{1, 3}));
}

TEST(RecentMembers, ComeFromPacksThatGrowSideBySide) {
  // Two packs: the last two of each, not the last four of the one that was written to last.
  const std::vector<WrittenMember> members{{0, 100, 3}, {1, 100, 2}, {2, 100, 1}, {3, 100, 0},
                                           {4, 99, 2},  {5, 99, 1},  {6, 99, 0}};
  EXPECT_EQ(written_last(members, 4), (Indices{3, 6, 2, 5}));
}

TEST(RecentMembers, AreNotThoseOfAShardThatEndedLongAgo) {
  const std::vector<WrittenMember> members{{0, 5000, 1}, {1, 5000, 0}, {2, 100, 0}};
  EXPECT_EQ(written_last(members, 2), (Indices{1, 0}));
  EXPECT_EQ(written_last(members, 3), (Indices{1, 0, 2})) << "better than none";
  EXPECT_EQ(written_last(members, 2, 1e4), (Indices{1, 2}));
}

TEST(RecentMembers, OfAFolderWithFilesAndAPack) {
  const fs::path folder =
      fs::temp_directory_path() / ("sturz_recent_" + std::to_string(std::random_device{}()));
  for (const int m : {0, 1})
    write_member(folder, test::made_up_flow(m, 40), {"sha256:0", "0", "0"});
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(folder / member_file_name(0), now - std::chrono::seconds(3));
  fs::last_write_time(folder / member_file_name(1), now - std::chrono::seconds(9));
  {
    PackWriter pack(folder, {1, 1});
    for (const int m : {5, 2, 3}) pack.append(test::made_up_flow(m, 40), {"sha256:0", "0", "0"});
  }
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".pack") fs::last_write_time(entry.path(), now);
  const MemberStore store(folder);  // of members 0, 1, 2, 3, 5
  EXPECT_EQ(written_last(store, 1), (Indices{3})) << "member 3, the pack's last";
  EXPECT_EQ(written_last(store, 3), (Indices{3, 0, 1}));
  EXPECT_EQ(written_last(store, 99).size(), 5U);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sturz::workflow
