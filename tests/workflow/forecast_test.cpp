// SPDX-License-Identifier: Apache-2.0
// What is said of seconds, bytes and memory before anything is computed, held against what it was.
#include "ensemble/workflow/forecast/forecast.hpp"

#include "ensemble/workflow/folder/saved_design.hpp"
#include "ensemble/workflow/forecast/ensemble_forecast.hpp"
#include "ensemble/workflow/forecast/trial.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>
#include <cstdlib>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using workflow::Forecast;
using workflow::Range;

class Forecasts : public Workflow {
 protected:
  Forecast said(std::vector<std::string> overrides) const {
    const workflow::SceneRequest request = scene(std::move(overrides));
    const workflow::Scene loaded = workflow::load_scene(request);
    const DesignTable design = workflow::new_design(loaded.scenario);
    workflow::ForecastRequest ask;
    ask.design = &design;
    ask.members = design.n_members();
    ask.speed_cache = request.speed_cache;
    return workflow::forecast(loaded, ask);
  }
  workflow::Trial tried(const std::vector<std::string>& overrides, double budget_s) const {
    const workflow::Scene loaded = workflow::load_scene(scene(overrides));
    return workflow::try_members(loaded, nullptr, {1, budget_s});
  }
  double steps_of_run(const std::vector<std::string>& overrides) {
    workflow::RunRequest request;
    request.scene = scene(overrides);
    request.folder = path("run");
    request.threads = 1;
    request.replace = true;
    Recorder recorder;
    const workflow::SingleRun run = workflow::prepare_run(request, recorder);
    return workflow::compute_run(run, recorder, recorder.cancel).scalars.n_steps;
  }
};

TEST(Ranges, AddAndScale) {
  const Range sum = Range::within(10, 2) + Range{1, 0, 3} * 2;
  EXPECT_EQ(sum.likely, 12);
  EXPECT_EQ(sum.low, 5);
  EXPECT_EQ(sum.high, 26);
}

TEST(ForecastText, SaysARange) {
  EXPECT_EQ(workflow::seconds_text({12, 8, 18.2}), "12 s (8.0 s to 18 s)");
  EXPECT_EQ(workflow::seconds_text({0.04, 0.032, 0.05}), "0.04 s (0.032 s to 0.05 s)");
  EXPECT_EQ(workflow::bytes_text({12e6, 850e3, 1.25e9}), "12 MB (850 kB to 1.2 GB)");
}

TEST_F(Forecasts, ASceneThatIsTriedItselfTakesTheStepsThatItTakes) {
  const workflow::Trial trial = tried({}, 5);
  ASSERT_TRUE(trial.median);
  EXPECT_EQ(trial.coarser, 1);
  EXPECT_EQ(trial.median->steps, steps_of_run({}));
}

// Both stop at rest, long before the energy line's end: what the description alone cannot know.
TEST_F(Forecasts, StepsOfALongMemberAreThoseOfACoarserOne) {
  for (const std::vector<std::string>& scene :
       {std::vector<std::string>{"numerics.end_time_s=null", "numerics.spacing_m=0.2"},
        std::vector<std::string>{"numerics.end_time_s=null", "formulation=full_stress",
                                 "numerics.spacing_m=0.6", "numerics.accept_unresolved=true"}}) {
    const workflow::Trial trial = tried(scene, 0.2);
    ASSERT_TRUE(trial.median) << scene.back();
    EXPECT_GT(trial.coarser, 1.2) << scene.back();
    const double steps = steps_of_run(scene);
    EXPECT_LT(std::abs(std::log(trial.median->steps / steps)), std::log(1.5))
        << scene.back() << ": " << trial.median->steps << " said, " << steps << " taken";
  }
}

TEST_F(Forecasts, FilesAndMapsAreAsLargeAsSaid) {
  const Forecast f = said({"ensemble.members=12"});
  EXPECT_TRUE(f.tried);
  EXPECT_EQ(f.tried_members, 12);
  workflow::EnsembleRequest ensemble = request("out");
  ensemble.members = 12;
  Recorder recorder;
  whole(ensemble, recorder);
  const auto bytes = [&](const std::string& folder) {
    double sum = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(path(folder)))
      if (file.is_regular_file()) sum += static_cast<double>(file.file_size());
    return sum;
  };
  const double members = bytes("out/members");
  EXPECT_GT(members, f.members_disk_bytes.low);
  EXPECT_LT(members, f.members_disk_bytes.high);
  const double maps = bytes("out") - members;
  EXPECT_GT(maps, f.maps_disk_bytes.low);
  EXPECT_LT(maps, f.maps_disk_bytes.high);
}

TEST_F(Forecasts, GrowWithMembersAndCells) {
  const Forecast few = said({"ensemble.members=8"}), many = said({"ensemble.members=800"});
  EXPECT_NEAR(many.members_disk_bytes.likely / few.members_disk_bytes.likely, 100, 10);
  EXPECT_GT(many.members_s.likely, 30 * few.members_s.likely);
  EXPECT_GT(many.maps_s.likely, 3 * few.maps_s.likely);
  const Forecast fine = said({"ensemble.members=8", "hazard.cell_size_m=0.25"});
  EXPECT_GT(fine.maps_disk_bytes.likely, 2 * few.maps_disk_bytes.likely);
  EXPECT_GT(fine.maps_s.likely, few.maps_s.likely);
  for (const Forecast* f : {&few, &many, &fine})
    for (const Range& r : {f->median_s, f->members_s, f->maps_s, f->total_s, f->elapsed_s,
                           f->memory_bytes, f->members_disk_bytes, f->maps_disk_bytes}) {
      EXPECT_GT(r.low, 0);
      EXPECT_LE(r.low, r.likely);
      EXPECT_LT(r.likely, r.high);
    }
}

// "At most 0.7 s" was said of 10,000 members that took 17 minutes, in files of their own. In packs
// 5,000 took 10 s of computing time with trial, maps and page, 3 s of it their own.
TEST_F(Forecasts, ManyTinyMembersAreNotForNothing) {
  const Forecast f = said({"ensemble.members=10000"});
  EXPECT_GT(f.members_s.likely, 10000 * 0.0006);
  EXPECT_GT(f.maps_s.likely, 10000 * 0.0001);
  EXPECT_GT(f.elapsed_s.high, 30);
}

TEST_F(Forecasts, ASceneTooLongToTrySaysSo) {
  workflow::Scene loaded = workflow::load_scene(scene());
  loaded.description.n_particles = 100;  // no coarser twin of so few
  loaded.description.predicted_seconds = 1e5;
  std::atomic<bool> stop{true};
  EXPECT_THROW(workflow::try_members(loaded, nullptr, {1, 1, stop}), Cancelled);
  Forecast untried;
  untried.median_s = Range::within(1e5, 4);
  untried.members = 5;
  untried.members_s = untried.median_s * 5;
  const auto lines = workflow::forecast_lines(untried);
  EXPECT_THAT(lines[0], AllOf(HasSubstr("27 h"), HasSubstr("no member could be tried")));
  EXPECT_THAT(lines[3], HasSubstr("not known"));
}

/// Members that end at once beside one that never does, tried for a tenth of what that takes.
class CutOff : public Forecasts {
 protected:
  static constexpr const char* lasts = "numerics.end_time_s=2000";
  CutOff() {
    write("table.csv", "basal.friction_coefficient\n0.9\n0.9\n0.3\n0.9\n");
    write("scene.yaml", R"(title: some stick, one goes round and round
terrain: {synthetic: {plane: {cell_size_m: 2, slope_deg: 20, length_m: 40, width_m: 40}}}
release: {box: {x_m: [-20, 20], y_m: [-20, 20]}, thickness_m: 1}
grains: {density_kg_m3: 2600, solid_fraction: 0.6}
basal: {friction_coefficient: {uniform: [0.2, 1]}, viscosity_pa_s: 2000}
domain: {periodic: [x, y]}
numerics: {spacing_m: 2, accept_unresolved: true}
ensemble: {design: table, table: table.csv}
formulation: depth_averaged
)");
  }
};

TEST_F(CutOff, AMemberThatIsNotAtItsEndCountsAsFarAsItCame) {
  const workflow::Scene loaded = workflow::load_scene(scene({lasts}));
  const DesignTable design = workflow::new_design(loaded.scenario);
  workflow::TrialLimits limits{1, 1, {}};
  limits.longest_s = 0.2;
  const workflow::Trial trial = workflow::try_members(loaded, &design, limits);
  ASSERT_TRUE(trial.median);
  ASSERT_EQ(trial.members.size(), 4U) << "none is left out";
  const workflow::TriedMember &stuck = trial.members[0], &runs = trial.members[2];
  EXPECT_EQ(stuck.longer, 1);
  EXPECT_GT(runs.longer, 1.5);
  EXPECT_GE(runs.cpu_s, 0.2);
}

TEST_F(CutOff, TheForecastHoldsIt) {
  const workflow::SceneRequest request = scene({lasts});
  const workflow::Scene loaded = workflow::load_scene(request);
  const DesignTable design = workflow::new_design(loaded.scenario);
  workflow::ForecastRequest ask;
  ask.design = &design, ask.members = design.n_members();
  ask.speed_cache = request.speed_cache;
  ask.longest_try_s = 0.2;
  const Forecast f = workflow::forecast(loaded, ask);
  EXPECT_EQ(f.cut_off_members, 1);
  EXPECT_THAT(workflow::forecast_lines(f)[0], HasSubstr("1 of them cut off"));
  // As in the ensemble: whatever it takes.
  workflow::TrialLimits limits{1, 1, {}};
  limits.longest_s = 1e9;
  double took_s = 0;
  for (const workflow::TriedMember& m : workflow::try_members(loaded, &design, limits).members)
    took_s += m.cpu_s;
  EXPECT_GT(took_s, f.members_s.low);
  EXPECT_LT(took_s, f.members_s.high);
}

TEST_F(Forecasts, WithoutATemporaryFolderNothingIsTriedAndWhySaid) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  const workflow::Scene loaded = workflow::load_scene(scene());
  ::setenv("TMPDIR", path("is/not/there").c_str(), 1);
  const Forecast f = workflow::forecast(loaded, {});
  if (before)
    ::setenv("TMPDIR", kept.c_str(), 1);
  else
    ::unsetenv("TMPDIR");
  EXPECT_FALSE(f.tried);
  EXPECT_NEAR(f.median_s.high / f.median_s.likely, 4, 1e-9);
  EXPECT_THAT(workflow::forecast_lines(f)[0],
              HasSubstr("no member could be tried: there is no folder for temporary files"));
}

TEST_F(Forecasts, AnEnsembleIsLookedAtOnlyWhereItPays) {
  Recorder recorder;
  workflow::EnsembleRequest small = request("small");
  workflow::EnsembleJob job = workflow::prepare_ensemble(small, recorder);
  EXPECT_FALSE(workflow::forecast_of(job, small.scene.speed_cache, 0.1, recorder));
  workflow::EnsembleRequest large = request("large");
  large.members = 2000;
  job = workflow::prepare_ensemble(large, recorder);
  const auto f = workflow::forecast_of(job, large.scene.speed_cache, 0.1, recorder);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->members, 2000);
  EXPECT_EQ(job.scene.description.predicted_seconds, f->member_s.likely);
}

}  // namespace
}  // namespace sturz::test
