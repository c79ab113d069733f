// SPDX-License-Identifier: Apache-2.0
// An ensemble that stops by its map: at fixed counts, and with the map of a plain one of that size.
#include "ensemble/workflow/members/until_converged.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Listener : Recorder {
  std::vector<StopRecord> looks;
  double last_half_width = 0;
  void looked(const StopRecord& record) override { looks.push_back(record); }
  void ensemble_progress(const RunnerProgress& progress, std::int64_t before) override {
    Recorder::ensemble_progress(progress, before);
    last_half_width = progress.half_width;
  }
  std::vector<std::int64_t> counts() const {
    std::vector<std::int64_t> found;
    for (const StopRecord& look : looks) found.push_back(look.last.n_members);
    return found;
  }
};

class UntilConverged : public Workflow {
 protected:
  workflow::EnsembleRequest until(const std::string& results, double half_width, int at_most) {
    workflow::EnsembleRequest r = request(results);
    r.members = at_most;
    r.until_half_width = half_width;
    return r;
  }
  struct Ended {
    workflow::MembersRun run;
    workflow::MapsMade maps;  ///< empty when it was interrupted
  };
  static Ended run(const workflow::EnsembleRequest& request, Listener& heard) {
    workflow::EnsembleJob job = workflow::prepare_ensemble(request, heard);
    Ended ended;
    ended.run = workflow::run_until_converged(job, heard, heard.cancel);
    if (!ended.run.interrupted) ended.maps = workflow::make_maps(job, heard);
    return ended;
  }
  std::string plain(int members, const std::string& results) {
    workflow::EnsembleRequest r = request(results);
    r.members = members;
    Recorder heard;
    return whole(r, heard).hazard_hash;
  }
};

TEST_F(UntilConverged, StopsAtALookWithTheMapOfAPlainEnsemble) {
  Listener heard;
  // Some cell lies near 1/2, where 32 members give 0.164 and 64 give 0.119.
  const Ended ended = run(until("out", 0.14, 200), heard);
  EXPECT_THAT(heard.counts(), ElementsAre(32, 64));
  EXPECT_GT(heard.looks[0].last.found.half_width, 0.14);
  EXPECT_FALSE(heard.looks[0].reached());
  ASSERT_TRUE(ended.run.stop.has_value());
  EXPECT_TRUE(ended.run.stop->reached());
  EXPECT_EQ(ended.run.stop->n_looks, 2);
  EXPECT_EQ(ended.run.finished, 64);
  EXPECT_EQ(n_members("out"), 64u);
  EXPECT_EQ(heard.last_half_width, ended.run.stop->last.found.half_width);
  EXPECT_EQ(ended.maps.hazard_hash, plain(64, "plain"));
  EXPECT_EQ(read("out/design.csv"), read("plain/design.csv"));
  EXPECT_EQ(read("out/scenario.yaml"), read("plain/scenario.yaml"));
}

TEST_F(UntilConverged, TellsHowItEndedInManifestAndPage) {
  Listener heard;
  run(until("out", 0.14, 200), heard);
  const workflow::OutputFolder folder{path("out")};
  const auto stop = workflow::Manifest::read(folder.manifest()).stop;
  ASSERT_TRUE(stop.has_value());
  EXPECT_EQ(stop_text(*stop), stop_text(heard.looks.back()));
  EXPECT_THAT(read("out/report.html"), HasSubstr("stop rule"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("wanted is 0.14"));
  workflow::rewrite_page(path("out"), heard);
  EXPECT_THAT(read("out/report.html"), HasSubstr("wanted is 0.14"));
}

TEST_F(UntilConverged, InterruptedAnywhereItGoesOnToTheSameLooksAndMap) {
  Listener undisturbed;
  const std::string hash = run(until("whole", 0.14, 200), undisturbed).maps.hazard_hash;
  Listener first, second, third;
  first.cancel_after = 20;  // within the first batch
  EXPECT_TRUE(run(until("out", 0.14, 200), first).run.interrupted);
  EXPECT_TRUE(first.looks.empty());
  second.cancel_after = 25;  // 45 members: within the second
  const Ended stopped = run(until("out", 0.14, 200), second);
  EXPECT_TRUE(stopped.run.interrupted);
  EXPECT_FALSE(stopped.run.stop.has_value());
  EXPECT_THAT(second.counts(), ElementsAre(32));
  const Ended ended = run(until("out", 0.14, 200), third);
  EXPECT_EQ(third.members.size(), 64u - 45u);
  EXPECT_THAT(third.counts(), ElementsAre(32, 64));
  EXPECT_EQ(stop_text(third.looks[0]), stop_text(undisturbed.looks[0]));
  EXPECT_EQ(stop_text(*ended.run.stop), stop_text(undisturbed.looks.back()));
  EXPECT_EQ(ended.maps.hazard_hash, hash);
}

TEST_F(UntilConverged, WorkersDoNotChangeWhereItStops) {
  workflow::EnsembleRequest two = until("two", 0.14, 200);
  two.workers = 2;
  Listener one, both;
  const std::string hash = run(until("one", 0.14, 200), one).maps.hazard_hash;
  EXPECT_EQ(run(two, both).maps.hazard_hash, hash);
  EXPECT_EQ(stop_text(one.looks.back()), stop_text(both.looks.back()));
}

TEST_F(UntilConverged, AtItsCapItSaysThatItIsNotSure) {
  Listener heard;
  const Ended ended = run(until("out", 0.02, 40), heard);
  EXPECT_THAT(heard.counts(), ElementsAre(32, 40));
  ASSERT_TRUE(ended.run.stop.has_value());
  EXPECT_FALSE(ended.run.stop->reached());
  EXPECT_EQ(ended.maps.planned, 40);
  // A larger cap goes on from there, at the looks that any folder has.
  Listener more;
  run(until("out", 0.14, 200), more);
  EXPECT_THAT(more.counts(), ElementsAre(32, 64));
  EXPECT_EQ(more.members.size(), 24u);
}

TEST_F(UntilConverged, AFolderThatWasSureStaysAndGoesOnWhenMoreIsAsked) {
  Listener first, again, more;
  const std::string hash = run(until("out", 0.14, 200), first).maps.hazard_hash;
  const Ended same = run(until("out", 0.14, 200), again);
  EXPECT_TRUE(again.members.empty());
  EXPECT_EQ(same.maps.hazard_hash, hash);
  const Ended finer = run(until("out", 0.11, 200), more);
  EXPECT_EQ(more.looks.back().last.n_members, 96);
  EXPECT_EQ(more.members.front(), 64);
  EXPECT_EQ(finer.maps.hazard_hash, plain(96, "plain"));
}

class UntilAssetIsSure : public UntilConverged {
 protected:
  UntilAssetIsSure() {
    write("assets.geojson", R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"id": "source"},
       "geometry": {"type": "Point", "coordinates": [-45, 0]}},
      {"type": "Feature", "properties": {"id": "away"},
       "geometry": {"type": "Point", "coordinates": [5000, 0]}}]})");
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged") +
              "assets: {features: assets.geojson, name_attribute: id}\n");
  }
  workflow::EnsembleRequest until_sure(const std::string& asset) {
    workflow::EnsembleRequest r = until("out", 0.06, 200);
    r.until_asset = asset;
    return r;
  }
  std::string refusal(const std::string& asset) {
    Recorder heard;
    try {
      workflow::prepare_ensemble(until_sure(asset), heard);
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "";
  }
};

/// Every member reaches its own release: 32 of 32, for which the interval is 0.107 wide unless
/// members still move, and then the map would need 381.
TEST_F(UntilAssetIsSure, LooksAtThatAssetAlone) {
  Listener heard;
  const Ended ended = run(until_sure("source"), heard);
  ASSERT_TRUE(ended.run.stop.has_value());
  EXPECT_TRUE(ended.run.stop->reached());
  EXPECT_EQ(ended.run.stop->asset, "source");
  EXPECT_EQ(ended.run.stop->last.found.at, LookedAt::asset);
  EXPECT_THAT(heard.counts(), ElementsAre(32));
  EXPECT_EQ(heard.last_half_width, ended.run.stop->last.found.half_width);
  const auto kept = workflow::Manifest::read(path("out/manifest.json")).stop;
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(stop_text(*kept), stop_text(*ended.run.stop));
  EXPECT_THAT(read("out/report.html"), HasSubstr("P(hit) of source"));
  // From the stored members it is the same look.
  Listener again;
  run(until_sure("source"), again);
  EXPECT_TRUE(again.members.empty());
  EXPECT_EQ(stop_text(again.looks.at(0)), stop_text(heard.looks.at(0)));
}

TEST_F(UntilAssetIsSure, RefusesAssetsThatAreNotThere) {
  EXPECT_THAT(refusal("sorce"), HasSubstr("did you mean source?"));
  EXPECT_THAT(refusal("away"), HasSubstr("beyond the known ground"));
  write("scene.yaml", tiny_scene());
  EXPECT_THAT(refusal("source"), HasSubstr("the scene has no `assets`"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(UntilConverged, AFolderOfAnotherNumberGoesOnAtTheNextLook) {
  plain(40, "out");
  Listener heard;
  run(until("out", 0.2, 200), heard);  // 32 members would do
  EXPECT_THAT(heard.counts(), ElementsAre(32, 64));
  EXPECT_EQ(heard.members.size(), 24u);
}

TEST_F(UntilConverged, MembersThatAreComputedAgainForgetTheRule) {
  workflow::EnsembleRequest hurried = until("out", 0.14, 32);
  hurried.scene = scene({"numerics.max_wall_time_s=1e-7"});
  Listener heard;
  run(hurried, heard);
  const workflow::OutputFolder folder{path("out")};
  ASSERT_TRUE(workflow::Manifest::read(folder.manifest()).stop.has_value());
  workflow::EnsembleRequest again = request("out");
  again.members = 32;
  again.retry_failed = true;
  Recorder silent;
  EXPECT_EQ(whole(again, silent).valid, 32);
  EXPECT_FALSE(workflow::Manifest::read(folder.manifest()).stop.has_value());
}

TEST_F(UntilConverged, RefusesDesignsThatCannotGrowAndShards) {
  const auto refusal = [&](const workflow::EnsembleRequest& r) -> std::string {
    Recorder heard;
    try {
      workflow::prepare_ensemble(r, heard);
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "";
  };
  workflow::EnsembleRequest r = until("out", 0.1, 100);
  r.scene = scene({"ensemble.design=latin_hypercube"});
  EXPECT_THAT(refusal(r), HasSubstr("Use sobol or monte_carlo"));
  r.scene = scene({"ensemble.design=morris"});
  EXPECT_THAT(refusal(r), HasSubstr("stand in sets"));
  r = until("out", 0.1, 100);
  r.shard = {1, 2};
  EXPECT_THAT(refusal(r), HasSubstr("a shard sees every n-th"));
  EXPECT_FALSE(exists("out")) << "something was written before it was refused";
}

TEST_F(UntilConverged, APlainEnsembleOfOtherSizeForgetsTheRule) {
  Listener heard;
  run(until("out", 0.14, 200), heard);
  const workflow::OutputFolder folder{path("out")};
  plain(64, "out");
  EXPECT_TRUE(workflow::Manifest::read(folder.manifest()).stop.has_value());
  plain(70, "out");
  EXPECT_FALSE(workflow::Manifest::read(folder.manifest()).stop.has_value());
}

}  // namespace
}  // namespace sturz::test
