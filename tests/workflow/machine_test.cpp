// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/cores.hpp"
#include "ensemble/workflow/machine/machine_speed.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <nlohmann/json.hpp>

namespace sturz::test {
namespace {

class MachineSpeed : public Workflow {};

TEST_F(MachineSpeed, IsMeasuredOnceAndThenRemembered) {
  const workflow::SpeedCache cache{path("cache/speed.json")};
  const double measured = workflow::updates_per_second("depth_averaged", cache);
  EXPECT_GT(measured, 0);
  auto stored = nlohmann::json::parse(read("cache/speed.json"));
  EXPECT_EQ(stored.at("depth_averaged").get<double>(), measured);

  stored["depth_averaged"] = 12.5;
  write("cache/speed.json", stored.dump());
  EXPECT_EQ(workflow::updates_per_second("depth_averaged", cache), 12.5);
  EXPECT_NE(workflow::updates_per_second("depth_averaged", {cache.file, true}), 12.5);

  stored["measured_on"] = "another processor";
  write("cache/speed.json", stored.dump());
  EXPECT_NE(workflow::updates_per_second("depth_averaged", cache), 12.5);
}

TEST(Cores, ThereIsOneAtLeast) { EXPECT_GE(workflow::available_cores(), 1); }

}  // namespace
}  // namespace sturz::test
