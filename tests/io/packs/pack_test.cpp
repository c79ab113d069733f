// SPDX-License-Identifier: Apache-2.0
// Members in packs: the same bits as in files of their own, whatever the layout.
#include "io/files/io_error.hpp"
#include "io/members/member_writer.hpp"
#include "io/members/packs/crc32c.hpp"
#include "tests/io/packs/pack_fixture.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <span>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Crc32c, IsTheOneOfRfc3720) {
  const std::string digits = "123456789";  // the check value of the catalogue of CRCs
  EXPECT_EQ(crc32c(std::as_bytes(std::span(digits))), 0xe3069283u);
  const std::vector<std::byte> zeros(32, std::byte{0});  // RFC 3720, B.4
  EXPECT_EQ(crc32c(zeros), 0x8a9136aau);
  EXPECT_EQ(crc32c(std::span(zeros).subspan(5), crc32c(std::span(zeros).first(5))), 0x8a9136aau);
}

TEST(PackName, ComesBackAndOthersDoNot) {
  for (const PackName& name : {PackName{1, 1, 1}, PackName{3, 1000, 17}, PackName{2, 2, 1234}})
    EXPECT_EQ(pack_named(pack_file_name(name)), name);
  for (const char* name :
       {"", "1_of_1.pack", "1_of_1.1.pack", "01_of_1.001.pack", "2_of_1.001.pack",
        "0_of_1.001.pack", "1_of_1.001.pack.part", "1_of_1.-01.pack", "000001.nc",
        "1_of_1.000.pack", "99999999999_of_1.001.pack"})
    EXPECT_FALSE(pack_named(name)) << name;
}

TEST_F(Packs, GiveBackWhatAFileOfItsOwnHoldsByteForByte) {
  std::vector<MemberResult> all;
  for (int k = 0; k < 5; ++k) all.push_back(made_up_member(k));
  all[1].window = {};  // without maps
  for (auto& layer : all[1].layers) layer.clear();
  all[2].outcome = Outcome::failed;
  all[2].reason = "made, up";
  all[3].layer(PeakLayer::speed)[2] = -0.0F;  // untouched by value, not by bits
  all[3].layer(PeakLayer::arrival)[4] = -std::numeric_limits<float>::quiet_NaN();
  all[4].scalars.com_ratio = nan_d;
  PackWriter writer(members(), {});
  for (const auto& m : all) {
    write_member(folder() / "files", m, origin());
    writer.append(m, origin());
  }
  const MemberStore store(members());
  ASSERT_THAT(store.problems(), IsEmpty());
  ASSERT_THAT(numbers_of(store), ElementsAre(0, 1, 2, 3, 4));
  for (std::size_t i = 0; i < all.size(); ++i) {
    MemberOrigin from;
    write_member(folder() / "extracted", store.result(i, from), origin());
    EXPECT_EQ(from, origin());
    const std::string name = member_file_name(static_cast<std::int64_t>(i));
    EXPECT_EQ(read_text(folder() / "extracted" / name), read_text(folder() / "files" / name)) << i;
  }
}

TEST_F(Packs, ReadAnyPartWithTheBitsOfFiles) {
  for (int k = 0; k < 4; ++k) write_member(folder() / "files", made_up_member(k));
  append({0, 1, 2, 3});
  const MemberStore files(folder() / "files"), packs(members());
  ASSERT_EQ(files.members().size(), packs.members().size());
  const std::vector<PeakLayer> layers{PeakLayer::arrival, PeakLayer::left, PeakLayer::thickness};
  TouchedCells a, b;
  for (std::size_t i = 0; i < 4; ++i) {
    const Window& w = files.members()[i].window;
    EXPECT_EQ(w, packs.members()[i].window);
    for (int row = 0; row < w.n_rows; ++row)
      for (int n_cols = 1; n_cols <= w.n_cols; ++n_cols) {
        const Window part{w.row0 + row, w.end_col() - n_cols, w.n_rows - row, n_cols};
        for (int l = 0; l < n_peak_layers; ++l) {
          std::vector<float> x(part.n_cells()), y(part.n_cells());
          files.read_part(i, static_cast<PeakLayer>(l), part, x);
          packs.read_part(i, static_cast<PeakLayer>(l), part, y);
          EXPECT_TRUE(same_bits(x, y)) << i << " " << l;
        }
        files.read_touched(i, part, layers, a);
        packs.read_touched(i, part, layers, b);
        EXPECT_EQ(a.n_cells, b.n_cells);
        ASSERT_EQ(a.runs.size(), b.runs.size());
        for (std::size_t r = 0; r < a.runs.size(); ++r) {
          EXPECT_EQ(a.runs[r].row, b.runs[r].row);
          EXPECT_EQ(a.runs[r].col, b.runs[r].col);
          EXPECT_EQ(a.runs[r].n, b.runs[r].n);
        }
        for (std::size_t l = 0; l < layers.size(); ++l)
          EXPECT_TRUE(same_bits(a.values[l], b.values[l]));
      }
  }
}

TEST_F(Packs, OfAnySparseMapComeBackBitForBit) {
  std::mt19937 random(5);
  MemberResult m = made_up_member(7);
  m.grid.n_rows = m.grid.n_cols = 90;
  m.window = {3, 4, 70, 61};  // several bands, the last of them not full
  for (int l = 0; l < n_peak_layers; ++l) {
    const auto layer = static_cast<PeakLayer>(l);
    if (!is_kept(layer, m.censoring, m.scalars)) continue;
    m.layer(layer).assign(m.window.n_cells(), info(layer).untouched);
    for (float& v : m.layer(layer))
      if (random() % 5 == 0) v = static_cast<float>(random() % 1000) / 7;
  }
  PackWriter(members(), {}).append(m, origin());
  const MemberStore store(members());
  ASSERT_THAT(store.members(), SizeIs(1));
  const auto maps = maps_of_member(store, 0);
  for (int l = 0; l < n_peak_layers; ++l)
    if (is_kept(static_cast<PeakLayer>(l), m.censoring, m.scalars)) {
      EXPECT_TRUE(
          same_bits(maps[static_cast<std::size_t>(l)], m.layers[static_cast<std::size_t>(l)]));
    }
  for (int i = 0; i < 200; ++i) {  // parts against the whole
    const int row = static_cast<int>(random() % 70), col = static_cast<int>(random() % 61);
    const Window part{3 + row, 4 + col, 1 + static_cast<int>(random() % (70 - row)),
                      1 + static_cast<int>(random() % (61 - col))};
    std::vector<float> got(part.n_cells()), expected;
    store.read_part(0, PeakLayer::speed, part, got);
    for (int r = part.row0; r < part.end_row(); ++r)
      for (int c = part.col0; c < part.end_col(); ++c)
        expected.push_back(
            m.layer(PeakLayer::speed)[static_cast<std::size_t>((r - 3) * 61 + c - 4)]);
    EXPECT_TRUE(same_bits(got, expected));
  }
}

TEST_F(Packs, OfShardsAndFilesAreOneStore) {
  append({1, 4, 7}, {2, 3});
  append({0, 3, 6}, {1, 3});
  write_member(members(), made_up_member(2));
  write_member(members(), made_up_member(5));
  const MemberStore store(members());
  EXPECT_THAT(store.problems(), IsEmpty());
  EXPECT_THAT(numbers_of(store), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  for (std::size_t i = 0; i < 8; ++i) {
    const MemberResult expected = made_up_member(static_cast<int>(i));
    EXPECT_TRUE(same_bits(maps_of_member(store, i)[0], expected.layer(PeakLayer::thickness))) << i;
  }
}

TEST_F(Packs, CountAMemberOnceByTheStatedRule) {
  MemberResult failed = made_up_member(3);
  failed.outcome = Outcome::failed;
  MemberResult later = made_up_member(3);
  later.state_hash = 99;
  {
    PackWriter writer(members(), {1, 2});
    writer.append(failed, origin());
  }
  EXPECT_EQ(MemberStore(members()).members().at(0).outcome, Outcome::failed);
  {
    PackWriter writer(members(), {2, 2});
    writer.append(made_up_member(3), origin());
    EXPECT_EQ(MemberStore(members()).members().at(0).outcome, made_up_member(3).outcome);
    writer.append(later, origin());
  }
  ASSERT_THAT(MemberStore(members()).members(), SizeIs(1));
  EXPECT_EQ(MemberStore(members()).members()[0].state_hash, 99U);  // the last of a pack
  MemberResult own = made_up_member(3);
  own.state_hash = 7;
  write_member(members(), own);
  EXPECT_EQ(MemberStore(members()).members().at(0).state_hash, 7U);  // a file of its own first
}

TEST_F(Packs, ThatCannotHoldAWantedMemberAreNotOpened) {
  append({0, 2, 4}, {1, 2});
  append({1, 3, 5}, {2, 2});
  write("members/1_of_2.001.pack", "no pack at all");
  MemberFilter odd;
  odd.wanted = [](std::int64_t k) { return k % 2 == 1; };
  odd.shard = {2, 2};
  const MemberStore store(members(), odd);
  EXPECT_THAT(store.problems(), IsEmpty());
  EXPECT_THAT(numbers_of(store), ElementsAre(1, 3, 5));
  odd.shard = {2, 4};  // 1, 5, ...: of 2_of_2 alone
  EXPECT_THAT(MemberStore(members(), odd).problems(), IsEmpty());
  odd.shard = {1, 3};  // shares members with both
  EXPECT_THAT(MemberStore(members(), odd).problems(), SizeIs(1));
}

TEST_F(Packs, AreFollowedByTheNextWhenTheyAreLong) {
  PackWriter writer(members(), {}, 10000);
  for (int k = 0; k < 12; ++k) writer.append(made_up_member(k), origin());
  EXPECT_GT(packs_in(members()).size(), 1U);
  EXPECT_THAT(MemberStore(members()).members(), SizeIs(12));
}

TEST_F(Packs, HaveOneWriterEach) {
  PackWriter first(members(), {}), second(members(), {});
  first.append(made_up_member(0), origin());
  second.append(made_up_member(1), origin());
  first.append(made_up_member(2), origin());
  EXPECT_EQ(packs_in(members()).size(), 2U);
  EXPECT_THAT(numbers_of(MemberStore(members())), ElementsAre(0, 1, 2));
}

TEST_F(Packs, StayWholeWhenTheDiskIsFull) {
  PackWriter writer(members(), {});
  writer.append(made_up_member(0), origin());
  const std::string before = bytes();
  {
    const SmallDisk full(before.size() + 1000);
    EXPECT_THAT(message_of([&] { writer.append(made_up_member(1), origin()); }),
                HasSubstr("cannot write"));
    EXPECT_EQ(bytes(), before);
  }
  writer.append(made_up_member(1), origin());
  EXPECT_THAT(numbers_of(MemberStore(members())), ElementsAre(0, 1));
}

TEST_F(Packs, BeginAboveSomeThousandsAndAFolderStaysAsItBegan) {
  EXPECT_EQ(layout_of(members(), most_member_files), MemberLayout::files);
  EXPECT_EQ(layout_of(members(), most_member_files + 1), MemberLayout::packs);
  write_member(members(), made_up_member(0));
  EXPECT_EQ(layout_of(members(), 1000000), MemberLayout::files);
  append({1});
  EXPECT_EQ(layout_of(members(), 10), MemberLayout::packs);
}

TEST_F(Packs, TellGaugesOfOneMember) {
  append({2});
  write_member(folder() / "files", made_up_member(2));
  const GaugeResult a = MemberStore(folder() / "files").gauges(0),
                    b = MemberStore(members()).gauges(0);
  EXPECT_EQ(a.time_s, b.time_s);
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.lines.size(), b.lines.size());
}

}  // namespace
}  // namespace sturz::test
