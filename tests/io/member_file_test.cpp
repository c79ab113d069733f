// SPDX-License-Identifier: Apache-2.0
#include "io/members/member_file.hpp"

#include "io/files/atomic_file.hpp"
#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_store.hpp"
#include "tests/io/io_fixture.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <random>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

void expect_same(const MemberHistory& a, const MemberHistory& b) {
  EXPECT_EQ(a.has_states, b.has_states);
  EXPECT_EQ(a.has_temperature, b.has_temperature);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (const HistoryColumn& column : history_table())
      EXPECT_EQ(std::bit_cast<std::uint32_t>(a.rows[i].*column.field),
                std::bit_cast<std::uint32_t>(b.rows[i].*column.field))
          << column.name << " " << i;
}

void expect_same(const MemberResult& a, const MemberResult& b) {
  EXPECT_EQ(a.member, b.member);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.censoring, b.censoring);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.formulation, b.formulation);
  EXPECT_EQ(a.binding_limit, b.binding_limit);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_TRUE(a.grid.same_place(b.grid));
  EXPECT_EQ(a.grid.crs_wkt, b.grid.crs_wkt);
  expect_same(a.history, b.history);
  EXPECT_EQ(a.pass_seconds, b.pass_seconds);
  EXPECT_EQ(a.effect_seconds, b.effect_seconds);
  EXPECT_EQ(a.window.row0, b.window.row0);
  EXPECT_EQ(a.window.col0, b.window.col0);
  EXPECT_EQ(a.window.n_rows, b.window.n_rows);
  EXPECT_EQ(a.window.n_cols, b.window.n_cols);
  for (const ScalarInfo& scalar : scalar_table())
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.scalars.*scalar.field),
              std::bit_cast<std::uint64_t>(b.scalars.*scalar.field))
        << scalar.name;
  for (int i = 0; i < n_peak_layers; ++i)
    EXPECT_TRUE(
        same_bits(a.layers[static_cast<std::size_t>(i)], b.layers[static_cast<std::size_t>(i)]))
        << i;
}

class MemberFile : public IoTest {
 protected:
  std::filesystem::path members() const { return folder() / "members"; }
};

TEST_F(MemberFile, RoundTripsBitForBit) {
  MemberResult m = made_up_member(17);
  m.reason = "ended with µ and \"quotes\"";
  m.scalars.energy_residual = nan_d;
  write_member(members(), m);
  expect_same(read_member(members() / "000017.nc"), m);
}

TEST_F(MemberFile, AHistoryOfFullLengthIsSmallAndOptional) {
  MemberResult m = made_up_member(1);
  m.history = {};
  write_member(members(), m);
  expect_same(read_member(members() / "000001.nc"), m);
  const auto without = std::filesystem::file_size(members() / "000001.nc");
  m.history = made_up_history(HistoryRecorder::most_rows, true);
  write_member(members(), m);
  expect_same(read_member(members() / "000001.nc"), m);
  EXPECT_LE(std::filesystem::file_size(members() / "000001.nc") - without, 65536U)
      << "netCDF builds files in blocks of 64 kB: one more at most";
}

/// Members without grains and liquid apart have the bytes that they had before there were such.
TEST_F(MemberFile, NamesGrainsAndLiquidOnlyWhereTheyAreApart) {
  MemberResult m = made_up_member(2);
  write_member(members(), m);
  EXPECT_EQ(NetcdfReader(members() / "000002.nc").integer("", "member_format"), 6);
  MemberScalars& s = m.scalars;
  for (const ScalarInfo& scalar : scalar_table())
    if (scalar.sparse) s.*scalar.field = nan_d;
  s.solid_runout_m = nan_d;
  for (int k = 0; k < n_peak_layers; ++k)
    if (const auto layer = static_cast<PeakLayer>(k); is_of_materials(layer))
      m.layer(layer).clear();
  write_member(members(), m);
  const NetcdfReader file(members() / "000002.nc");
  EXPECT_EQ(file.integer("", "member_format"), 5);
  for (const std::string& name : file.variables())
    for (const char* of : {"lost_fraction", "reached_area", "pressure", "speed", "arrival"})
      EXPECT_FALSE(name.find("liquid") != std::string::npos && name.find(of) != std::string::npos)
          << name;
  expect_same(read_member(members() / "000002.nc"), m);
}

TEST_F(MemberFile, AFailedMemberIsKeptWithItsReason) {
  MemberResult m;
  m.member = 3;
  m.outcome = Outcome::failed;
  m.reason = "release.volume_m3 = nan";
  write_member(members(), m);
  expect_same(read_member(members() / "000003.nc"), m);
}

TEST_F(MemberFile, PassesTheCfLint) {
  if (shell("/usr/bin/python3 -c 'import netCDF4'").exit_code != 0)
    GTEST_SKIP() << "python3 with netCDF4 is not installed";
  write_member(members(), made_up_member(1));
  write_member(members(), made_up_member(2));  // with states
  const ShellResult lint =
      shell("/usr/bin/python3 " STURZ_SOURCE_DIR "/tests/support/cf_lint.py " +
            (members() / "000001.nc").string() + " " + (members() / "000002.nc").string());
  EXPECT_EQ(lint.exit_code, 0) << lint.output;
}

TEST_F(MemberFile, AFullDiskNeverHarmsAFinishedMember) {
  write_member(members(), made_up_member(1));
  std::string message;
  {
    const SmallDisk disk(4096);
    message = message_of([&] { write_member(members(), made_up_member(1)); });
    EXPECT_THROW(write_member(members(), made_up_member(2)), IoError);
  }
  EXPECT_THAT(message, HasSubstr("cannot write " + (members() / "000001.nc").string()));
  EXPECT_THAT(names(), ElementsAre("members/000001.nc"));
  expect_same(read_member(members() / "000001.nc"), made_up_member(1));
}

TEST_F(MemberFile, AProcessKilledInTheWriteLeavesOnlyAPartFile) {
  write_member(members(), made_up_member(1));
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(members() / "000002.nc");
    const std::vector<std::byte> half(5000);
    file.write(half);
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto files = names();
  ASSERT_THAT(files, SizeIs(2));
  EXPECT_EQ(files[0], "members/000001.nc");
  EXPECT_THAT(files[1], ::testing::MatchesRegex("members/000002\\.nc\\.[0-9a-f]{16}\\.part"));
  const MemberStore store(members());
  EXPECT_THAT(store.members(), SizeIs(1));
  EXPECT_THAT(store.problems(), IsEmpty());
}

class Store : public MemberFile {
 protected:
  /// Every row of every layer of every member against the results themselves.
  static void expect_rows(const MemberStore& store, const std::vector<MemberResult>& all) {
    const Grid& g = store.grid();
    for (std::size_t k = 0; k < all.size(); ++k)
      for (int i = 0; i < n_peak_layers; ++i)
        for (int row0 = 0; row0 < g.n_rows; row0 += 3) {
          const auto layer = static_cast<PeakLayer>(i);
          const int n = std::min(3, g.n_rows - row0);
          std::vector<float> rows(static_cast<std::size_t>(n) * g.n_cols, 77.0F);
          store.read_rows(k, layer, row0, n, rows);
          std::vector<float> expected;
          const Window& w = all[k].window;
          for (int row = row0; row < row0 + n; ++row)
            for (int col = 0; col < g.n_cols; ++col) {
              const bool inside = row >= w.row0 && row < w.row0 + w.n_rows && col >= w.col0 &&
                                  col < w.col0 + w.n_cols;
              expected.push_back(
                  inside && !all[k].layer(layer).empty()
                      ? all[k].layer(layer)[static_cast<std::size_t>(row - w.row0) * w.n_cols +
                                            (col - w.col0)]
                      : info(layer).untouched);
            }
          EXPECT_TRUE(same_bits(rows, expected)) << k << " " << i << " " << row0;
        }
  }
};

TEST_F(Store, ListsFinishedMembersInOrderAndReadsTheirRows) {
  std::vector<MemberResult> all;
  for (const int number : {2, 11, 1000000}) all.push_back(made_up_member(number));
  all[1].window = {0, 0, 10, 12};  // touched everything
  for (auto& layer : all[1].layers) layer.assign(120, 3.5F);
  for (const int i : {2, 0, 1}) write_member(members(), all[static_cast<std::size_t>(i)]);
  write("members/000005.nc.0123456789abcdef.part", "half");
  write("members/notes.txt", "mine");
  const MemberStore store(members());
  ASSERT_THAT(store.members(), SizeIs(3));
  EXPECT_EQ(store.members()[0].member, 2);
  EXPECT_EQ(store.members()[2].member, 1000000);
  EXPECT_EQ(store.members()[1].state_hash, all[1].state_hash);
  EXPECT_THAT(store.problems(), IsEmpty());
  expect_rows(store, all);
}

TEST_F(Store, ReadsAnyPartOfAMembersWindow) {
  const MemberResult m = made_up_member(3);
  write_member(members(), m);
  const MemberStore store(members());
  const Window& w = m.window;
  const Window part{w.row0 + 1, w.col0 + 1, w.n_rows - 1, w.n_cols - 2};
  std::vector<float> values(part.n_cells());
  store.read_part(0, PeakLayer::speed, part, values);
  for (int row = 0; row < part.n_rows; ++row)
    for (int col = 0; col < part.n_cols; ++col)
      EXPECT_EQ(values[static_cast<std::size_t>(row) * part.n_cols + col],
                m.layer(PeakLayer::speed)[static_cast<std::size_t>(row + 1) * w.n_cols + col + 1]);
}

TEST_F(Store, StopsOpeningFilesWhenTold) {
  write_member(members(), made_up_member(0));
  const std::atomic<bool> stop{true};
  EXPECT_THROW(MemberStore(members(), {}, stop), Cancelled);
}

TEST_F(Store, ReadsFromSeveralThreads) {
  std::vector<MemberResult> all;
  for (int number = 0; number < 4; ++number) all.push_back(made_up_member(number));
  for (const auto& m : all) write_member(members(), m);
  const MemberStore store(members());
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) threads.emplace_back([&] { expect_rows(store, all); });
  for (auto& thread : threads) thread.join();
}

TEST_F(Store, DamagedFilesAreNamedAndCountAsAbsent) {
  for (int number = 0; number < 4; ++number) write_member(members(), made_up_member(number));
  std::filesystem::resize_file(members() / "000001.nc", 3000);
  write("members/000002.nc", "");
  std::filesystem::copy_file(members() / "000003.nc", members() / "000007.nc");  // misnamed
  const MemberStore store(members());
  ASSERT_THAT(store.members(), SizeIs(2));
  EXPECT_EQ(store.members()[1].member, 3);
  ASSERT_THAT(store.problems(), SizeIs(3));
  EXPECT_THAT(store.problems()[0], HasSubstr("000001.nc: does not end with its checksum"));
  EXPECT_THAT(store.problems()[1], HasSubstr("000002.nc"));
  EXPECT_THAT(store.problems()[2], HasSubstr("000007.nc: holds member 3."));
}

TEST_F(Store, AFlippedBitInAMapIsFound) {
  MemberResult m = made_up_member(0);
  m.grid.n_rows = m.grid.n_cols = 300;
  m.window = {0, 0, 300, 300};
  std::mt19937 random(1);  // does not compress: nearly all of the file is maps
  for (auto& layer : m.layers) {
    layer.resize(90000);
    for (float& v : layer) v = static_cast<float>(random());
  }
  write_member(members(), m);
  const std::string file = (members() / "000000.nc").string();
  std::string damaged = read_text(file);
  char& flipped = damaged[damaged.size() / 3];  // inside a map, between HDF5's own tables
  flipped = static_cast<char>(flipped ^ 4);
  write_text_atomic(file, damaged);
  const MemberStore store(members());
  EXPECT_THAT(store.members(), IsEmpty());
  ASSERT_THAT(store.problems(), SizeIs(1));
  EXPECT_THAT(store.problems()[0], HasSubstr("000000.nc: its content does not fit its checksum"));
}

TEST_F(Store, AMemberOnAnotherGridIsRefused) {
  write_member(members(), made_up_member(0));
  MemberResult other = made_up_member(1);
  other.grid.cell_m = 5;
  write_member(members(), other);
  const MemberStore store(members());
  EXPECT_THAT(store.members(), SizeIs(1));
  EXPECT_THAT(store.problems()[0], HasSubstr("000001.nc: lies on another grid"));
}

TEST_F(Store, FailedMembersHaveNoMapsButCount) {
  MemberResult failed;
  failed.member = 0;
  failed.reason = "boom";
  write_member(members(), failed);
  const MemberStore alone(members());
  EXPECT_THAT(alone.members(), SizeIs(1));
  EXPECT_THAT(message_of([&] { alone.grid(); }), HasSubstr("holds no finished member with maps"));
  write_member(members(), made_up_member(1));
  const MemberStore store(members());
  std::vector<float> row(12);
  store.read_rows(0, PeakLayer::thickness, 4, 1, row);
  EXPECT_THAT(row, ::testing::Each(0.0F));
  EXPECT_EQ(store.members()[0].reason, "boom");
}

TEST_F(Store, AFolderThatIsNotThereHoldsNoMembers) {
  EXPECT_THAT(MemberStore(folder() / "nowhere").members(), IsEmpty());
}

}  // namespace
}  // namespace sturz::test
