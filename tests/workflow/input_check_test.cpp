// SPDX-License-Identifier: Apache-2.0
// Members of two grounds never make one map, whatever part of a raster each of them has read.
#include "ensemble/workflow/folder/input_check.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/gdal/cog.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int n_cols = 700, n_rows = 320;
constexpr double west = 500000.3, north = 4600640.7, cell = 4;

/// A valley that falls to the east and runs out on level ground.
/// \param bump added to what lies east of the column `from`
Raster<double> valley(double steepness, double bump = 0, int from = 0) {
  Raster<double> z(Grid{n_cols, n_rows, west, north, cell, ""});
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) {
      const double x = (c + 0.5) * cell, y = (r + 0.5 - 0.5 * n_rows) * cell;
      z.at(r, c) = std::max(0.0, steepness * (1400 - x)) + 0.0004 * y * y + 0.3 * std::sin(x / 17) +
                   (c >= from ? bump : 0);
    }
  return z;
}

const char* const scene_text = R"(title: valley
terrain: {{raster: dem.tif, crs: EPSG:32633{window}}}
release:
  box: {{x_m: [500400, 500460], y_m: [4599970, 4600030]}}
  thickness_m: 5
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}}
basal:
  friction_coefficient: {{uniform: [0.30, 0.40]}}
numerics: {{spacing_m: 12, accept_unresolved: true}}
ensemble: {{design: sobol, members: 2, seed: 1}}
formulation: depth_averaged
)";

/// Hardly more than the release, and a little more.
const char* const tiny = ", window: {x_m: [500420, 500440], y_m: [4599990, 4600010]}";
const char* const wider = ", window: {x_m: [500300, 500640], y_m: [4599900, 4600110]}";

class Inputs : public Workflow {
 protected:
  void ground(const Raster<double>& z) const { write_geotiff(path("dem.tif"), z, {}); }
  void scene_with(const std::string& window) const {
    write("scene.yaml", fmt::format(fmt::runtime(scene_text), fmt::arg("window", window)));
  }
  static std::string refusal(const std::function<void()>& work) {
    try {
      work();
    } catch (const SetupError& refused) {
      return refused.what();
    }
    return "not refused";
  }
  workflow::EnsembleRequest four(int shard = 0) const {
    workflow::EnsembleRequest more = request("out");
    more.members = 4;
    if (shard > 0) more.shard = {shard, 2};
    return more;
  }
  std::string prepared(const workflow::EnsembleRequest& request) const {
    return refusal([&] {
      Recorder silent;
      workflow::prepare_ensemble(request, silent);
    });
  }
  /// Two members on a valley, whose maps are in `out`.
  void two_members(const std::string& window, double steepness = 0.466) const {
    ground(valley(steepness));
    scene_with(window);
    Recorder silent;
    whole(request("out"), silent);
  }
  workflow::Manifest manifest() const {
    return workflow::Manifest::read(path("out/manifest.json"));
  }
};

const auto other_values = AllOf(HasSubstr("was begun with another scene"),
                                HasSubstr("input terrain.raster = dem.tif: other values than"));

TEST_F(Inputs, AnotherGroundIsRefusedWhateverItsEnergyLineReaches) {
  two_members("", 0.466);
  EXPECT_THAT(prepared(four()), HasSubstr("not refused"));
  for (const double steepness : {0.40, 0.60}) {
    ground(valley(steepness));
    EXPECT_THAT(prepared(four()), other_values) << steepness;
  }
  ground(valley(0.466));
  EXPECT_THAT(prepared(four()), HasSubstr("not refused"));
}

TEST_F(Inputs, AnotherGroundIsRefusedForAnotherWindowByHand) {
  two_members(tiny);
  scene_with(wider);
  EXPECT_THAT(prepared(four()), HasSubstr("not refused")) << "the window is no part of the scene";
  ground(valley(0.50));
  EXPECT_THAT(prepared(four()), other_values);
  scene_with("");
  EXPECT_THAT(prepared(four()), other_values);
}

TEST_F(Inputs, GroundOfTheEnergyLineBeyondAWindowByHandIsKnown) {
  ground(valley(0.466));
  scene_with(tiny);
  Recorder silent;
  workflow::EnsembleRequest none = request("out");
  workflow::prepare_ensemble(none, silent);  // nothing is computed
  ground(valley(0.466, 3, 330));             // the longest time of a run follows from that too
  EXPECT_THAT(prepared(request("out")), other_values);
}

TEST_F(Inputs, GroundThatOnlyAGrownWindowHasReadIsKnown) {
  two_members(tiny);
  const int farthest = n_cols - 200;
  const auto parts = manifest().inputs.front().parts;
  EXPECT_TRUE(parts.contains("0/1")) << "nothing has grown";
  for (const int from : {300, 420}) {
    ground(valley(0.466, 1, from));
    EXPECT_THAT(prepared(four()), other_values) << from;
  }
  ground(valley(0.466, 1, farthest + 150));
  EXPECT_EQ(manifest().inputs.front().parts, parts);
}

TEST_F(Inputs, AShardOnAnotherGroundIsRefused) {
  ground(valley(0.466));
  scene_with(tiny);
  Recorder first, second;
  EXPECT_EQ(run(four(1), first).finished, 2);
  EXPECT_TRUE(manifest().inputs.front().parts.contains("0/1")) << "what it read is not kept";
  ground(valley(0.466, 1, 300));
  EXPECT_THAT(prepared(four(2)), other_values);
  ground(valley(0.60));
  EXPECT_THAT(prepared(four(2)), other_values);
  ground(valley(0.466));
  EXPECT_EQ(run(four(2), second).finished, 2);
  EXPECT_EQ(workflow::merge_members({path("out")}, second).finished, 4);
}

TEST_F(Inputs, AChangeWhileMembersRunStopsTheRun) {
  for (const auto& [what, change] : std::vector<std::pair<std::string, std::function<void()>>>{
           {"other values than before in", [&] { ground(valley(0.47)); }},
           {"no such file", [&] { std::filesystem::remove(path("dem.tif")); }},
           {"has another grid", [&] {
              Raster<double> z = valley(0.466);
              z.grid.west_m += 1;
              ground(z);
            }}}) {
    ground(valley(0.466));
    scene_with(tiny);
    std::filesystem::remove_all(path("out"));
    Recorder heard;
    workflow::EnsembleJob job = workflow::prepare_ensemble(request("out"), heard);
    job.scene.ground =  // describing the scene may have grown it
        std::make_shared<workflow::GrowingGround>(job.scene.scenario, job.scene.inputs);
    change();
    const workflow::MembersRun stopped = workflow::run_ensemble(job, heard, heard.cancel);
    EXPECT_THAT(stopped.stop_error,
                AllOf(HasSubstr("a member needs more of the terrain"), HasSubstr(what)));
    EXPECT_THAT(stopped.failed, IsEmpty());
    EXPECT_EQ(stopped.finished, 0);
    EXPECT_EQ(n_members("out"), 0U) << "a failed member takes the place of one that ran far";
  }
}

TEST_F(Inputs, MapsAreNotMadeOverAnotherGround) {
  two_members("");
  Raster<double> holes = valley(0.466);
  for (int r = 0; r < n_rows; ++r) std::fill_n(&holes.at(r, 200), 40, nan_d);
  Recorder heard;
  for (const Raster<double>& other : {holes, valley(0.60), valley(0.466, 5, 250)}) {
    ground(other);
    EXPECT_THAT(refusal([&] { workflow::merge_members({path("out")}, heard); }),
                AllOf(HasSubstr("computed from other inputs"),
                      HasSubstr("input terrain.raster = ../dem.tif: other values than before")));
  }
  ground(valley(0.466));
  const std::string hash = manifest().hazard_hash;
  EXPECT_EQ(workflow::merge_members({path("out")}, heard).hazard_hash, hash);
}

TEST_F(Inputs, APageOverAnotherGroundHasNoReliefAndSaysSo) {
  two_members("");
  Recorder heard;
  const auto page = [&] {
    heard.warnings.clear();
    workflow::rewrite_page(path("out"), heard);
    return read("out/report.html");
  };
  EXPECT_THAT(page(), Not(HasSubstr("no relief")));
  EXPECT_THAT(heard.warnings, IsEmpty());
  ground(valley(0.60));
  EXPECT_THAT(page(), HasSubstr("the page has no relief"));
  EXPECT_THAT(heard.warnings, Contains(HasSubstr("other values than before")));
  std::filesystem::remove(path("dem.tif"));
  EXPECT_THAT(page(), HasSubstr("a page will have no relief"));
  EXPECT_THAT(heard.warnings, Contains(HasSubstr("the terrain cannot be read")));
  EXPECT_THAT(manifest().warnings, Not(Contains(HasSubstr("relief")))) << "of that page alone";
}

TEST_F(Inputs, AnotherReleaseIsSeenByMergeToo) {
  two_members("");
  Recorder heard;
  workflow::Manifest other = manifest();
  other.inputs.push_back({"release.polygon", "a.gpkg", "1 polygon", {{"features", "00"}}});
  other.write(path("out/manifest.json"));
  EXPECT_THAT(refusal([&] { workflow::merge_members({path("out")}, heard); }),
              HasSubstr("input release.polygon = a.gpkg: is not there any more"));
}

TEST_F(Inputs, ForeignMapsMakeNoPage) {
  two_members("");
  std::filesystem::rename(path("out"), path("first"));
  Recorder heard;
  workflow::EnsembleRequest other = request("out");
  other.scene = scene({"basal.friction_coefficient={uniform: [0.31, 0.40]}"});
  whole(other, heard);
  const auto copied = [&](const char* from, const char* to) {
    std::filesystem::copy_file(path(from), path(to),
                               std::filesystem::copy_options::overwrite_existing);
  };
  workflow::rewrite_page(path("first"), heard);
  copied("first/hazard.nc", "own.nc");
  copied("out/hazard.nc", "first/hazard.nc");
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("first"), heard); }),
              HasSubstr("does not hold the maps that were made of this folder's members"));
  copied("own.nc", "first/hazard.nc");
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("first"), heard); }),
              HasSubstr("not refused"));
}

TEST_F(Inputs, ForeignPeaksMakeNoPageOfARun) {
  ground(valley(0.466));
  scene_with("");
  Recorder heard;
  const auto single = [&](const char* folder, std::vector<std::string> overrides) {
    workflow::RunRequest request;
    request.scene = scene(std::move(overrides));
    request.folder = path(folder);
    request.threads = 1;
    workflow::SingleRun run = workflow::prepare_run(request, heard);
    workflow::store_run(run, workflow::compute_run(run, heard, heard.cancel));
  };
  single("a", {});
  single("b", {"basal.friction_coefficient=0.38"});
  workflow::rewrite_page(path("a"), heard);
  std::filesystem::copy_file(path("b/peaks.nc"), path("a/peaks.nc"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("a"), heard); }),
              HasSubstr("does not hold the maps"));
}

}  // namespace
}  // namespace sturz::test
