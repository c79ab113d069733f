// SPDX-License-Identifier: Apache-2.0
// Keys of the page: its language, and a member's thickness over time.
#include "engine/core/error.hpp"
#include "ensemble/workflow/frames/member_frames.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Text of the SetupError that `call` throws.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return "not refused";
}

class ReportKeys : public Workflow {};

TEST_F(ReportKeys, ThePageSpeaksTheScenariosLanguageOrThatOfTheOption) {
  write("scene.yaml", tiny_scene() + "report: {language: de}\n");
  Recorder heard;
  const std::string hash = whole(request("out"), heard).hazard_hash;
  EXPECT_THAT(read("out/report.html"), AllOf(HasSubstr("<html lang=\"de\">"), HasSubstr("Zuerst")));
  workflow::rewrite_page(path("out"), heard, {}, "en");
  EXPECT_THAT(read("out/report.html"), HasSubstr("<html lang=\"en\">"));
  EXPECT_THAT(refusal([&] { workflow::rewrite_page(path("out"), heard, {}, "xx"); }),
              AllOf(HasSubstr("--language: xx"), HasSubstr("de, en")));
  write("scene.yaml", tiny_scene() + "report: {language: xx}\n");
  EXPECT_THAT(refusal([&] { whole(request("other"), heard); }), HasSubstr("report.language: xx"));
  write("scene.yaml", tiny_scene());
  Recorder again;
  EXPECT_EQ(whole(request("out"), again).hazard_hash, hash);
  EXPECT_TRUE(again.members.empty()) << "no member is computed for a language";
}

/// Largest difference of a frame and a layer where either has cells.
double difference(const FramesShown& frames, std::size_t k, const Layer& layer, const Grid& grid) {
  double most = 0;
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      const double x = grid.west_m + (col + 0.5) * grid.cell_m;
      const double y = grid.north_m - (row + 0.5) * grid.cell_m;
      const int r = frames.grid.row_of(y), c = frames.grid.col_of(x);
      const bool inside = r >= 0 && c >= 0 && r < frames.grid.n_rows && c < frames.grid.n_cols;
      const float shown = inside ? frames.thickness[k][frames.grid.index(r, c)] : 0;
      const float own = layer.values[grid.index(row, col)];
      most = std::max(most, std::abs(static_cast<double>(shown) - (std::isnan(own) ? 0 : own)));
    }
  return most;
}

TEST_F(ReportKeys, AnAnimationOfARunEndsWithItsDeposit) {
  write("scene.yaml", tiny_scene() + "report: {animation: true}\n");
  Recorder heard;
  workflow::SingleRun run = workflow::prepare_run({scene(), path("out"), 1, {}, "test"}, heard);
  const MemberResult result = workflow::compute_run(run, heard, heard.cancel);
  workflow::store_run(run, result);
  const auto frames = workflow::read_frames(run.folder);
  ASSERT_TRUE(frames);
  ASSERT_GE(frames->times_s.size(), 2U);
  EXPECT_LE(frames->times_s.size(), workflow::FrameTaker::most_frames + 1);
  EXPECT_DOUBLE_EQ(frames->times_s.back(), result.scalars.end_time_s);
  const LayerStack peaks = read_layers(path("out/peaks.nc"));
  const Layer& deposit = *peaks.find("deposit_thickness");
  EXPECT_EQ(difference(*frames, frames->times_s.size() - 1, deposit, peaks.grid), 0);
  EXPECT_GT(difference(*frames, 0, deposit, peaks.grid), 0) << "it began elsewhere";
  EXPECT_THAT(read("out/report.html"), HasSubstr("\"frames\":{\"label\":\"this run\""));
  write("scene.yaml", tiny_scene());
  workflow::SingleRun still = workflow::prepare_run({scene(), path("still"), 1, {}, "test"}, heard);
  EXPECT_EQ(workflow::compute_run(still, heard, heard.cancel).state_hash, result.state_hash);
  EXPECT_FALSE(exists("still/frames.nc"));
}

TEST_F(ReportKeys, AnAnimationOfALongRunKeepsItsFirstInstant) {
  // Longer than 40 s, so that every second instant goes: in columns, which are quick, on friction
  // that holds the mass on the plane.
  const std::string rough = replaced(tiny_scene(), "uniform: [0.3, 0.7]", "uniform: [0.8, 1.2]");
  const std::string columns =
      replaced(rough, "formulation: full_stress", "formulation: depth_averaged");
  write("scene.yaml", replaced(columns, "end_time_s: 3", "end_time_s: 45, stop_at_rest: false") +
                          "report: {animation: true}\n");
  Recorder heard;
  workflow::SingleRun run = workflow::prepare_run({scene(), path("out"), 1, {}, "test"}, heard);
  const MemberResult result = workflow::compute_run(run, heard, heard.cancel);
  ASSERT_GT(result.scalars.end_time_s, 44);
  const auto frames = workflow::read_frames(run.folder);
  ASSERT_TRUE(frames);
  EXPECT_LE(frames->times_s.size(), workflow::FrameTaker::most_frames + 1);
  EXPECT_LT(frames->times_s.front(), workflow::FrameTaker::first_interval_s);
  const auto& first = frames->thickness.front();
  EXPECT_GT(*std::max_element(first.begin(), first.end()), 1) << "the release, 3 m thick";
}

TEST_F(ReportKeys, AnEnsembleKeepsThatOfItsMiddleMember) {
  write("scene.yaml", tiny_scene() + "report: {animation: true}\n");
  Recorder heard;
  whole(request("out"), heard);
  const workflow::OutputFolder folder{path("out")};
  const auto frames = workflow::read_frames(folder);
  ASSERT_TRUE(frames);
  const MemberStore store(folder.members());
  const auto middle = workflow::middle_member(store.members());
  ASSERT_TRUE(middle);
  EXPECT_EQ(frames->member, store.members()[*middle].member);
  EXPECT_THAT(read("out/report.html"), HasSubstr("of the middle runout"));
}

}  // namespace
}  // namespace sturz::test
