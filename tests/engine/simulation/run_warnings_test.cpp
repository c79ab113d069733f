// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/run_warnings.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

TEST(RunWarnings, AreSilentForAVerifiedRun) {
  MemberScalars m;
  m.take_off_fraction = 0.004;
  m.energy_residual = -0.01;
  EXPECT_EQ(run_warnings(m), "");
}

TEST(RunWarnings, NameTakeOffAndUnexplainedEnergyWithTheirNumbers) {
  MemberScalars m;
  m.take_off_fraction = 0.16;
  EXPECT_TRUE(run_warnings(m).starts_with("16 % of mass and time"));
  m.energy_residual = -1.1;
  const std::string both = run_warnings(m);
  EXPECT_NE(both.find("; -110 % of the energy"), std::string::npos) << both;
  m.take_off_fraction = 0;
  m.energy_residual = 0.6;
  EXPECT_TRUE(run_warnings(m).starts_with("60 % of the energy"));
  m.energy_residual = nan_d;
  EXPECT_NE(run_warnings(m), "") << "no number is no reason to be silent";
}

}  // namespace
}  // namespace sturz
