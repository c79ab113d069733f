// SPDX-License-Identifier: Apache-2.0
// What is cut short, flipped, zeroed or lost in a pack is found, named, and costs no other member.
#include "io/files/io_error.hpp"
#include "tests/io/packs/pack_fixture.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <set>
#include <thread>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class DamagedPack : public Packs {
 protected:
  void put(const std::string& content) const { write("members/1_of_1.001.pack", content); }
  /// Members of 0 .. n-1 that the store does not have.
  static std::set<std::int64_t> lost(const MemberStore& store, std::int64_t n) {
    std::set<std::int64_t> all;
    for (std::int64_t k = 0; k < n; ++k) all.insert(k);
    for (const std::int64_t k : numbers_of(store)) all.erase(k);
    return all;
  }
  static bool is_named(const MemberStore& store, std::int64_t k) {
    for (const std::string& problem : store.problems())
      if (problem.find("1_of_1.001.pack, member " + std::to_string(k) + " at byte") !=
          std::string::npos)
        return true;
    return false;
  }
};

TEST_F(DamagedPack, CutAtAnyByteKeepsTheMembersBeforeAndTakesMoreBehind) {
  append({0, 1, 2});
  const std::string whole = bytes();
  const std::vector<std::uint64_t> end = ends();
  ASSERT_THAT(end, SizeIs(3));
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    const std::size_t n = i < 40 ? random() % whole.size()                  // anywhere
                                 : end[random() % 3] + random() % 70 - 35;  // about a border
    const std::size_t size = std::min(n, whole.size());
    put(whole.substr(0, size));
    const auto n_whole = static_cast<std::size_t>(
        std::count_if(end.begin(), end.end(), [&](auto e) { return e <= size; }));
    EXPECT_THAT(MemberStore(members()).members(), SizeIs(n_whole)) << size;
    append({8, 9});  // as a resumed run does
    const MemberStore store(members());
    EXPECT_THAT(store.problems(), IsEmpty()) << size;
    EXPECT_THAT(store.members(), SizeIs(n_whole + 2)) << size;
    EXPECT_EQ(bytes().substr(0, n_whole > 0 ? end[n_whole - 1] : 0),
              whole.substr(0, n_whole > 0 ? end[n_whole - 1] : 0));
  }
}

TEST_F(DamagedPack, NamesTheMemberThatWasCutShort) {
  append({0, 1});
  put(bytes().substr(0, ends()[0] + 100));
  const MemberStore store(members());
  EXPECT_THAT(numbers_of(store), ElementsAre(0));
  ASSERT_THAT(store.problems(), SizeIs(1));
  EXPECT_THAT(store.problems()[0],
              AllOf(HasSubstr("1_of_1.001.pack, member 1 at byte"), HasSubstr("cut short")));
}

TEST_F(DamagedPack, NoFlippedBitIsReadAndItsMemberIsNamed) {
  append({0, 1, 2});
  const std::string good = bytes();
  std::mt19937 random(19);
  for (int i = 0; i < 400; ++i) {
    std::string flipped = good;
    const std::size_t at = random() % good.size();
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
    put(flipped);
    const MemberStore store(members());
    const auto missing = lost(store, 3);
    ASSERT_THAT(missing, SizeIs(1)) << "byte " << at;
    EXPECT_TRUE(is_named(store, *missing.begin())) << "byte " << at;
    EXPECT_THAT(store.problems(), SizeIs(1)) << "byte " << at;
  }
}

TEST_F(DamagedPack, StretchesThatWereZeroedOrLostCostTheirOwnMembersAlone) {
  append({0, 1, 2, 3});
  const std::string good = bytes();
  const std::vector<std::uint64_t> end = ends();
  std::mt19937 random(31);
  for (int i = 0; i < 150; ++i) {
    std::string bad = good;
    const std::size_t from = random() % good.size();
    const std::size_t n = 1 + random() % std::min<std::size_t>(6000, good.size() - from);
    if (i % 3 == 0)
      bad.erase(from, n);
    else
      bad.replace(from, n, std::string(n, i % 3 == 1 ? '\0' : '\xff'));
    if (bad == good) continue;
    put(bad);
    const MemberStore store(members());
    for (std::int64_t k = 0; k < 4; ++k) {
      const std::uint64_t begin = k == 0 ? 0 : end[static_cast<std::size_t>(k) - 1];
      const bool hit = from < end[static_cast<std::size_t>(k)] && from + n > begin;
      const auto missing = lost(store, 4);
      if (!hit) {
        EXPECT_FALSE(missing.contains(k)) << k << " by " << from << "+" << n;
      }
      if (missing.contains(k)) {
        EXPECT_THAT(store.problems(), ::testing::Not(IsEmpty()));
      }
    }
  }
}

TEST_F(DamagedPack, IsMendedByComputingAgain) {
  append({0, 1, 2});
  std::string bad = bytes();
  bad[ends()[0] + 300] ^= 1;
  put(bad);
  EXPECT_THAT(numbers_of(MemberStore(members())), ElementsAre(0, 2));
  append({1});
  const MemberStore store(members());
  EXPECT_THAT(numbers_of(store), ElementsAre(0, 1, 2));
  EXPECT_THAT(store.problems(), IsEmpty());
}

TEST_F(DamagedPack, FoundWhileItIsReadIsSaid) {
  append({0, 1});
  const MemberStore store(members());
  std::string bad = bytes();
  bad[ends()[0] - 40] ^= 1;  // the last map of member 0
  put(bad);
  const std::string message = message_of([&] { maps_of_member(store, 0); });
  EXPECT_THAT(message, AllOf(HasSubstr("member 0"), HasSubstr("checksum")));
}

TEST_F(DamagedPack, KilledAtAnyTimeHoldsWholeMembersOnly) {
  for (int round = 0; round < 12; ++round) {
    const pid_t child = fork();
    if (child == 0) {  // appends until it is killed
      PackWriter writer(members(), {});
      for (int k = 1000 * round;; ++k) writer.append(made_up_member(k % 1000), origin());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 7 * round % 40));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const MemberStore killed(members());
    for (const std::string& problem : killed.problems())
      EXPECT_THAT(problem, HasSubstr("never finished")) << problem;
    append({999});
    const MemberStore store(members());
    EXPECT_THAT(store.problems(), IsEmpty());
    EXPECT_EQ(store.members().back().member, 999);
    for (std::size_t i = 0; i + 1 < store.members().size(); i += 50) {
      const MemberResult expected = made_up_member(static_cast<int>(store.members()[i].member));
      EXPECT_TRUE(same_bits(maps_of_member(store, i)[1], expected.layer(PeakLayer::speed)));
    }
  }
}

}  // namespace
}  // namespace sturz::test
