// SPDX-License-Identifier: Apache-2.0
// Members that come near the end of what was read of a raster: computed again on more of it, with
// the bits of the whole.
#include "ensemble/workflow/members/growing_ground.hpp"

#include "engine/core/error.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "io/gdal/cog.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

constexpr int n_cols = 700, n_rows = 320;
constexpr double west = 500000.3, north = 4600640.7, cell = 4;

/// A slope of 25 degrees to the east that runs out on level ground, with ripples.
Raster<double> valley() {
  Raster<double> z(Grid{n_cols, n_rows, west, north, cell, ""});
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c) {
      const double x = (c + 0.5) * cell, y = (r + 0.5 - 0.5 * n_rows) * cell;
      z.at(r, c) = std::max(0.0, 0.466 * (1400 - x)) + 0.0002 * y * y + 0.3 * std::sin(x / 17) +
                   0.2 * std::cos(y / 11);
    }
  return z;
}

const char* const scene_text = R"(title: slope
terrain: {{raster: dem.tif, crs: EPSG:32633{window}}}
release:
  box: {{x_m: [500400, 500460], y_m: [4599970, 4600030]}}
  thickness_m: 5
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}}
basal:
  friction_coefficient: {{uniform: [0.25, 0.35]}}
numerics: {{spacing_m: {spacing}, accept_unresolved: true}}
ensemble: {{design: sobol, members: 3, seed: 1}}
formulation: {formulation}
)";

/// Hardly more than the release.
const char* const tiny = ", window: {x_m: [500420, 500440], y_m: [4599990, 4600010]}";
/// All of the raster and more.
const char* const everything = ", window: {x_m: [499000, 509000], y_m: [4590000, 4610000]}";

class Growing : public Workflow {
 protected:
  Growing() { write_geotiff(path("dem.tif"), valley(), {}); }

  workflow::EnsembleJob job(const std::string& window, const std::string& changes = "",
                            const std::string& formulation = "depth_averaged",
                            double spacing = 10) {
    std::string text =
        fmt::format(fmt::runtime(scene_text), fmt::arg("window", window),
                    fmt::arg("spacing", spacing), fmt::arg("formulation", formulation));
    if (!changes.empty())
      text = replaced(text, "  thickness_m: 5\n", "  thickness_m: 5\n" + changes);
    if (!basal_.empty()) text = replaced(text, "basal:\n", "basal:\n" + basal_);
    write("scene.yaml", text);
    Recorder silent;
    return untouched(workflow::prepare_ensemble(request(fmt::format("out{}", ++n_jobs_)), silent));
  }
  /// Describing the scene may have grown the ground already: the members shall do it.
  static workflow::EnsembleJob untouched(workflow::EnsembleJob job) {
    job.scene.ground =
        std::make_shared<workflow::GrowingGround>(job.scene.scenario, job.scene.inputs);
    return job;
  }

  static int level(const workflow::EnsembleJob& job) { return job.scene.ground->now()->level; }

  /// Bit by bit: NaN is NaN.
  static void expect_same(const MemberResult& a, const MemberResult& b) {
    EXPECT_EQ(a.state_hash, b.state_hash);
    EXPECT_EQ(a.outcome, b.outcome);
    EXPECT_EQ(a.window, b.window);
    EXPECT_TRUE(a.grid.same_place(b.grid));
    for (std::size_t k = 0; k < a.layers.size(); ++k) {
      ASSERT_EQ(a.layers[k].size(), b.layers[k].size());
      EXPECT_EQ(
          std::memcmp(a.layers[k].data(), b.layers[k].data(), a.layers[k].size() * sizeof(float)),
          0)
          << info(static_cast<PeakLayer>(k)).name;
    }
    for (const ScalarInfo& scalar : scalar_table()) {
      if (std::string(scalar.name).find("wall") != std::string::npos ||
          std::string(scalar.name).find("cpu") != std::string::npos)
        continue;
      const double va = a.scalars.*scalar.field, vb = b.scalars.*scalar.field;
      EXPECT_TRUE(va == vb || (std::isnan(va) && std::isnan(vb)))
          << scalar.name << ' ' << va << ' ' << vb;
    }
  }

  /// Members of a scene whose first window is tiny, chosen by the energy line, and the whole.
  void expect_same_bits(const std::string& changes, const std::string& formulation,
                        double spacing) {
    Recorder silent;
    workflow::EnsembleJob small = job(tiny, changes, formulation, spacing);
    workflow::EnsembleJob lined = job("", changes, formulation, spacing);
    workflow::EnsembleJob full = job(everything, changes, formulation, spacing);
    ASSERT_LT(small.scene.inputs.elevation->grid.n_cells(), 0.2 * n_cols * n_rows);
    ASSERT_EQ(full.scene.inputs.elevation->grid.n_cells(), std::size_t{n_cols} * n_rows);
    for (const std::int64_t member : {2, 0}) {
      const MemberResult a = workflow::run_member(small, member, silent.cancel);
      const MemberResult b = workflow::run_member(full, member, silent.cancel);
      const MemberResult c = workflow::run_member(lined, member, silent.cancel);
      EXPECT_EQ(b.outcome, Outcome::settled) << b.reason;
      EXPECT_FALSE(a.needs_more_ground);
      expect_same(a, b);
      expect_same(c, b);
    }
    EXPECT_GT(level(small), 0) << "nothing has grown";
    EXPECT_EQ(level(full), 0);
  }

  int n_jobs_ = 0;
  std::string basal_;  ///< lines of that block
};

TEST_F(Growing, ColumnsGetTheBitsOfTheWholeRaster) { expect_same_bits("", "depth_averaged", 10); }

TEST_F(Growing, ColumnsOnAveragedGroundToo) { expect_same_bits("", "depth_averaged", 13); }

TEST_F(Growing, ParticlesToo) { expect_same_bits("", "full_stress", 10); }

TEST_F(Growing, RastersOfTheBedGrowAlong) {
  // Cells of 7 m in strips across the valley, with gaps: no multiple of anything.
  Raster<double> mu(Grid{420, 190, west - 31, north + 17, 7, ""});
  for (int r = 0; r < mu.grid.n_rows; ++r)
    for (int c = 0; c < mu.grid.n_cols; ++c)
      mu.at(r, c) = (r + c) % 11 == 0 ? nan_d : 0.2 + 0.1 * std::sin(c / 9.0) * std::cos(r / 5.0);
  write_geotiff(path("mu.tif"), mu, {});
  basal_ =
      "  rasters: {friction_coefficient: mu.tif, crs: EPSG:32633, friction_coefficient_factor: "
      "{uniform: [0.9, 1.1]}}\n";
  expect_same_bits("", "depth_averaged", 10);
  expect_same_bits("", "full_stress", 10);
}

TEST_F(Growing, ADugSourceAndASpeedThatBeatsTheLine) {
  expect_same_bits("  surface: pre_failure\n  velocity_m_s: [30, 5, 0]\n", "depth_averaged", 10);
}

TEST_F(Growing, MapsKnowAHoleBeyondWhatWasReadFirst) {
  const auto maps = [&](const char* window) {
    Recorder silent;
    workflow::EnsembleJob members = job(window);
    workflow::run_ensemble(members, silent, silent.cancel);
    return workflow::make_maps(members, silent);
  };
  const workflow::MapsMade without = maps(tiny);
  const Grid map = read_layers(without.folder.hazard_nc()).grid;
  Raster<double> z = valley();
  const Window extent = window_of(map, z.grid);
  z.at(extent.row0 + 1, extent.col0 + 2) = nan_d;  // in the map's margin, where no mass comes
  write_geotiff(path("dem.tif"), z, {});
  const workflow::MapsMade grown = maps(tiny), full = maps(everything);
  EXPECT_EQ(grown.hazard_hash, full.hazard_hash);
  EXPECT_NE(grown.hazard_hash, without.hazard_hash);
  const LayerStack layers = read_layers(grown.folder.hazard_nc());
  const std::vector<float>& reach = layers.find("probability_of_reach")->values;
  EXPECT_TRUE(std::isnan(reach[map.index(1, 2)]));
  EXPECT_EQ(reach[map.index(1, 1)], 0);

  Recorder heard;
  EXPECT_EQ(workflow::merge_members({grown.folder.root}, heard).hazard_hash, grown.hazard_hash);
  std::filesystem::remove(path("dem.tif"));
  try {
    workflow::merge_members({grown.folder.root}, heard);
    ADD_FAILURE() << "maps without knowing the ground";
  } catch (const SetupError& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("maps say 0 only where the ground is known"));
  }
}

TEST_F(Growing, ZonesGrowAlong) {
  write("zone.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},
"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
[[[501000,4599500],[502000,4599500],[502000,4600300],[501000,4600300],[501000,4599500]]]}}]})");
  const std::string zones = "  zones: [{polygon: zone.geojson, friction_coefficient: 0.5}]\n";
  Recorder silent;
  const auto with_zones = [&](const char* window) {
    job(window);
    write("scene.yaml", replaced(read("scene.yaml"), "basal:\n", "basal:\n" + zones));
    return untouched(
        workflow::prepare_ensemble(request(fmt::format("zoned{}", ++n_jobs_)), silent));
  };
  workflow::EnsembleJob small = with_zones(tiny), full = with_zones(everything);
  const MemberResult a = workflow::run_member(small, 1, silent.cancel);
  expect_same(a, workflow::run_member(full, 1, silent.cancel));
  EXPECT_GT(level(small), 0);
  workflow::EnsembleJob bare = job(everything);
  EXPECT_NE(a.state_hash, workflow::run_member(bare, 1, silent.cancel).state_hash)
      << "the zone must matter";
}

TEST_F(Growing, BedsThatAreTakenAlongGrowToo) {
  write("channel.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},
"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
[[[500500,4599900],[502000,4599900],[502000,4600100],[500500,4600100],[500500,4599900]]]}}]})");
  Raster<double> depths(Grid{130, 60, west + 170, north - 500, 5, ""}, 0.4);
  write_geotiff(path("depths.tif"), depths, {});
  Recorder silent;
  const auto with_bed = [&](const std::string& bed, const char* window, double spacing) {
    job(window, "", "depth_averaged", spacing);
    write("scene.yaml", replaced(read("scene.yaml"), "numerics:",
                                 "erosion: {growth_rate_per_m: 2.0e-3, " + bed + "}\nnumerics:"));
    return untouched(
        workflow::prepare_ensemble(request(fmt::format("eroded{}", ++n_jobs_)), silent));
  };
  for (const double spacing : {10.0, 13.0})  // the second on averaged ground
    for (const std::string bed : {"depth_m: 0.5, polygon: channel.geojson",
                                  "depth_raster: depths.tif, crs: 'EPSG:32633'"}) {
      workflow::EnsembleJob small = with_bed(bed, tiny, spacing),
                            full = with_bed(bed, everything, spacing);
      const MemberResult a = workflow::run_member(small, 1, silent.cancel);
      expect_same(a, workflow::run_member(full, 1, silent.cancel));
      EXPECT_GT(level(small), 0) << bed;
      EXPECT_GT(a.scalars.eroded_volume_m3, 1000) << bed;
    }
}

TEST_F(Growing, MixturesToo) {
  Recorder silent;
  const auto wet = [&](const char* window) {
    job(window);
    std::string text =
        replaced(read("scene.yaml"), "numerics:", "mixture: {permeability_m2: 1.0e-9}\nnumerics:");
    write("scene.yaml", replaced(text, "{uniform: [0.25, 0.35]}", "{uniform: [0.6, 0.8]}"));
    return untouched(workflow::prepare_ensemble(request(fmt::format("wet{}", ++n_jobs_)), silent));
  };
  workflow::EnsembleJob small = wet(tiny), full = wet(everything);
  expect_same(workflow::run_member(small, 1, silent.cancel),
              workflow::run_member(full, 1, silent.cancel));
  EXPECT_GT(level(small), 0);
}

TEST_F(Growing, MapsOfAnEnsembleDoNotDependOnTheWindow) {
  Recorder heard;
  workflow::EnsembleJob small = job(tiny);
  small.workers = 2;
  workflow::run_ensemble(small, heard, heard.cancel);
  workflow::EnsembleJob full = job(everything);
  workflow::run_ensemble(full, heard, heard.cancel);
  EXPECT_EQ(workflow::make_maps(small, heard).hazard_hash,
            workflow::make_maps(full, heard).hazard_hash);
}

/// Both shards begin on the same little window; before the second needs more, the file changes
/// where only the first has looked.
TEST_F(Growing, AShardRefusesGroundThatAnotherReadOtherwise) {
  job(tiny);
  Recorder silent;
  const auto shard = [&](int k) {
    workflow::EnsembleRequest part = request("sharded");
    part.shard = {k, 2};
    workflow::EnsembleJob begun = untouched(workflow::prepare_ensemble(part, silent));
    begun.manifest.inputs = begun.scene.inputs.identities;  // not what `describe` read besides
    workflow::keep_what_is_read(begun);
    return begun;
  };
  workflow::EnsembleJob first = shard(1), second = shard(2);
  EXPECT_EQ(workflow::run_ensemble(first, silent, silent.cancel).stop_error, "");
  ASSERT_GT(level(first), 0) << "nothing has grown";
  Raster<double> z = valley();
  z.at(n_rows / 2, 30) += 1;  // behind the release: the energy line does not read it
  write_geotiff(path("dem.tif"), z, {});
  const workflow::MembersRun refused = workflow::run_ensemble(second, silent, silent.cancel);
  EXPECT_THAT(refused.stop_error, HasSubstr("another shard has read another input"));
  EXPECT_THAT(refused.stop_error, HasSubstr("dem.tif"));
  EXPECT_EQ(refused.finished, 0U);

  write_geotiff(path("dem.tif"), valley(), {});
  EXPECT_EQ(workflow::run_ensemble(second, silent, silent.cancel).stop_error, "");
}

TEST_F(Growing, ASingleRunWritesItsFramesOnce) {
  job(tiny);
  Recorder heard;
  workflow::RunRequest request;
  request.scene = scene();
  request.folder = path("single");
  request.threads = 1;
  request.particles_every_s = 10;
  workflow::SingleRun run = workflow::prepare_run(request, heard);
  run.scene.ground =
      std::make_shared<workflow::GrowingGround>(run.scene.scenario, run.scene.inputs);
  const MemberResult result = workflow::compute_run(run, heard, heard.cancel);
  EXPECT_GT(run.scene.ground->now()->level, 0);
  EXPECT_EQ(result.outcome, Outcome::settled);
  std::size_t frames = 0;
  for (const auto& entry : std::filesystem::directory_iterator(run.folder.particles()))
    frames += entry.path().extension() == ".vtu" || entry.path().extension() == ".vtp";
  EXPECT_LE(frames, static_cast<std::size_t>(result.scalars.end_time_s / 10) + 2);
}

TEST_F(Growing, ReadsWhatTheEnergyLineReaches) {
  const workflow::EnsembleJob lined = job("");
  const SceneInputs& in = lined.scene.inputs;
  EXPECT_LT(in.elevation->grid.n_cells(), std::size_t{n_cols} * n_rows);
  EXPECT_EQ(in.terrain_grid().n_cols, n_cols);
  EXPECT_EQ(in.hazard_grid.n_cols, n_cols) << "maps keep the raster's grid";
  EXPECT_THAT(lined.scene.description.ground, HasSubstr("of 700 x 320 cells"));
  EXPECT_THAT(lined.scene.description.end_time_reason, HasSubstr("energy line"));
}

TEST_F(Growing, AWindowBesideTheRasterIsRefused) {
  try {
    job(", window: {x_m: [1, 2], y_m: [3, 4]}");
    ADD_FAILURE() << "no error";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("terrain.window"));
    EXPECT_THAT(error.what(), HasSubstr("holds nothing of the raster"));
  }
}

}  // namespace
}  // namespace sturz::test
