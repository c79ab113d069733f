// SPDX-License-Identifier: Apache-2.0
// Ensembles whose members lie in packs: the bits of those in files, and what is damaged is mended.
#include "engine/core/error.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/members/stored_members.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_store.hpp"
#include "io/members/packs/pack_writer.hpp"
#include "tests/support/made_up_flows.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class PackedEnsemble : public Workflow {
 protected:
  workflow::EnsembleRequest packed(const std::string& results, workflow::Shard shard = {}) const {
    workflow::EnsembleRequest r = request(results);
    r.packs = true;
    r.shard = shard;
    return r;
  }
  std::size_t n_packs(const std::string& results) const {
    return packs_in(path(results) / "members").size();
  }
  static constexpr const char* pack = "out/members/1_of_1.001.pack";
};

TEST_F(PackedEnsemble, HasTheBitsOfOneInFiles) {
  Recorder heard;
  const workflow::MapsMade made = whole(packed("out"), heard);
  EXPECT_EQ(made.hazard_hash, undisturbed());
  EXPECT_EQ(n_members("out"), 0U);
  EXPECT_EQ(n_packs("out"), 1U);
  EXPECT_THAT(heard.warnings, IsEmpty());
  Recorder again;
  EXPECT_EQ(whole(request("out"), again).hazard_hash,
            made.hazard_hash);  // without asking for packs
  EXPECT_THAT(again.members, IsEmpty()) << "members were computed again";
  EXPECT_EQ(n_members("out"), 0U);
}

TEST_F(PackedEnsemble, OfShardsAndFilesInOneFolderMergesToTheSameBits) {
  Recorder silent;
  run(packed("out", {2, 3}), silent);
  run(packed("out", {1, 3}), silent);
  workflow::EnsembleRequest last = request("files");
  last.shard = {3, 3};
  run(last, silent);
  for (const int k : {2, 5})
    std::filesystem::copy(path("files") / "members" / member_file_name(k),
                          path("out") / "members" / member_file_name(k));
  EXPECT_EQ(workflow::merge_members({path("out")}, silent).hazard_hash, undisturbed());
}

TEST_F(PackedEnsemble, NamesADamagedMemberAndComputesItAgain) {
  Recorder silent;
  const std::string hash = whole(packed("out"), silent).hazard_hash;
  std::string bytes = read(pack);
  std::uint64_t third = 0;
  int n = 0;
  PackVisitor visitor;
  visitor.record = [&](const RecordHead& head, std::uint64_t at) {
    if (++n == 3) third = at + head.total - 100;
  };
  look_through(PackFile(path(pack)), visitor);
  bytes[third] = static_cast<char>(bytes[third] ^ 4);
  write(pack, bytes);
  Recorder heard;
  EXPECT_EQ(whole(request("out"), heard).hazard_hash, hash);
  EXPECT_THAT(heard.members, SizeIs(1));
  ASSERT_THAT(heard.warnings, SizeIs(1));
  EXPECT_THAT(heard.warnings[0],
              HasSubstr("1_of_1.001.pack, member " + std::to_string(heard.members.at(0))));
  Recorder sound;
  whole(request("out"), sound);
  EXPECT_THAT(sound.warnings, IsEmpty());
}

TEST_F(PackedEnsemble, GoesOnBehindATornEnd) {
  Recorder silent;
  const std::string hash = whole(packed("out"), silent).hazard_hash;
  write(pack, read(pack).substr(0, read(pack).size() - 1000));
  Recorder heard;
  EXPECT_EQ(whole(request("out"), heard).hazard_hash, hash);
  EXPECT_THAT(heard.members, SizeIs(1));
}

TEST_F(PackedEnsemble, RetriesItsFailedMembers) {
  Recorder silent;
  const std::string hash = whole(packed("out"), silent).hazard_hash;
  {
    const MemberStore store(path("out/members"));
    MemberOrigin origin;
    MemberResult failed = store.result(4, origin);
    failed.outcome = Outcome::failed;
    std::filesystem::create_directories(path("kept"));
    std::filesystem::rename(path(pack), path("kept/all.pack"));
    PackWriter writer(path("out/members"), {});
    for (std::size_t i = 0; i < store.members().size(); ++i)
      if (i != 4) {
        MemberOrigin of;
        writer.append(store.result(i, of), of);
      }
    writer.append(failed, origin);
  }
  workflow::EnsembleRequest retry = request("out");
  retry.retry_failed = true;
  Recorder heard;
  EXPECT_EQ(whole(retry, heard).hazard_hash, hash);
  EXPECT_THAT(heard.members, ElementsAre(4));
}

TEST_F(PackedEnsemble, GivesItsMembersAsFilesOfTheirOwn) {
  Recorder silent;
  whole(packed("out"), silent);
  const auto files = workflow::extract_members({path("out"), {{1, 1}, {3, 4}}, {}}, silent);
  ASSERT_THAT(files, SizeIs(3));
  EXPECT_EQ(files[2], path("out/extracted/000004.nc"));
  EXPECT_EQ(read_member(files[2]).state_hash,
            MemberStore(path("out/members")).members().at(4).state_hash);
  EXPECT_THROW(workflow::extract_members({path("out"), {{1, 6}}, {}}, silent), SetupError);
  const workflow::StoredMembers found = workflow::stored_members(path("out"), silent);
  EXPECT_EQ(found.n_members, 6);
  EXPECT_EQ(found.n_files, 0);
  ASSERT_THAT(found.packs, SizeIs(1));
  EXPECT_EQ(found.packs[0].second, 6);
}

TEST_F(PackedEnsemble, WithoutItsSceneIsNotContinued) {
  Recorder silent;
  run(packed("out"), silent);
  std::filesystem::remove(path("out/scenario.yaml"));
  EXPECT_THROW(run(packed("out"), silent), SetupError);
}

/// What a map must hold, from all members at once and without any cleverness.
class NaiveMap {
 public:
  NaiveMap(int n, int edge) {
    for (int k = 0; k < n; ++k) members_.push_back(made_up_flow(k, edge));
  }
  std::vector<float> values(PeakLayer layer, int row, int col) const {
    std::vector<float> all;
    for (const MemberResult& m : members_) {
      const Window& w = m.window;
      const bool in = w.contains(row, col);
      const auto i = static_cast<std::size_t>((row - w.row0) * w.n_cols + col - w.col0);
      all.push_back(in ? m.layer(layer)[i] : info(layer).untouched);
    }
    return all;
  }
  float reached(int row, int col) const {
    const auto times = values(PeakLayer::arrival, row, col);
    const auto n = std::count_if(times.begin(), times.end(), [](float t) { return t >= 0; });
    return static_cast<float>(static_cast<double>(n) / static_cast<double>(times.size()));
  }
  float mean_speed(int row, int col) const {
    double sum = 0;
    for (const float v : values(PeakLayer::speed, row, col)) sum += v;
    return static_cast<float>(sum / static_cast<double>(members_.size()));
  }
  float quantile(PeakLayer layer, double fraction, int row, int col) const {
    auto all = values(layer, row, col);
    std::sort(all.begin(), all.end());
    const double place = fraction * static_cast<double>(all.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double a = all[below], b = all[std::min(below + 1, all.size() - 1)];
    return static_cast<float>(a + (place - static_cast<double>(below)) * (b - a));
  }

 private:
  std::vector<MemberResult> members_;
};

TEST_F(PackedEnsemble, OfManyPacksMergesToWhatANaiveLoopFindsWithinItsMemory) {
  constexpr int n = 300, edge = 200, shards = 4;
  for (int k = 1; k <= shards; ++k) {
    PackWriter writer(path("members"), {k, shards}, 1 << 20);
    for (int m = k - 1; m < n; m += shards) writer.append(made_up_flow(m, edge), {});
  }
  ASSERT_GT(packs_in(path("members")).size(), 4U);
  const MemberStore store(path("members"));
  ASSERT_THAT(store.members(), SizeIs(n));
  HazardContext context;
  context.memory_bytes = 1 << 18;  // for some forty passes
  const LayerStack maps = make_hazard_map(store, {}, context);
  const NaiveMap naive(n, edge);
  const auto layer = [&](const char* name) -> const Layer& {
    return *std::find_if(maps.layers.begin(), maps.layers.end(),
                         [&](const Layer& l) { return l.name == name; });
  };
  const Grid& whole_grid = store.grid();
  const Window extent = window_of(maps.grid, whole_grid);
  const HazardSpec spec;
  ASSERT_FALSE(spec.quantiles.empty());
  for (int row = extent.row0; row < extent.end_row(); ++row)
    for (int col = extent.col0; col < extent.end_col(); ++col) {
      const std::size_t i = maps.grid.index(row - extent.row0, col - extent.col0);
      EXPECT_EQ(layer("probability_of_reach").values[i], naive.reached(row, col));
      EXPECT_EQ(layer("speed_mean").values[i], naive.mean_speed(row, col));
      for (std::size_t q = 0; q < spec.quantiles.size(); ++q)
        EXPECT_EQ(layer("thickness_quantile").values[q * maps.grid.n_cells() + i],
                  naive.quantile(PeakLayer::thickness, spec.quantiles[q], row, col));
      if (HasFailure()) FAIL() << "first in row " << row << ", column " << col;
    }
  context.memory_bytes = MemberCells::default_memory_bytes;
  EXPECT_EQ(hash_of(make_hazard_map(store, {}, context)), hash_of(maps));
}

}  // namespace
}  // namespace sturz::test
