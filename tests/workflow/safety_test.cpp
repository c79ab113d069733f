// SPDX-License-Identifier: Apache-2.0
// What does not belong together is never mixed, and what was lost is said.
#include "engine/core/error.hpp"
#include "ensemble/workflow/folder/folder_members.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/members/member_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <set>
#include <sstream>

namespace sturz::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Safety : public Workflow {
 protected:
  static std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "not refused";
  }
  std::string merge_refusal(Recorder& heard, bool partial = false) const {
    return refusal([&] { workflow::merge_members({path("out"), partial}, heard); });
  }
  workflow::MapsMade made(const std::string& results = "out") const {
    Recorder heard;
    return whole(request(results), heard);
  }
  void other_scene(const std::string& results) const {
    workflow::EnsembleRequest other = request(results);
    other.scene = scene({"release.thickness_m=2"});
    Recorder heard;
    whole(other, heard);
  }
  void copy_member(const std::string& from, const std::string& to, int member) const {
    const std::string name = "/members/00000" + std::to_string(member) + ".nc";
    fs::copy_file(path(from + name), path(to + name), fs::copy_options::overwrite_existing);
  }
  nlohmann::json manifest(const std::string& results = "out") const {
    return nlohmann::json::parse(read(results + "/manifest.json"));
  }
  void change_manifest(const std::function<void(nlohmann::json&)>& change) const {
    nlohmann::json all = manifest();
    change(all);
    write("out/manifest.json", all.dump());
  }
  void change_design(const std::function<void(std::vector<std::string>&)>& change) const {
    std::vector<std::string> lines;
    std::istringstream text(read("out/design.csv"));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    change(lines);
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    write("out/design.csv", all);
  }
};

TEST_F(Safety, MembersOfAnotherSceneDoNotMerge) {
  made();
  other_scene("other");
  copy_member("other", "out", 1);
  copy_member("other", "out", 4);
  Recorder heard;
  EXPECT_THAT(merge_refusal(heard), HasSubstr("2 of 6 members are missing (1, 4)"));
  ASSERT_EQ(heard.warnings.size(), 2u);
  EXPECT_THAT(heard.warnings[0], HasSubstr("000001.nc: was computed from another scene"));
}

TEST_F(Safety, AMemberUnderAnotherNumberIsNotThatMember) {
  made();
  MemberResult second = read_member(path("out/members/000002.nc"));
  second.member = 3;
  MemberOrigin origin;
  MemberFilter look;
  look.refusal = [&](const MemberSummary& m, const MemberOrigin& o) {
    if (m.member == 2) origin = o;
    return std::string();
  };
  const MemberStore store(path("out/members"), look);
  write_member(path("out/members"), second, origin);
  Recorder heard;
  EXPECT_THAT(merge_refusal(heard), HasSubstr("1 of 6 members are missing (3)"));
}

TEST_F(Safety, ForeignMembersAreComputedAgain) {
  const std::string hash = made().hazard_hash;
  other_scene("other");
  copy_member("other", "out", 5);
  Recorder heard;
  EXPECT_EQ(whole(request("out"), heard).hazard_hash, hash);
  EXPECT_THAT(heard.members, ElementsAre(5));
  EXPECT_THAT(heard.warnings, Contains(HasSubstr("It is computed again")));
}

TEST_F(Safety, AMemberOfAnUnknownProgramIsNotMixedIn) {
  const std::string hash = made().hazard_hash;
  change_manifest([](nlohmann::json& all) {
    all["computed_by"] = {{{"version", "0.0.9"}, {"git_commit", "older"}}};
  });
  Recorder heard;
  EXPECT_THAT(merge_refusal(heard), HasSubstr("6 of 6 members are missing"));
  EXPECT_THAT(heard.warnings, Contains(HasSubstr("of which manifest.json knows nothing")));
  EXPECT_EQ(made("again").hazard_hash, hash);
}

TEST_F(Safety, AResumeByAnotherBuildWarnsAndKeepsBoth) {
  made();
  change_manifest([](nlohmann::json& all) {
    all["computed_by"] = {{{"version", "0.0.9"}, {"git_commit", "older"}}};
    all["program"]["git_commit"] = "older";
  });
  Recorder heard;
  run(request("out"), heard);
  EXPECT_THAT(heard.warnings, Contains(HasSubstr("was begun by sturz 0.0.9 (older)")));
  const auto both = manifest().at("computed_by");
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].at("git_commit"), "older");
  Recorder later;
  workflow::merge_members({path("out")}, later);
  EXPECT_THAT(later.warnings, Contains(HasSubstr("computed by 2 programs")));
  EXPECT_THAT(read("out/report.html"), HasSubstr("0.0.9"));
}

TEST_F(Safety, AnEditedDesignIsRefused) {
  made();
  const std::string good = read("out/design.csv");
  const auto expect_refused = [&](const std::string& why) {
    Recorder heard;
    EXPECT_THAT(merge_refusal(heard), HasSubstr("design.csv was changed")) << why;
    EXPECT_THAT(refusal([&] { run(request("out"), heard); }), HasSubstr(why));
    write("out/design.csv", good);
  };
  change_design([](auto& lines) {
    std::string& row = lines[lines.size() - 2];  // member 4
    const auto first = row.find(','), second = row.find(',', first + 1);
    row.replace(first + 1, second - first - 1, "1e9");
  });
  expect_refused("member 4, ");
  change_design([](auto& lines) { lines.pop_back(); });
  expect_refused("design.csv was changed");
  change_design([](auto& lines) { std::swap(lines[1], lines[2]); });  // comments: no change
  Recorder heard;
  EXPECT_EQ(merge_refusal(heard), "not refused");
}

TEST_F(Safety, AnEditedScenarioIsRefusedUnlessOnlyTheMapsChange) {
  made();
  const std::string good = read("out/scenario.yaml");
  write("out/scenario.yaml", replaced(good, "thickness_m: [", "thickness_m: [0.25, "));
  Recorder heard;
  EXPECT_EQ(merge_refusal(heard), "not refused") << good;
  write("out/scenario.yaml", replaced(good, "end_time_s: ", "end_time_s: 1"));
  EXPECT_THAT(merge_refusal(heard), HasSubstr("scenario.yaml was changed after it was written"));
}

TEST_F(Safety, APageIsNotWrittenOverMapsOfOtherMembers) {
  workflow::EnsembleRequest few = request("out");
  few.members = 3;
  Recorder first, second;
  whole(few, first);
  const std::string page = read("out/report.html");
  second.cancel_after = 1;
  EXPECT_TRUE(run(request("out"), second).interrupted);
  const std::string refused = refusal([&] { workflow::rewrite_page(path("out"), second); });
  EXPECT_THAT(refused, HasSubstr("made from other members"));
  EXPECT_THAT(refused, HasSubstr("4 of 6"));
  EXPECT_EQ(read("out/report.html"), page);
  made();
  EXPECT_EQ(refusal([&] { workflow::rewrite_page(path("out"), second); }), "not refused");
}

TEST_F(Safety, APageIsNotWrittenOverMapsThatWereNotFinished) {
  made();
  change_manifest([](nlohmann::json& all) { all["hazard_hash"] = ""; });
  Recorder heard;
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("out"), heard); }),
              HasSubstr("its maps are not finished"));
}

TEST_F(Safety, AMemberLostBeforeTheMapsStopsThem) {
  for (const bool damaged : {false, true}) {
    const std::string out = damaged ? "damaged" : "lost";
    Recorder heard;
    {
      workflow::EnsembleJob job = workflow::prepare_ensemble(request(out), heard);
      workflow::run_ensemble(job, heard, heard.cancel);
      if (damaged)
        damage(out, 2);
      else
        fs::remove(path(out + "/members/000002.nc"));
      EXPECT_THROW(workflow::make_maps(job, heard), workflow::MembersMissing);
    }
    EXPECT_FALSE(exists(out + "/hazard.nc"));
    Recorder again;
    EXPECT_EQ(whole(request(out), again).hazard_hash, undisturbed());
    EXPECT_THAT(again.members, ElementsAre(2));
  }
}

TEST_F(Safety, OnlyOurOwnMapsAreRemoved) {
  made();
  write("out/hazard/my_own.tif", "mine");
  write("out/hazard/notes.txt", "mine");
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"hazard.thickness_m=[0.75]"});
  Recorder heard;
  whole(other, heard);
  EXPECT_TRUE(exists("out/hazard/my_own.tif"));
  EXPECT_TRUE(exists("out/hazard/notes.txt"));
  std::set<std::string> listed{"index.csv", "my_own.tif", "notes.txt"};
  std::istringstream index(read("out/hazard/index.csv"));
  std::string line;
  std::getline(index, line);  // names of the columns
  while (std::getline(index, line)) {
    const std::string tif = line.substr(0, line.find(','));
    listed.insert(tif);
    listed.insert(fs::path(tif).replace_extension(".qml").string());
  }
  EXPECT_GT(listed.size(), 9u);
  std::set<std::string> there;
  for (const auto& entry : fs::recursive_directory_iterator(path("out/hazard")))
    if (entry.is_regular_file())
      there.insert(entry.path().lexically_relative(path("out/hazard")).string());
  EXPECT_EQ(there, listed) << "maps of the earlier threshold stayed";
}

TEST_F(Safety, OnlyOurOwnFramesAreRemoved) {
  Recorder heard;
  workflow::RunRequest with_frames{scene(), path("single"), 1, 1.0, "test"};
  workflow::SingleRun one = workflow::prepare_run(with_frames, heard);
  workflow::compute_run(one, heard, heard.cancel);
  ASSERT_TRUE(exists("single/particles/particles_000000.vtp"));
  write("single/particles/view.pvsm", "mine");
  with_frames.particles_every_s.reset();
  workflow::SingleRun two = workflow::prepare_run(with_frames, heard);
  workflow::compute_run(two, heard, heard.cancel);
  EXPECT_FALSE(exists("single/particles/particles_000000.vtp"));
  EXPECT_TRUE(exists("single/particles/view.pvsm"));
}

TEST_F(Safety, TheWallTimeLimitMayBeRaisedAndTheFailedOnesRetried) {
  workflow::EnsembleRequest short_of_time = request("out");
  short_of_time.scene = scene({"numerics.max_wall_time_s=1e-7"});
  Recorder first;
  const workflow::MembersRun failed = run(short_of_time, first);
  EXPECT_EQ(failed.failed.size(), static_cast<std::size_t>(n_tiny));
  workflow::EnsembleRequest again = request("out");
  Recorder idle, second;
  EXPECT_TRUE(run(again, idle).failed.empty()) << "without --retry-failed nothing is computed";
  EXPECT_TRUE(idle.members.empty());
  again.retry_failed = true;
  EXPECT_EQ(whole(again, second).hazard_hash, undisturbed());
}

TEST_F(Safety, ARunDoesNotReplaceThatOfAnotherScene) {
  Recorder heard;
  const auto run_into = [&](std::vector<std::string> set, bool replace) {
    workflow::RunRequest request{scene(std::move(set)), path("single"), 1, {}, "test", replace};
    workflow::SingleRun one = workflow::prepare_run(request, heard);
    workflow::store_run(one, workflow::compute_run(one, heard, heard.cancel));
  };
  run_into({}, false);
  const std::string page = read("single/report.html");
  EXPECT_THAT(refusal([&] { run_into({"release.thickness_m=2"}, false); }),
              HasSubstr("release.thickness_m: 3 -> 2"));
  EXPECT_EQ(read("single/report.html"), page);
  EXPECT_EQ(refusal([&] { run_into({"title=the same again"}, false); }), "not refused");
  EXPECT_EQ(refusal([&] { run_into({"release.thickness_m=2"}, true); }), "not refused");
  EXPECT_NE(read("single/report.html"), page);
}

}  // namespace
}  // namespace sturz::test
