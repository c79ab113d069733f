// SPDX-License-Identifier: Apache-2.0
// The workflow speaks through its observer and nowhere else, in trouble too.
#include "engine/core/error.hpp"
#include "ensemble/workflow/members/single_run.hpp"
#include "ensemble/workflow/results/merge.hpp"
#include "ensemble/workflow/results/report_page.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <unistd.h>

#include <functional>

namespace sturz::test {
namespace {

/// What `work` writes to the process's two streams, also past the C++ library.
std::string printed_by(const std::function<void()>& work) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  work();
  std::string text = ::testing::internal::GetCapturedStdout();
  return text + ::testing::internal::GetCapturedStderr();
}

class SilentWorkflow : public Workflow {};

TEST_F(SilentWorkflow, PrintsNothingFromSceneToPage) {
  Recorder heard;
  EXPECT_EQ(printed_by([&] {
              whole(request("out"), heard);
              workflow::rewrite_page(path("out"), heard);
              workflow::SingleRun run =
                  workflow::prepare_run({scene(), path("single"), 1, {}, "test"}, heard);
              workflow::store_run(run, workflow::compute_run(run, heard, heard.cancel));
            }),
            "");
  EXPECT_EQ(heard.members.size(), static_cast<std::size_t>(n_tiny));
}

TEST_F(SilentWorkflow, PrintsNothingInTrouble) {
  Recorder heard;
  whole(request("out"), heard);
  damage("out", 1);
  EXPECT_EQ(
      printed_by([&] {
        EXPECT_THROW(workflow::merge_members({path("out")}, heard), SetupError);
        workflow::merge_members({path("out"), true}, heard);
        whole(request("out"), heard);
        EXPECT_THROW(workflow::load_scene({path("absent.yaml").string(), {}, {}}), SetupError);
        workflow::SceneRequest broken = scene({"terrain={raster: absent.tif}"});
        EXPECT_THROW(workflow::load_scene(broken), SetupError);
      }),
      "");
  EXPECT_GE(heard.warnings.size(), 3u) << "the trouble was not told";
}

TEST_F(SilentWorkflow, TheCaptureWouldSeeIt) {
  EXPECT_EQ(printed_by([] { ASSERT_EQ(::write(1, "a", 1), 1); }), "a");
}

}  // namespace
}  // namespace sturz::test
