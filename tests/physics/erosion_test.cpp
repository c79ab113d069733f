// SPDX-License-Identifier: Apache-2.0
// A bed that the flow takes along, E1 to E6: against the closed form of a block that grows with its
// path, by mass and supply, and where nothing may be taken.
#include "engine/effects/fields.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace sturz::test {
namespace {

/// A sheet of columns on an even slope, periodic both ways: what no column does to another.
Scenario sheet(double slope_deg, double friction, double thickness_m, double seconds) {
  Scenario s = thin_sheet(1);
  s.formulation = Formulation::depth_averaged;
  s.terrain.synthetic->parameters["slope_deg"] = slope_deg;
  s.release.thickness_m = Uncertain(thickness_m);
  s.basal.friction_coefficient = friction;
  s.numerics.end_time_s = seconds;
  s.numerics.jitter = 0;
  return s;
}

ErosionSpec growing(double per_m) {
  ErosionSpec e;
  e.growth_rate_per_m = Uncertain(per_m);
  e.supply = ErosionSupply::unlimited;
  return e;
}

ErosionSpec limited(ErosionSpec e, double depth_m) {
  e.supply = ErosionSupply::limited;
  e.depth_m = Uncertain(depth_m);
  return e;
}

double mass_of(const Finished& f) {
  const auto& mass = f.simulation.parts().state.grains().mass;
  return std::accumulate(mass.begin(), mass.end(), 0.0);
}

void expect_accounts(const Finished& f, double energy = 0.01) {
  const MemberScalars& m = f.result.scalars;
  const Ledger ledger = f.simulation.parts().state.ledger();
  EXPECT_LT(std::abs(m.mass_error), 1e-13);
  EXPECT_LT(std::abs(m.energy_residual), energy);
  EXPECT_NEAR(mass_of(f) + ledger.lost_mass, ledger.released_mass + ledger.entrained_mass,
              1e-13 * mass_of(f));
  const double change = ledger.kinetic - ledger.kinetic_0,
               works = ledger.gravity_work + ledger.stress_work + ledger.contact_work -
                       ledger.friction - ledger.lost_energy - ledger.entrainment_loss +
                       ledger.outer_work;
  EXPECT_NEAR(change, works, 1e-9 * ledger.available_energy()) << "kinetic energy by its works";
  EXPECT_GE(ledger.entrainment_loss, 0);
}

/// E1: v = sqrt(a/E_s) tanh(t sqrt(a E_s)), s = ln cosh(t sqrt(a E_s))/E_s, V/V_0 = exp(E_s s).
struct GrowingBlock {
  double per_m, a = gravity_m_s2 * (std::sin(25 * degree) - 0.2 * std::cos(25 * degree));
  double speed(double t) const {
    return std::sqrt(a / per_m) * std::tanh(t * std::sqrt(a * per_m));
  }
  double path(double t) const { return std::log(std::cosh(t * std::sqrt(a * per_m))) / per_m; }
};

struct Reference {
  double per_m, t, path, speed, growth;
};
constexpr Reference references[] = {{1e-3, 10, 113.9890, 21.96991, 1.12074},
                                    {1e-3, 20, 413.5097, 36.49917, 1.51212},
                                    {5e-3, 10, 100.4793, 17.32537, 1.65268},
                                    {5e-3, 20, 299.1501, 21.20765, 4.46269}};

class GrowingSheet : public testing::TestWithParam<Reference> {};
INSTANTIATE_TEST_SUITE_P(Erosion, GrowingSheet, testing::ValuesIn(references), [](const auto& i) {
  return fmt::format("{:.0f}PerKilometre{:.0f}s", 1e3 * i.param.per_m, i.param.t);
});

TEST_P(GrowingSheet, SlidesAsTheBlockThatGrowsWithItsPath) {
  const Reference& r = GetParam();
  EXPECT_NEAR(GrowingBlock{r.per_m}.path(r.t), r.path, 1e-4);
  EXPECT_NEAR(GrowingBlock{r.per_m}.speed(r.t), r.speed, 1e-5);
  std::vector<double> step, path, speed, growth;
  for (const double cell : {8.0, 4.0, 2.0}) {  // the step is the time over half a cell
    Scenario s = sheet(25, 0.2, 2, r.t);
    s.terrain.synthetic->cell_size_m = cell;
    s.terrain.synthetic->parameters["length_m"] = 48;
    s.terrain.synthetic->parameters["width_m"] = 16;
    s.release.box = ReleaseBox{{-24, 24}, {-8, 8}};
    s.erosion = growing(r.per_m);
    const Finished f = run(s);
    const State& state = f.simulation.parts().state;
    const MeanMotion m = mean_motion(state.grains());
    const double last = state.previous_dt, half = r.t - 0.5 * last;
    // Speed and mass stand half a step before the end.
    step.push_back(f.result.scalars.mean_dt_s);
    path.push_back(f.result.scalars.front_travel_m / std::cos(25 * degree) - r.path);
    speed.push_back(m.speed - GrowingBlock{r.per_m}.speed(half));
    growth.push_back(
        f.result.scalars.volume_growth / std::exp(r.per_m * GrowingBlock{r.per_m}.path(half)) - 1);
    fmt::print("E1 E_s {} t {}: dt {:.4f} s, path {:+.2e}, speed {:+.2e}, growth {:+.2e}\n",
               r.per_m, r.t, step.back(), path.back() / r.path, speed.back() / r.speed,
               growth.back());
    expect_accounts(f);
    if (cell == 2) {
      expect_within(relative(fmt::format("E1 path, E_s {} 1/m, {} s", r.per_m, r.t), "m",
                             r.path + path.back(), r.path, 5e-4),
                    f);
      expect_within(relative(fmt::format("E1 speed, E_s {} 1/m, {} s", r.per_m, r.t), "m/s",
                             r.speed + speed.back(), r.speed, 5e-4),
                    f);
      expect_within(relative(fmt::format("E1 growth, E_s {} 1/m, {} s", r.per_m, r.t), "V_f/V_0",
                             r.growth * (1 + growth.back()), r.growth, 5e-4),
                    f);
    }
  }
  const auto order = [&](const std::vector<double>& e) {
    return std::log(std::abs(e[0] / e[2])) / std::log(step[0] / step[2]);
  };
  fmt::print("E1 E_s {} t {}: order of path {:.2f}, speed {:.2f}, growth {:.2f}\n", r.per_m, r.t,
             order(path), order(speed), order(growth));
  EXPECT_LT(std::abs(path[2]), std::abs(path[0]));
}

TEST(Erosion, OfABedAtRestOnlySlowsTheFlow) {
  Scenario bare = sheet(25, 0.2, 2, 8);
  const double without = run(bare).result.scalars.com_travel_m;
  ErosionSpec stress, jump;
  stress.law = ErosionLaw::shear_stress;
  jump.law = ErosionLaw::momentum_jump;
  jump.bed_friction_coefficient = Uncertain(0.6), jump.bed_pore_pressure_ratio = Uncertain(0.75);
  stress.supply = ErosionSupply::unlimited;
  for (const ErosionSpec& e : {growing(2e-3), stress, limited(jump, 3)}) {
    bare.erosion = e;
    const Finished f = run(bare);
    EXPECT_LT(f.result.scalars.front_travel_m, without) << to_string(e.law);
    EXPECT_GT(f.result.scalars.volume_growth, 1.01) << to_string(e.law);
    EXPECT_GT(f.result.scalars.entrainment_loss_fraction, 0) << to_string(e.law);
    expect_accounts(f);
  }
}

/// E4: every cell is worn by its supply and no more, whatever the columns would take.
TEST(Erosion, TakesTheSupplyAndNoMore) {
  for (const double depth : {1e-6, 0.03, 0.5}) {
    Scenario s = sheet(25, 0.2, 2, 20);
    s.erosion = limited(growing(0.02), depth);
    s.erosion->bed_density_kg_m3 = Uncertain(1900);
    const Finished f = run(s);
    const MemberScalars& m = f.result.scalars;
    const State& state = f.simulation.parts().state;
    const double area = 12 * 8;
    EXPECT_NEAR(m.eroded_volume_m3, depth * area, 1e-12 * depth * area) << depth;
    EXPECT_NEAR(m.max_eroded_depth_m, depth, 1e-12 * depth) << depth;
    EXPECT_NEAR(m.entrained_mass_kg, 1900 * m.eroded_volume_m3, 1e-13 * mass_of(f)) << depth;
    EXPECT_NEAR(state.ledger().released_mass + 1900 * m.eroded_volume_m3, mass_of(f),
                1e-13 * mass_of(f))
        << depth;
    expect_accounts(f);
  }
}

/// E3 in a flow: the depth that the stress takes, reached at the rate.
TEST(Erosion, GoesAsDeepAsTheStressTakesIt) {
  Scenario s = sheet(10, std::tan(10 * degree), 2 / std::cos(10 * degree), 15);
  s.grains->density_kg_m3 = Uncertain(2500), s.grains->solid_fraction = Uncertain(0.8);
  s.release.velocity_m_s = {20, 0, 0};
  ErosionSpec e;
  e.law = ErosionLaw::shear_stress;
  s.erosion = limited(e, 50);
  std::vector<double> depth;
  const auto look = [&](double, const SimulationParts& p) {
    depth.push_back(p.state.bed_supply->eroded_volume_m3() / (12 * 8) * std::cos(10 * degree));
  };
  const Finished early = run(build(s), {10, look});
  ASSERT_GE(depth.size(), 2u);
  EXPECT_NEAR(depth[1], 0.25, 0.005) << "0.025 m/s for 10 s";
  // It gets thicker by what it takes: e_m grows with it, d e_m/d e = 0.1 rho g sin / 1 kPa.
  s.erosion->rate_m_s = Uncertain(1.0);
  const Finished f = run(s);
  const State& state = f.simulation.parts().state;
  const double h = 2 * f.result.scalars.volume_growth;
  const double most = 1e-4 * (2000 * gravity_m_s2 * h * std::sin(10 * degree) - 1e3);
  EXPECT_NEAR(state.bed_supply->eroded_volume_m3() / (12 * 8) * std::cos(10 * degree), most,
              0.01 * most);
  expect_accounts(f);
}

/// E5.
TEST(Erosion, TakesNothingAtRestAndNothingBelowTheSupply) {
  const Scenario moves = [&] {
    Scenario other = sheet(25, 0.2, 2, 5);
    other.erosion = limited(growing(0.1), 0.2);
    return other;
  }();
  const Finished f = run(moves);
  f.simulation.parts().state.bed_supply->visit_eroded(
      [](int, int, double depth) { EXPECT_LE(depth, 0.2 * (1 + 1e-12)); });
  // A steep sheet that friction holds: gravity pulls, nothing moves, nothing goes.
  Scenario held = sheet(25, 0.6, 2, 5);
  for (const ErosionLaw law :
       {ErosionLaw::exponential, ErosionLaw::shear_stress, ErosionLaw::momentum_jump}) {
    held.erosion = ErosionSpec{};
    held.erosion->law = law;
    held.erosion->depth_m = Uncertain(5);
    if (law == ErosionLaw::exponential) held.erosion->growth_rate_per_m = Uncertain(1.0);
    if (law == ErosionLaw::momentum_jump) {
      held.erosion->bed_friction_coefficient = Uncertain(0.1);
      held.erosion->bed_pore_pressure_ratio = Uncertain(1);
    }
    const Finished rests = run(held);
    EXPECT_EQ(rests.result.scalars.eroded_volume_m3, 0) << to_string(law);
    EXPECT_EQ(rests.result.scalars.volume_growth, 1) << to_string(law);
  }
}

/// E6: in speed a growing flow is one with Voellmy's drag of xi = g/(E_s h).
TEST(Erosion, SlowsLikeVoellmysDrag) {
  const double h = 5, per_m = 1e-3, xi = gravity_m_s2 / (per_m * h);
  EXPECT_NEAR(xi, 1962, 0.5);
  Scenario s = sheet(25, 0.2, h / std::cos(25 * degree), 20);
  s.erosion = growing(per_m);
  const Finished grows = run(s);
  s.erosion.reset();
  s.basal.turbulent_coefficient_m_s2 = Uncertain(xi);
  const Finished drags = run(s);
  const double v = mean_motion(grows.simulation.parts().state.grains()).speed;
  EXPECT_NEAR(v, mean_motion(drags.simulation.parts().state.grains()).speed, 2e-3 * v);
  expect_within(
      relative("E6 path of a growing flow and of Voellmy's drag", "m",
               grows.result.scalars.front_travel_m, drags.result.scalars.front_travel_m, 2e-3),
      grows);
}

TEST(Erosion, MassThatIsTakenUpHasNotCome) {
  Scenario s = sheet(25, 0.2, 2, 10);
  s.erosion = growing(5e-3);
  const Finished f = run(s);
  const MemberScalars& m = f.result.scalars;
  // Mass taken up at s' came s - s': the mean over exp(E_s s') is (1 - exp(-E_s s))/E_s.
  const double path = m.front_travel_m / std::cos(25 * degree);
  const double mean = (1 - std::exp(-5e-3 * path)) / 5e-3 * std::cos(25 * degree);
  EXPECT_NEAR(m.com_travel_m, mean, 5e-3 * mean);
  EXPECT_NEAR(m.com_ratio, std::tan(25 * degree), 5e-3) << "fall and travel of the same mass";
}

/// A cap that runs out, with a bed that ends: what the hard corner varies.
Scenario slide(const ErosionSpec& e) {
  Scenario s = ramp_slide(90, 4);
  s.formulation = Formulation::depth_averaged;
  s.erosion = e;
  return s;
}

TEST(Erosion, SameBitsAtAnyNumberOfThreads) {
  const Scenario s = slide(limited(growing(5e-3), 0.4));
  const Finished one = run(build(s, 1)), two = run(build(s, 2));
  EXPECT_EQ(one.result.state_hash, two.result.state_hash);
  EXPECT_EQ(one.result.scalars.eroded_volume_m3, two.result.scalars.eroded_volume_m3);
  EXPECT_EQ(one.result.layer(PeakLayer::eroded), two.result.layer(PeakLayer::eroded));
  EXPECT_GT(one.result.scalars.eroded_volume_m3, 100);
}

TEST(Erosion, AbsentBlockChangesNoBitAndKeepsNothing) {
  Scenario s = ramp_slide(90, 4);
  s.formulation = Formulation::depth_averaged;
  const Finished f = run(s);
  EXPECT_FALSE(f.simulation.parts().state.bed_supply.has_value());
  EXPECT_FALSE(f.simulation.parts().state.grains().has(fields::entrained_mass));
  EXPECT_TRUE(f.simulation.parts().state.grains().lag_x.empty());
  EXPECT_TRUE(f.result.layer(PeakLayer::eroded).empty());
  EXPECT_TRUE(std::isnan(f.result.scalars.eroded_volume_m3));
  const Finished dry = run(slide(limited(growing(1e-12), 1e-12)));
  EXPECT_NEAR(dry.result.scalars.runout_m, f.result.scalars.runout_m, 3) << "within a cell";
}

TEST(Erosion, MapHoldsTheVolume) {
  Scenario s = slide(limited(growing(5e-3), 0.4));
  for (const double cell : {2.5, 6.0}) {
    s.hazard.cell_size_m = cell;
    const Finished f = run(s);
    const auto& depth = f.result.layer(PeakLayer::eroded);
    const double volume = std::accumulate(depth.begin(), depth.end(), 0.0) * cell * cell;
    EXPECT_NEAR(volume, f.result.scalars.eroded_volume_m3, 1e-5 * volume) << cell;
    expect_accounts(f);
  }
}

/// Rates that no flow has, and hardly anything to take.
TEST(Erosion, HoldsAtHugeRatesAndTinySupplies) {
  ErosionSpec stress, jump;
  stress.law = ErosionLaw::shear_stress;
  stress.rate_m_s = Uncertain(10), stress.depth_per_stress_m_per_kpa = Uncertain(100);
  stress.critical_stress_kpa = Uncertain(0);
  jump.law = ErosionLaw::momentum_jump;
  jump.bed_friction_coefficient = Uncertain(0), jump.bed_pore_pressure_ratio = Uncertain(0);
  for (const ErosionSpec& e : {growing(1), stress, jump})
    for (const double depth : {1e-9, 1e-3, 20.0}) {
      Scenario s = slide(limited(e, depth));
      s.numerics.spacing_m = 6;
      s.erosion->bed_density_kg_m3 = Uncertain(depth > 1 ? 10000 : 100);
      const Finished f = run(s);
      EXPECT_TRUE(is_valid(f.result.outcome)) << f.result.reason;
      EXPECT_LE(f.result.scalars.max_eroded_depth_m, depth * (1 + 1e-12));
      expect_accounts(f);
      for (const float v : f.result.layer(PeakLayer::eroded)) ASSERT_GE(v, 0);
    }
}

/// A mixture whose bed brings grains, water and pressure of its own.
Scenario wet_sheet(std::optional<double> bed_pressure_ratio) {
  Scenario s = sheet(20, std::tan(36 * degree), 2, 10);
  s.mixture.emplace();
  s.mixture->permeability_m2 = Uncertain(1e-9);
  s.grains->solid_fraction = Uncertain(0.58);
  s.erosion = limited(growing(0.01), 2);
  if (bed_pressure_ratio) s.erosion->bed_pore_pressure_ratio = Uncertain(*bed_pressure_ratio);
  return s;
}

TEST(Erosion, OfASaturatedBedKeepsGrainsAndWater) {
  const Finished f = run(wet_sheet(std::nullopt));
  const MemberScalars& m = f.result.scalars;
  EXPECT_GT(m.volume_growth, 1.02);
  EXPECT_LT(std::abs(m.solids_error), 1e-12);
  EXPECT_LT(std::abs(m.water_error), 1e-12);
  const MovingSet& p = f.simulation.parts().state.grains();
  const auto &solids = p.scalar(fields::solids_volume), &water = p.scalar(fields::water_volume);
  const GrainsSpec grains = *wet_sheet(std::nullopt).grains;
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    mass += grains.density_kg_m3.value * solids[i] + 1000 * water[i];
  EXPECT_NEAR(mass, mass_of(f), 1e-11 * mass) << "mass and volumes say the same";
  const double bed = 0.64 * grains.density_kg_m3.value + 0.36 * 1000;
  EXPECT_NEAR(m.entrained_mass_kg, bed * m.eroded_volume_m3, 1e-11 * mass);
  EXPECT_LT(std::abs(m.energy_residual), 0.01);
}

TEST(Erosion, OfALiquefiedBedLetsAMixtureRunFarther) {
  const Finished still = run(wet_sheet(std::nullopt)), liquefied = run(wet_sheet(1.0));
  EXPECT_GT(liquefied.result.scalars.front_travel_m, still.result.scalars.front_travel_m);
}

TEST(Erosion, SaysWhenFewColumnsStandForMuchMass) {
  const Finished f = run(slide(growing(0.02)));
  EXPECT_NE(f.result.warnings.find("grew by more than 10 times"), std::string::npos)
      << f.result.warnings << " " << f.result.scalars.volume_growth;
  const Finished usual = run(slide(growing(1e-3)));
  EXPECT_EQ(usual.result.warnings.find("grew by more"), std::string::npos);
}

}  // namespace
}  // namespace sturz::test
