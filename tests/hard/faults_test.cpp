// SPDX-License-Identifier: Apache-2.0
// I18: whatever becomes NaN, infinite or absurd in the middle of a run, the member ends with a name
// and a reason, the last frame is the last good one, and the others of the ensemble go on.
#include "engine/effects/fields.hpp"
#include "ensemble/members/runner.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/hard/random_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string>

namespace sturz::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What is done to particle 40 after 64 steps.
struct Fault {
  std::string name;
  std::function<void(State&)> inject;
  std::string reason;  ///< what the member must say
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

std::function<void(State&)> field(const FieldKey& key, int component, double value) {
  return [=, &key](State& s) { s.grains().components(key)[component][40] = value; };
}

HardMember small_member() {
  static const RandomMembers members = RandomMembers::on_steep_ground();
  HardMember m = members.member(0);
  m.scenario.numerics.end_time_s = 2;
  return m;
}

MemberResult run_with(const Fault& fault, const RunControl& frames = {}) {
  const HardMember m = small_member();
  Simulation simulation = assemble(m.scenario, m.inputs, 0, 1);
  RunControl control = frames;
  control.progress_every_s = 0;
  control.on_progress = [&](const Progress& p) {
    if (p.n_steps == 64 && fault.inject) fault.inject(simulation.parts().state);
    return true;
  };
  return simulation.run(control);
}

class FaultInARun : public testing::TestWithParam<Fault> {};

INSTANTIATE_TEST_SUITE_P(
    Of, FaultInARun,
    testing::Values(Fault{"Velocity", [](State& s) { s.grains().vx[40] = nan; }, "not finite"},
                    Fault{"Position", [](State& s) { s.grains().y[40] = infinity; }, "not finite"},
                    Fault{"Height", [](State& s) { s.grains().z[40] = nan; }, "not finite"},
                    Fault{"Mass", [](State& s) { s.grains().mass[40] = nan; }, "not finite"},
                    Fault{"Stress", field(fields::stress, 3, nan), "not finite"},
                    Fault{"InfiniteStress", field(fields::stress, 2, -infinity), "not finite"},
                    Fault{"DensityChange", field(fields::density_change, 0, nan), "not finite"},
                    Fault{"HugeStress", field(fields::stress, 2, -1e30), ""},
                    Fault{"Speed", [](State& s) { s.grains().vz[40] = 1e9; }, ""}),
    [](const auto& i) { return i.param.name; });

TEST_P(FaultInARun, EndsTheMemberByNameAfterItsLastGoodFrame) {
  RunControl frames;
  frames.frame_every_s = 0;  // every step
  int n = 0, bad = 0;
  double last = 0;
  frames.on_frame = [&](const ParticleFrame& f) {
    double sum = 0;
    for (const auto& column : {f.x, f.y, f.z, f.vx, f.vy, f.vz, f.mass, f.density, f.pressure})
      sum = std::accumulate(column.begin(), column.end(), sum);
    ++n, bad += !std::isfinite(sum), last = f.time_s;
  };
  const MemberResult r = run_with(GetParam(), frames);
  EXPECT_EQ(r.outcome, Outcome::diverged) << to_string(r.outcome);
  EXPECT_THAT(r.reason, testing::HasSubstr(GetParam().reason));
  EXPECT_NE(r.reason, "");
  EXPECT_EQ(bad, 0) << "frames with numbers that are not finite, of " << n;
  EXPECT_GE(n, 64);
  EXPECT_LE(r.scalars.n_steps, 74) << "the member went on after the fault";
  EXPECT_GT(last, 0);
}

/// A finite absurdity that stops nothing must at least show in the ledger.
TEST(FaultInARunThatGoesOn, ShowsInTheEnergyResidual) {
  const MemberResult r =
      run_with({"Huge density change", field(fields::density_change, 0, 1e12), ""});
  EXPECT_TRUE(is_valid(r.outcome));
  EXPECT_GT(std::abs(r.scalars.energy_residual), 1);
}

TEST(FaultInAnEnsemble, LeavesTheOtherMembersAlone) {
  const std::uint64_t untouched = run_with({}).state_hash;
  RunPlan plan;
  plan.members = {0, 1, 2, 3, 4, 5};
  plan.workers = 2;
  RunCallbacks callbacks;
  callbacks.run_member = [&](std::int64_t member, const std::atomic<bool>&) {
    if (member == 2) throw std::runtime_error("out of luck");
    Fault fault;
    if (member == 1) fault.inject = [](State& s) { s.grains().vx[40] = nan; };
    MemberResult r = run_with(fault);
    r.member = member;
    return r;
  };
  int same = 0;
  callbacks.store = [&](const MemberResult& r) { same += r.state_hash == untouched; };
  const RunReport report = run_members(plan, callbacks, std::atomic<bool>{false});
  EXPECT_TRUE(report.complete());
  ASSERT_EQ(report.failed.size(), 2u);
  EXPECT_EQ(report.failed[0].outcome, Outcome::diverged);
  EXPECT_THAT(report.failed[0].reason, testing::HasSubstr("not finite"));
  EXPECT_EQ(report.failed[1].outcome, Outcome::failed);
  EXPECT_THAT(report.failed[1].reason, testing::HasSubstr("out of luck"));
  EXPECT_EQ(same, 4);
}

}  // namespace
}  // namespace sturz::test
