// SPDX-License-Identifier: Apache-2.0
// A region: one ensemble for each feature, maps of all, and which source hits a place.
#include "tests/app/app_fixture.hpp"

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>
#include <utility>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A square polygon with a name and a volume.
std::string feature(const std::string& name, double west, double south, double edge,
                    double volume) {
  std::ostringstream text;
  const double east = west + edge, north = south + edge;
  text << R"({"type":"Feature","properties":{"name":")" << name << R"(","vol":)" << volume
       << R"(},"geometry":{"type":"Polygon","coordinates":[[)";
  for (const auto& [x, y] : {std::pair{west, south}, std::pair{east, south}, std::pair{east, north},
                             std::pair{west, north}})
    text << '[' << x << ',' << y << "],";
  text << '[' << west << ',' << south << "]]]}}";
  return text.str();
}

class Region : public App {
 protected:
  Region() {
    write_features(feature("upper", -50, -5, 10, 300) + "," + feature("lower", -44, 0, 8, 100) +
                   "," + feature("aside/2", -30, -22, 6, 60));
    std::string scene = replaced(tiny_scene(), "box: {x_m: [-50, -40], y_m: [-5, 5]}",
                                 "polygon: sources.geojson\n  each_feature: true\n"
                                 "  feature_key: name");
    scene = replaced(scene, "thickness_m: 3", "volume_attribute: vol");
    scene = replaced(scene, "formulation: full_stress", "formulation: depth_averaged");
    write("scene.yaml", replaced(scene, "members: 6", "members: 4"));
  }
  void write_features(const std::string& features) const {
    write("sources.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  }
  Ended ensemble(const std::string& out, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"ensemble", path("scene.yaml"), "-o", path(out), "--json"});
    return sturz(more);
  }
  std::string undisturbed() const {
    const Ended ended = ensemble("undisturbed", {"--workers", "1"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return hazard_hash("undisturbed");
  }
};

TEST_F(Region, HasAnEnsembleForEachFeatureAndMapsOfAll) {
  const Ended ended = ensemble("out");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto done = event(ended, "done");
  EXPECT_EQ(done["sources"], 3);
  EXPECT_EQ(done["valid"], 12);
  EXPECT_EQ(n_members("out/features/upper"), 4u);
  EXPECT_EQ(n_members("out/features/aside%2F2"), 4u);
  for (const char* file :
       {"hazard.nc", "sources.csv", "report.html", "hazard.qgz", "hazard.gpkg", "ground.tif",
        "hazard/most_likely_source.tif", "hazard/energy_largest_p50_kJ_m2.tif"})
    EXPECT_TRUE(exists(std::string("out/") + file)) << file;
  EXPECT_THAT(read("out/sources.csv"),
              AllOf(HasSubstr("\n1,upper,features/upper,4,4,4,"), HasSubstr("\n3,aside/2,")));
  EXPECT_EQ(read("out/features/upper/design.csv"), read("out/features/lower/design.csv"))
      << "all sources share their rows";
  EXPECT_THAT(read("out/stac_item.json"), HasSubstr("Maps of 12 simulations"));
  EXPECT_EQ(hazard_hash("out"), undisturbed()) << "one worker";
}

TEST_F(Region, ASourceIsAnOrdinaryEnsemble) {
  ASSERT_EQ(ensemble("out").exit_code, 0);
  ASSERT_EQ(sturz({"merge", path("out/features/lower")}).exit_code, 0);
  const Ended alone =
      ensemble("alone", {"--set", "release.each_feature=false", "--set", "release.feature=lower"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(hazard_hash("out/features/lower"), hazard_hash("alone"));
  EXPECT_NE(read("out/features/lower/members/000001.nc"),
            read("out/features/upper/members/000001.nc"));
}

/// The same members, each source a job of its own.
TEST_F(Region, ABatchOfEachFeatureComputesTheSame) {
  ASSERT_EQ(ensemble("out").exit_code, 0);
  ASSERT_EQ(sturz({"merge", path("out/features/lower")}).exit_code, 0);
  write("list.yaml", "jobs: [{name: s, scenario: scene.yaml, features: each}]\n");
  const Ended ended = sturz({"batch", path("list.yaml"), "-o", path("batch")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("3 jobs: 3 computed"));
  EXPECT_EQ(hazard_hash("batch/s.lower"), hazard_hash("out/features/lower"));
  EXPECT_TRUE(exists("batch/s.aside%2F2/report.html"));
}

TEST_F(Region, ShardsAndMergeEqualOneRun) {
  for (const char* shard : {"2/2", "1/2"}) {
    const Ended ended = ensemble("out", {"--shard", shard});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_FALSE(exists("out/hazard.nc")) << "a shard made maps";
  }
  const Ended merged = sturz({"merge", path("out")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(hazard_hash("out"), undisturbed());
}

TEST_F(Region, MergeSaysWhichSourcesAreNotThereYet) {
  ASSERT_EQ(ensemble("out", {"--shard", "1/2"}).exit_code, 0);
  const Ended refused = sturz({"merge", path("out")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("source lower: nothing of it was computed"));
  EXPECT_FALSE(exists("out/hazard.nc"));
  const Ended partial = sturz({"merge", path("out"), "--partial"});
  EXPECT_EQ(partial.exit_code, 0) << partial.err;
}

TEST_F(Region, AfterKillNineAndDamageTheSameMapsCome) {
  Process process(command({"ensemble", path("scene.yaml"), "-o", path("out"), "--workers", "1"}),
                  path(""), environment());
  while (process.running() && n_members("out/features/upper") < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  EXPECT_EQ(n_members("out/features/aside%2F2"), 0u) << "killed too late to show anything";
  write("out/features/upper/members/000000.nc", "cut short");
  const Ended again = ensemble("out");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("000000.nc"));
  EXPECT_EQ(hazard_hash("out"), undisturbed());
  const Ended third = ensemble("out");
  ASSERT_EQ(third.exit_code, 0) << third.err;
  for (const auto& e : events(third)) EXPECT_NE(e["event"], "member") << "all were there";
}

/// Of an old file it is known that it was not written again.
void age(const std::string& file) {
  namespace fs = std::filesystem;
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
}

TEST_F(Region, WhatIsFinishedIsNotLoadedAgain) {
  for (const char* file : {"scene.yaml", "sources.geojson"}) age(path(file));
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // ctime cannot be set
  ASSERT_EQ(ensemble("out").exit_code, 0);
  const std::string manifest = read("out/features/upper/manifest.json"), hash = hazard_hash("out");
  const Ended again = ensemble("out");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(read("out/features/upper/manifest.json"), manifest) << "who loads a source writes it";
  EXPECT_EQ(hazard_hash("out"), hash);

  write("out/features/upper/members/000002.nc", "cut short");
  const Ended mended = ensemble("out");
  ASSERT_EQ(mended.exit_code, 0) << mended.err;
  EXPECT_THAT(mended.err + mended.out, HasSubstr("000002.nc"));
  EXPECT_EQ(hazard_hash("out"), hash);

  std::filesystem::remove(path("out/features/lower/members/000001.nc"));
  ASSERT_EQ(ensemble("out").exit_code, 0);
  EXPECT_EQ(n_members("out/features/lower"), 4u);
  EXPECT_EQ(hazard_hash("out"), hash);

  const std::string before = read("out/features/upper/manifest.json");
  write("sources.geojson", read("sources.geojson"));  // touched: every source is looked at
  ASSERT_EQ(ensemble("out").exit_code, 0);
  EXPECT_NE(read("out/features/upper/manifest.json"), before);
}

TEST_F(Region, MembersInPacksMakeTheSameMaps) {
  const Ended packed = ensemble("packed", {"--packs"});
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  EXPECT_TRUE(exists("packed/features/upper/members/1_of_1.001.pack"));
  EXPECT_EQ(hazard_hash("packed"), undisturbed());
}

TEST_F(Region, AFeatureOffTheGroundIsRecordedAndTheOthersGoOn) {
  write_features(feature("upper", -50, -5, 10, 300) + "," + feature("far", 500, 0, 8, 100));
  const Ended ended = ensemble("out", {"--set", "ensemble.max_failed_fraction=0.6"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(event(ended, "done")["failed_sources"], 1);
  EXPECT_THAT(event(ended, "source_failed")["reason"].get<std::string>(),
              AllOf(HasSubstr("scene.yaml:"), HasSubstr("outside the terrain")));
  EXPECT_THAT(read("out/sources.csv"), HasSubstr("\n2,far,features/far,4,0,0,0,"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("1 of 2 sources could not be computed"));
  EXPECT_EQ(ensemble("out").exit_code, 2) << "half of the members are more than the accepted 5 %";
  write_features(feature("upper", -50, -5, 10, 300) + "," + feature("far", -30, 0, 8, 100));
  const Ended mended = ensemble("out");
  EXPECT_EQ(mended.exit_code, 0) << mended.err;
  EXPECT_EQ(event(mended, "done")["failed_sources"], 0);
}

TEST_F(Region, AChangedPolygonStopsTheRun) {
  ASSERT_EQ(ensemble("out").exit_code, 0);
  write_features(feature("upper", -49, -5, 10, 300) + "," + feature("lower", -44, 0, 8, 100));
  const Ended ended = ensemble("out");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("source upper"), HasSubstr("other polygons")));
}

TEST_F(Region, APlaceKnowsItsSources) {
  ASSERT_EQ(ensemble("out").exit_code, 0);
  const Ended both = sturz({"sources", path("out"), "--at", "-41,3", "--json"});
  ASSERT_EQ(both.exit_code, 0) << both.err;
  const auto found = event(both, "sources");
  ASSERT_EQ(found["sources"].size(), 2u) << "upper starts there and lower too";
  EXPECT_EQ(found["sources"][0]["probability"], 1.0);
  EXPECT_EQ(found["values"]["number_of_sources"], 2.0);
  EXPECT_EQ(found["values"]["probability_of_any_hit"], 1.0);
  const Ended beyond = sturz({"sources", path("out"), "--at", "5000,3"});
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_THAT(beyond.err, HasSubstr("lies beyond the maps"));
  EXPECT_EQ(sturz({"sources", path("out"), "--at", "5000"}).exit_code, 1);
}

TEST_F(Region, IsDescribedAndIsNoSingleScene) {
  const Ended described = sturz({"describe", path("scene.yaml")});
  ASSERT_EQ(described.exit_code, 0) << described.err;
  EXPECT_THAT(described.out, HasSubstr("region: 3 sources, 4 members each, 12 in all"));
  const Ended run = sturz({"run", path("scene.yaml"), "-o", path("run")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("scene.yaml:6:"), HasSubstr("release.each_feature")));
  EXPECT_FALSE(exists("run"));
}

TEST_F(Region, FeaturesNeedNamesOfTheirOwn) {
  write_features(feature("a", -50, -5, 10, 300) + "," + feature("a", -44, 0, 8, 100));
  const Ended ended = ensemble("out");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("features 0 and 1 of release.polygon"));
  EXPECT_THAT(ended.err, Not(HasSubstr("terminate")));
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace sturz::test
