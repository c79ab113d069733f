// SPDX-License-Identifier: Apache-2.0
// Multilevel ensembles: what they write, that they go on to the same bits, what they refuse.
#include "engine/core/error.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/workflow/multilevel/multilevel_results.hpp"
#include "ensemble/workflow/multilevel/multilevel_words.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using workflow::MultilevelMade;

class Multilevel : public Workflow {
 protected:
  /// Columns that come to rest, so that every result is known.
  Multilevel() {
    std::string text = read("scene.yaml");
    text = replaced(text, "{uniform: [0.3, 0.7]}", "{uniform: [0.7, 0.9]}");
    text = replaced(text, "{uniform: [0.0, 0.3]}", "{uniform: [0.0, 0.05]}");
    write("scene.yaml", replaced(text, "end_time_s: 3", "end_time_s: 30"));
  }
  workflow::EnsembleRequest asked(const std::string& results, const std::string& error = "0.15") {
    workflow::EnsembleRequest r = request(results);
    r.scene.overrides.insert(
        r.scene.overrides.end(),
        {"ensemble.estimator=multilevel", "ensemble.target.relative_error=" + error,
         "ensemble.levels=depth_averaged 2, depth_averaged 4", "ensemble.pilot=8"});
    return r;
  }
  struct Ended {
    bool interrupted = false;
    MultilevelMade made;
    workflow::StoredPlan plan;
    std::vector<std::int64_t> members;
  };
  static Ended run(const workflow::EnsembleRequest& request, Recorder& heard) {
    workflow::MultilevelJob job = workflow::prepare_multilevel(request, heard);
    workflow::PlanListener silent;
    Ended ended;
    try {
      const workflow::MultilevelMembers found =
          workflow::run_multilevel(job, heard, silent, heard.cancel);
      ended.made = workflow::look_at_members(job, found, {});
      workflow::write_multilevel_files(job, found, ended.made, {});
      ended.members = found.planned;
    } catch (const Cancelled&) {
      ended.interrupted = true;
    }
    ended.plan = job.plan;
    return ended;
  }
  std::uint64_t maps_of(const std::string& results) const {
    return hash_of(read_layers(path(results) / "hazard.nc"));
  }
  void copy_plan(const std::string& from, const std::string& to) const {
    std::filesystem::create_directories(path(to));
    std::filesystem::copy_file(path(from) / "multilevel_plan.json",
                               path(to) / "multilevel_plan.json");
  }
};

TEST_F(Multilevel, ReachesWhatWasAskedForAndSaysSo) {
  Recorder heard;
  const Ended ended = run(asked("out"), heard);
  ASSERT_FALSE(ended.interrupted);
  const MultilevelMade& made = ended.made;
  ASSERT_GT(made.headlines.size(), 2U);
  EXPECT_EQ(made.headlines[0].name, "runout_m");
  EXPECT_THAT(made.missed, ::testing::IsEmpty());
  EXPECT_GT(made.used.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    const workflow::MultilevelHeadline& h = made.headlines[i];
    EXPECT_LT(h.sampling, 1.05 * 0.15 * h.scalar.mean.mean) << h.name;
    EXPECT_GE(h.resolution, 0) << h.name;
    EXPECT_TRUE(std::isnan(h.model)) << h.name;  // one formulation
    double shares = 0;
    for (const workflow::LevelShare& l : made.levels)
      if (l.used) shares += l.variance_shares[i];
    EXPECT_NEAR(shares, 1, 1e-9) << h.name;
  }
  for (const char* file : {"multilevel.json", "multilevel_plan.json", "hazard.nc", "report.html",
                           "levels/depth_averaged_1m/members"})
    EXPECT_TRUE(exists(std::string("out/") + file)) << file;
  const LayerStack maps = read_layers(path("out") / "hazard.nc");
  for (const char* name : {"probability_of_reach", "probability_of_reach_lower",
                           "thickness_exceedance", "speed_exceedance_upper"}) {
    const Layer* layer = maps.find(name);
    ASSERT_NE(layer, nullptr) << name;
    const bool upper = std::string(name).ends_with("_upper");
    for (const float p : layer->values)
      EXPECT_TRUE((p >= 0 && p <= 1) || (upper && std::isnan(p))) << name;
  }
  EXPECT_THAT(maps.find("probability_of_reach_lower")->comment, HasSubstr("90 % bounds"));
}

/// With two levels, whatever the seconds of this machine would choose.
TEST_F(Multilevel, TellsNoUpperBoundWhereNumbersAloneSpeak) {
  Recorder heard;
  workflow::MultilevelJob job = workflow::prepare_multilevel(asked("out", "0.4"), heard);
  workflow::PlanListener silent;
  const workflow::MultilevelMembers found =
      workflow::run_multilevel(job, heard, silent, heard.cancel);
  job.plan.rounds.back().plan.levels = {0, 1};
  const MultilevelMade made = workflow::look_at_members(job, found, {});
  workflow::write_multilevel_files(job, found, made, {});
  const LayerStack maps = read_layers(path("out") / "hazard.nc");
  const Layer *reach = maps.find("probability_of_reach"),
              *upper = maps.find("probability_of_reach_upper");
  ASSERT_TRUE(reach != nullptr && upper != nullptr);
  std::size_t untold = 0;
  for (std::size_t i = 0; i < reach->values.size(); ++i) {
    untold += std::isnan(upper->values[i]) ? 1 : 0;
    EXPECT_TRUE(reach->values[i] == 0 || upper->values[i] >= reach->values[i]) << i;
  }
  EXPECT_GT(untold, 0U);
  EXPECT_LT(untold, reach->values.size());
  EXPECT_THAT(upper->comment, HasSubstr("no value where it is not told"));
  // Fewer than 59 dear members: the outer quantiles have no outer bounds.
  ASSERT_LT(made.dear_draws, 59U);
  EXPECT_THAT(workflow::multilevel_json_text(made), HasSubstr("\"draws_needed\": 59"));
  EXPECT_THAT(workflow::page_sentences(made),
              ::testing::Contains(HasSubstr("No upper bound of the 95 % quantile: ")));
  EXPECT_THAT(read("out/report.html"), HasSubstr("No colour: not told, which is not 0"));
}

TEST_F(Multilevel, GoesOnToTheSameBitsWhereverItWasStopped) {
  Recorder undisturbed;
  const Ended whole = run(asked("whole"), undisturbed);
  const std::uint64_t maps = maps_of("whole");
  // The plan rests on seconds, which no two runs share; from there on everything is the members'.
  copy_plan("whole", "cut");
  for (const std::size_t stop : {3U, 11U, 12U}) {
    Recorder heard;
    heard.cancel_after = stop;
    EXPECT_TRUE(run(asked("cut"), heard).interrupted);
  }
  Recorder heard;
  const Ended ended = run(asked("cut"), heard);
  ASSERT_FALSE(ended.interrupted);
  EXPECT_EQ(ended.members, whole.members);
  EXPECT_EQ(maps_of("cut"), maps);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(ended.made.headlines[i].scalar.mean.mean, whole.made.headlines[i].scalar.mean.mean);
  // Once more computes nothing, and decides nothing anew.
  Recorder again;
  EXPECT_EQ(run(asked("cut"), again).plan.rounds.size(), whole.plan.rounds.size());
  EXPECT_TRUE(again.members.empty());
}

TEST_F(Multilevel, AsksForMoreWhereTheTargetIsSmaller) {
  Recorder heard;
  const Ended rough = run(asked("out", "0.4"), heard);
  const Ended fine = run(asked("out", "0.15"), heard);
  EXPECT_GT(fine.plan.rounds.size(), rough.plan.rounds.size());
  EXPECT_LT(fine.made.headlines[0].sampling, rough.made.headlines[0].sampling);
}

TEST_F(Multilevel, KeepsPlainSamplingWhereCheaperLevelsCostMore) {
  workflow::EnsembleRequest r = asked("out", "0.3");
  r.scene.overrides.emplace_back("ensemble.levels=depth_averaged 0.8");
  r.scene.overrides.emplace_back("numerics.spacing_m=2");
  Recorder heard;
  const Ended ended = run(r, heard);
  EXPECT_EQ(ended.made.used, std::vector<std::size_t>{0});
  EXPECT_TRUE(ended.made.maps.empty());
  EXPECT_NE(read_layers(path("out") / "hazard.nc").find("thickness_quantile"), nullptr);
}

TEST_F(Multilevel, SaysWhyItKeptPlainSampling) {
  workflow::EnsembleRequest poor = asked("poor");
  std::erase_if(poor.scene.overrides,
                [](const std::string& o) { return o.starts_with("ensemble.target."); });
  poor.scene.overrides.emplace_back("ensemble.target.core_hours=1e-7");
  Recorder heard;
  const Ended spent = run(poor, heard);
  EXPECT_EQ(spent.made.used, std::vector<std::size_t>{0});
  EXPECT_THAT(workflow::gain_text(spent.made), HasSubstr("The pilots took"));
  EXPECT_THAT(spent.made.missed, ::testing::Contains(HasSubstr("Not kept: all members took")));
  const Ended easy = run(asked("easy", "1"), heard);
  EXPECT_THAT(workflow::gain_text(easy.made), HasSubstr("Its pilot alone reaches the target"));
  EXPECT_THAT(easy.made.missed, ::testing::IsEmpty());
}

TEST(MultilevelWords, NameTheLevelThatTheModelsNumberIsADifferenceTo) {
  MultilevelMade made;
  EXPECT_EQ(workflow::model_text(made), "");
  workflow::MultilevelHeadline& h = made.headlines.emplace_back();
  h.name = "runout_m", h.model = 20, h.model_error = 2, h.model_of = "depth_averaged_9m";
  EXPECT_EQ(workflow::model_text(made),
            "Model: how far the mean of depth_averaged_9m lies away with the same draws, 20 of "
            "runout_m +- 3.3 (90 %). What the two spacings differ by is part of it.");
}

TEST_F(Multilevel, SaysWhatIsWrongBeforeItComputes) {
  const auto refusal = [&](const std::string& set, const std::vector<std::string>& without = {}) {
    workflow::EnsembleRequest r = asked("out");
    for (const std::string& key : without)
      std::erase_if(r.scene.overrides,
                    [&](const std::string& o) { return o.starts_with(key + "="); });
    if (!set.empty()) r.scene.overrides.push_back(set);
    Recorder heard;
    try {
      workflow::prepare_multilevel(r, heard);
    } catch (const SetupError& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("", {"ensemble.target.relative_error"}),
              HasSubstr("Give relative_error, map_error or core_hours"));
  EXPECT_THAT(refusal("", {"ensemble.estimator"}), HasSubstr("ensemble.estimator (missing"));
  EXPECT_THAT(refusal("ensemble.target.core_hours=1"), HasSubstr("Keep the one or the other"));
  EXPECT_THAT(refusal("ensemble.levels=columns 4"), HasSubstr("no formulation of that name"));
  EXPECT_THAT(refusal("ensemble.levels=depth_averaged"), HasSubstr("no spacing"));
  EXPECT_THAT(refusal("ensemble.levels=depth_averaged 1"), HasSubstr("the scene's own"));
  EXPECT_THAT(refusal("ensemble.design=morris"), HasSubstr("monte_carlo"));
  EXPECT_FALSE(exists("out"));
}

TEST_F(Multilevel, SaysWhatItDidNotReach) {
  Recorder heard;
  workflow::MultilevelJob job = workflow::prepare_multilevel(asked("out", "0.3"), heard);
  workflow::PlanListener silent;
  const workflow::MultilevelMembers found =
      workflow::run_multilevel(job, heard, silent, heard.cancel);
  EXPECT_THAT(workflow::look_at_members(job, found, {}).missed, ::testing::IsEmpty());
  job.scene.scenario.ensemble.target = TargetSpec{1e-6, 1e-6, 0};
  const MultilevelMade made = workflow::look_at_members(job, found, {});
  ASSERT_EQ(made.missed.size(), 4U);
  EXPECT_THAT(made.missed.front(), HasSubstr("Not reached: 90 % bounds of the mean of runout_m"));
  EXPECT_THAT(made.missed.back(), HasSubstr("standard error of P(reached)"));
  EXPECT_THAT(workflow::multilevel_json_text(made), HasSubstr("Not reached"));
}

/// As plain ensembles: too many members whose end was not seen are said first, wherever one reads.
TEST_F(Multilevel, SaysFirstThatTooManyMembersAreCutOff) {
  workflow::EnsembleRequest r = asked("out");
  std::erase(r.scene.overrides, "ensemble.target.relative_error=0.15");
  r.scene.overrides.insert(r.scene.overrides.end(),
                           {"ensemble.target.map_error=0.4", "numerics.end_time_s=2"});
  Recorder heard;
  const MultilevelMade made = run(r, heard).made;
  ASSERT_FALSE(made.cut_off.empty());
  EXPECT_THAT(made.cut_off.front(), HasSubstr("ensemble.max_censored_fraction = 0.05"));
  EXPECT_TRUE(made.levels.front().censoring.too_many());
  EXPECT_GT(made.censored, 0);
  EXPECT_EQ(workflow::page_sentences(made).front(), made.cut_off.front());
  EXPECT_THAT(workflow::multilevel_json_text(made), HasSubstr("\"too_many_censored\": true"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("are cut off (8 out of time)"));
}

/// Beside plain members of the dearest level: a field around the release that all hit, a hut uphill
/// where none comes.
TEST_F(Multilevel, TellsWhatAssetsExpect) {
  write("assets.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"id": "field"},
     "geometry": {"type": "Point", "coordinates": [-44, 0]}},
    {"type": "Feature", "properties": {"id": "hut"},
     "geometry": {"type": "Point", "coordinates": [-57, 20]}}]})");
  write("scene.yaml",
        read("scene.yaml") + "assets: {features: assets.geojson, name_attribute: id}\n");
  Recorder heard;
  MultilevelMade made;
  {
    workflow::MultilevelJob job = workflow::prepare_multilevel(asked("out", "0.3"), heard);
    workflow::PlanListener silent;
    const auto found = workflow::run_multilevel(job, heard, silent, heard.cancel);
    job.plan.rounds.back().plan.levels = {0, 1};  // whatever the seconds said
    made = workflow::look_at_members(job, found, {});
    workflow::write_multilevel_files(job, found, made, {});
  }
  ASSERT_EQ(made.used.size(), 2U);
  ASSERT_EQ(made.risk.table.rows.size(), 2U);
  const AssetRisk &field = made.risk.table.rows[0], &hut = made.risk.table.rows[1];
  EXPECT_EQ(field.probability, 1);
  EXPECT_LT(field.bounds_90.lower, 1);
  EXPECT_EQ(hut.probability, 0);
  EXPECT_GE(hut.bounds_90.upper,
            1 - std::pow(0.05, 1 / static_cast<double>(made.dear_draws)) - 1e-9);
  EXPECT_THAT(read("out/assets.csv"), HasSubstr("\nfield,inside,"));
  EXPECT_THAT(read("out/assets.csv"), HasSubstr(",multilevel\n"));
  EXPECT_TRUE(exists("out/assets.gpkg"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"assets\">"));
  EXPECT_THAT(workflow::multilevel_json_text(made), HasSubstr("\"name\": \"hut\""));
  // The same members alone, as plain ensembles have them.
  const std::string level = "out/levels/depth_averaged_1m";
  workflow::merge_members({path(level), false}, heard, heard.cancel);
  const std::string plain = read(level + "/assets.csv");
  const auto n = std::to_string(made.levels.front().valid);
  EXPECT_THAT(plain, HasSubstr("\nfield,inside," + n + "," + n + ",0,0,1,"));
  // Only draws that the cheaper level has, too: here it may have fewer.
  const auto both = std::to_string(made.dear_draws);
  EXPECT_THAT(read("out/assets.csv"), HasSubstr("\nfield,inside," + both + "," + both + ",0,0,1,"));
}

TEST_F(Multilevel, SaysThatItsPlanIsDamaged) {
  Recorder heard;
  run(asked("out", "0.3"), heard);
  write("out/multilevel_plan.json", "{\"levels\": [");
  try {
    workflow::prepare_multilevel(asked("out", "0.3"), heard);
    FAIL();
  } catch (const SetupError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("Remove it"));
  }
}

}  // namespace
}  // namespace sturz::test
