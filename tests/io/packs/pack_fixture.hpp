// SPDX-License-Identifier: Apache-2.0
/// A folder with members in packs, and what must be equal in two of them.
#pragma once

#include "io/files/text_files.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/members/packs/pack_writer.hpp"
#include "tests/io/io_fixture.hpp"

#include <bit>
#include <cstring>
#include <string>
#include <vector>

namespace sturz::test {

class Packs : public IoTest {
 protected:
  std::filesystem::path members() const { return folder() / "members"; }
  /// The first pack of a folder without shards.
  std::filesystem::path pack() const { return members() / pack_file_name({}); }
  std::string bytes() const { return read_text(pack()); }
  void append(const std::vector<int>& numbers, PackName shard = {}) const {
    PackWriter writer(members(), shard);
    for (const int k : numbers) writer.append(made_up_member(k), origin());
  }
  static MemberOrigin origin() { return {"sha256:12", "1.2.3", "abcdef"}; }
  static std::vector<std::int64_t> numbers_of(const MemberStore& store) {
    std::vector<std::int64_t> numbers;
    for (const MemberSummary& m : store.members()) numbers.push_back(m.member);
    return numbers;
  }
  /// Ends of the records of a pack, from its own walk.
  std::vector<std::uint64_t> ends() const {
    std::vector<std::uint64_t> all;
    PackVisitor visitor;
    visitor.record = [&](const RecordHead& head, std::uint64_t at) {
      all.push_back(at + head.total);
    };
    look_through(PackFile(pack()), visitor);
    return all;
  }
  /// Every layer of member `index`, whole window.
  static std::vector<std::vector<float>> maps_of_member(const MemberStore& store,
                                                        std::size_t index) {
    std::vector<std::vector<float>> all;
    const Window& w = store.members()[index].window;
    for (int l = 0; l < n_peak_layers; ++l) {
      all.emplace_back(w.n_cells());
      store.read_part(index, static_cast<PeakLayer>(l), w, all.back());
    }
    return all;
  }
};

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

}  // namespace sturz::test
