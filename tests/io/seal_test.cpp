// SPDX-License-Identifier: Apache-2.0
// A checksum over all of a member's file is looked at before HDF5 opens it.
#include "io/files/seal.hpp"

#include "io/files/io_error.hpp"
#include "io/files/text_files.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "tests/io/io_fixture.hpp"

#include <random>
#include <span>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class Seal : public IoTest {
 protected:
  std::string sealed(const std::string& content) const {
    write("file", content + seal_of(std::as_bytes(std::span(content))));
    return path("file");
  }
  std::string whole_member() const {
    write_member(folder() / "members", made_up_member(0));
    return read_text(folder() / "members/000000.nc");
  }
  /// The store must name the file and know no member.
  void expect_named(const std::string& bytes, const std::string& what) const {
    write("members/000000.nc", bytes);
    const MemberStore store(folder() / "members");
    EXPECT_THAT(store.members(), IsEmpty()) << what;
    ASSERT_THAT(store.problems(), SizeIs(1)) << what;
    EXPECT_THAT(store.problems()[0], HasSubstr("000000.nc")) << what;
    EXPECT_THROW(read_member(folder() / "members/000000.nc"), IoError) << what;
  }
};

TEST_F(Seal, KnowsItsOwnContentOfAnyLength) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 18,
                              (std::size_t{1} << 18) + 1, std::size_t{600000}})
    EXPECT_EQ(seal_state(sealed(std::string(n, 'x'))), SealState::good) << n;
}

TEST_F(Seal, SaysWhatIsWrong) {
  std::string bytes = read_text(sealed("content"));
  write("file", bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(seal_state(path("file")), SealState::missing);
  write("file", bytes + "more");
  EXPECT_EQ(seal_state(path("file")), SealState::missing);
  write("file", "");
  EXPECT_EQ(seal_state(path("file")), SealState::missing);
  bytes[0] = 'C';
  write("file", bytes);
  EXPECT_EQ(seal_state(path("file")), SealState::broken);
  EXPECT_THAT(message_of([&] { require_sealed(path("file")); }), HasSubstr("does not fit"));
  EXPECT_THROW(seal_state(path("nowhere")), IoError);
}

TEST_F(Seal, IsTheSha256OfTheContent) {
  const std::string content = "abc";
  EXPECT_THAT(seal_of(std::as_bytes(std::span(content))),  // FIPS 180-2, B.1
              HasSubstr("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
}

TEST_F(Seal, NoFlippedBitOfAMemberReachesTheReader) {
  const std::string good = whole_member();
  std::mt19937 random(19);
  for (int i = 0; i < 200; ++i) {
    std::string bytes = good;
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    expect_named(bytes, "byte " + std::to_string(at));
  }
}

TEST_F(Seal, NoStretchOfAMemberOverwrittenOrLostReachesTheReader) {
  const std::string good = whole_member();
  std::mt19937 random(31);
  for (int i = 0; i < 50; ++i) {
    std::string bytes = good;
    const std::size_t from = random() % bytes.size();
    const std::size_t n = 1 + random() % std::min<std::size_t>(4096, bytes.size() - from);
    if (i % 2 == 0)
      bytes.replace(from, n, std::string(n, i % 4 == 0 ? '\0' : '\xff'));
    else
      bytes.erase(from, n);
    if (bytes != good) expect_named(bytes, std::to_string(from) + "+" + std::to_string(n));
  }
}

TEST_F(Seal, AFileThatCrashedTheReaderOnceIsNamed) {
  const auto crash = shared("practice/corrupt/member_flipped.nc");
  if (crash.empty()) GTEST_SKIP() << "the shared data is not there";
  std::filesystem::create_directory(folder() / "members");
  expect_named(read_text(crash), "member_flipped.nc");
}

TEST_F(Seal, TheOriginIsUnderItToo) {
  const MemberOrigin origin{"sha256:12", "1.2.3", "abcdef"};
  write_member(folder(), made_up_member(4), origin);
  std::vector<MemberOrigin> found;
  MemberFilter filter;
  filter.refusal = [&](const MemberSummary&, const MemberOrigin& o) {
    found.push_back(o);
    return std::string("is not wanted");
  };
  const MemberStore store(folder(), filter);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0], origin);
  EXPECT_THAT(store.members(), IsEmpty());
  EXPECT_THAT(store.problems()[0], HasSubstr("000004.nc: is not wanted"));
}

TEST_F(Seal, MembersThatAreNotWantedAreNotOpened) {
  for (const int k : {0, 1, 2, 3}) write_member(folder(), made_up_member(k));
  write("000001.nc", "damaged");
  MemberFilter even;
  even.wanted = [](std::int64_t k) { return k % 2 == 0; };
  const MemberStore store(folder(), even);
  EXPECT_THAT(store.members(), SizeIs(2));
  EXPECT_THAT(store.problems(), IsEmpty());
}

}  // namespace
}  // namespace sturz::test
