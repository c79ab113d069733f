// SPDX-License-Identifier: Apache-2.0
/// The sweep over columns against its slow twin, and what its sums must keep.
#include "tests/support/slow_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <string>
#include <utility>

namespace sturz {
namespace {

using test::ColumnRates;
using test::SlowColumn;

const ColumnConstants constants{0.5};
const Vec3 utm_corner(412345.678, 5123456.789, 1234.5);

std::vector<InstructionSet> supported() {
  std::vector<InstructionSet> out;
  for (auto isa : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512})
    if (supports(isa)) out.push_back(isa);
  return out;
}

/// Columns that differ in everything, on rolling ground.
std::vector<SlowColumn> rough_flow(int n, double width, double height, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<SlowColumn> out(n);
  for (SlowColumn& c : out) {
    const double x = 0.5 * width * (1 + u(random)), y = 0.5 * height * (1 + u(random));
    c.position = {x, y, 3 * std::sin(x / 9) - 0.4 * y};
    c.velocity = {12 + 4 * u(random), 5 * u(random), 3 * u(random)};
    c.volume = 4 + u(random);
    c.support_radius = 5 + 2 * u(random);
    c.thickness = 2 + 1.8 * u(random);
    c.lateral = (1.6 + 1.3 * u(random)) * 8;  // K from 0.3 to 2.9
  }
  return out;
}

/// sqrt(sum |a - b|^2 / sum |b|^2) of one part of the rates.
using Part = Vec3 (*)(const ColumnRates&);
double relative_error(const std::vector<ColumnRates>& a, const std::vector<ColumnRates>& b,
                      Part part) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (part(a[i]) - part(b[i])).squaredNorm();
    size += part(b[i]).squaredNorm();
  }
  return std::sqrt(difference / size);
}

const std::vector<std::pair<std::string, Part>> parts{
    {"thickness",
     [](const ColumnRates& r) -> Vec3 {
       return {r.thickness, 0, 0};
     }},
    {"density",
     [](const ColumnRates& r) -> Vec3 {
       return {r.density, 0, 0};
     }},
    {"acceleration", [](const ColumnRates& r) -> Vec3 { return r.acceleration; }},
    {"divergence",
     [](const ColumnRates& r) -> Vec3 {
       return {r.divergence, 0, 0};
     }},
    {"approach", [](const ColumnRates& r) -> Vec3 {
       return {r.approach, 0, 0};
     }}};

/// Float sums of a hundred pairs, each some roundings of 6e-8; measured: 2.5e-7.
void expect_equal(const std::vector<ColumnRates>& fast, const std::vector<ColumnRates>& slow) {
  for (const auto& [name, part] : parts) EXPECT_LT(relative_error(fast, slow, part), 1e-6) << name;
}

TEST(ColumnSweep, EqualsTheSlowTwin) {
  const auto flow = rough_flow(600, 50, 40);
  const auto slow = test::slow_columns(flow, {}, constants);
  for (auto isa : supported()) {
    SCOPED_TRACE(to_string(isa));
    expect_equal(test::fast_columns(flow, constants, isa).rates, slow);
  }
}

/// Steep ground in part of the flow: rises count by the shares of both columns.
std::vector<SlowColumn> flow_at_a_wall() {
  auto flow = rough_flow(600, 50, 40);
  for (SlowColumn& c : flow) {
    c.share = std::clamp((30 - c.position.x()) / 15, 0.0, 1.0);
    if (c.position.x() > 30) c.position.z() += 4 * (c.position.x() - 30);
  }
  return flow;
}

TEST(ColumnSweep, EqualsTheSlowTwinAtAWall) {
  const auto flow = flow_at_a_wall();
  const auto slow = test::slow_columns(flow, {}, constants);
  for (auto isa : supported()) expect_equal(test::fast_columns(flow, {0.5, true}, isa).rates, slow);
}

TEST(ColumnSweep, OnAWallNoRiseCounts) {
  auto flow = rough_flow(300, 30, 20);
  for (SlowColumn& c : flow) c.share = 0;
  const ColumnConstants steep{0.5, true};
  const auto isa = best_instruction_set();
  const auto uneven = test::fast_columns(flow, steep, isa).rates;
  for (SlowColumn& c : flow) c.position.z() = 0;
  const auto level = test::fast_columns(flow, steep, isa).rates;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    // Fixed-point units differ with the extent.
    EXPECT_NEAR(uneven[i].thickness, level[i].thickness, 1e-5 * level[i].thickness);
    EXPECT_EQ(uneven[i].acceleration.z(), 0);
  }
}

/// Bits of scenes without steep ground are those of the loop that knows no share.
TEST(ColumnSweep, WholeSharesChangeNoBit) {
  const auto flow = rough_flow(600, 50, 40);
  for (auto isa : supported()) {
    const auto a = test::fast_columns(flow, {0.5, false}, isa).raw;
    const auto b = test::fast_columns(flow, {0.5, true}, isa).raw;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0) << to_string(isa);
  }
}

TEST(ColumnSweep, IsAsExactFarFromTheOrigin) {
  auto flow = rough_flow(600, 50, 40);
  for (SlowColumn& c : flow) c.position += utm_corner;
  expect_equal(test::fast_columns(flow, constants, best_instruction_set()).rates,
               test::slow_columns(flow, {}, constants));
}

TEST(ColumnSweep, IsAsExactInADenseCrowdAndForFewColumns) {
  for (const auto& [n, size] : {std::pair(200, 3.0), {17, 6.0}, {16, 6.0}, {3, 2.0}}) {
    const auto flow = rough_flow(n, size, size);
    expect_equal(test::fast_columns(flow, constants, best_instruction_set()).rates,
                 test::slow_columns(flow, {}, constants));
  }
}

TEST(ColumnSweep, PeriodicImagesCountAsColumns) {
  Domain d;
  d.x = {true, 0, 50, -3.5}, d.y = {true, 0, 40, 2};
  const auto flow = rough_flow(500, 50, 40);
  std::vector<SlowColumn> images;
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (SlowColumn c : flow) {
        if (a == 0 && b == 0) continue;
        c.position += Vec3(50 * a, 40 * b, -3.5 * a + 2 * b);
        images.push_back(c);
      }
  expect_equal(test::fast_columns(flow, constants, best_instruction_set(), d).rates,
               test::slow_columns(flow, images, constants));
}

TEST(ColumnSweep, Avx2AndAvx512GiveTheSameBits) {
  if (!supports(InstructionSet::avx512)) GTEST_SKIP() << "this processor has no AVX-512";
  const auto flow = rough_flow(700, 50, 40);
  const auto a = test::fast_columns(flow, constants, InstructionSet::avx2).raw;
  const auto b = test::fast_columns(flow, constants, InstructionSet::avx512).raw;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}

TEST(ColumnSweep, PlainAgreesWithinRounding) {
  const auto flow = rough_flow(700, 50, 40);
  expect_equal(test::fast_columns(flow, constants, InstructionSet::plain).rates,
               test::fast_columns(flow, constants, best_instruction_set()).rates);
}

TEST(ColumnSweep, ALoneColumnMeetsOnlyItself) {
  auto flow = rough_flow(40, 20, 20);
  flow.push_back(flow[0]);
  flow.back().position += Vec3(900, -700, 50);
  const ColumnRates single =
      test::fast_columns(flow, constants, best_instruction_set()).rates.back();
  const double own = 7 / (std::numbers::pi * flow[0].support_radius * flow[0].support_radius);
  EXPECT_NEAR(single.density, own, 1e-6 * own);
  EXPECT_NEAR(single.thickness, flow[0].volume * own, 1e-6 * flow[0].volume * own);
  EXPECT_EQ(single.acceleration, Vec3(0, 0, 0));
  EXPECT_EQ(single.divergence, 0);
  EXPECT_EQ(single.approach, 0);
}

TEST(ColumnSweep, PairForcesCancel) {
  const auto flow = flow_at_a_wall();
  const auto slow = test::slow_columns(flow, {}, constants);
  for (auto isa : supported()) {
    const auto fast = test::fast_columns(flow, {0.5, true}, isa).rates;
    Vec3 sum(0, 0, 0);
    double scale = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
      sum += flow[i].volume * fast[i].acceleration;
      scale += flow[i].volume * slow[i].pull;
    }
    // Both sides of a pair round on their own; measured: 3e-9.
    EXPECT_LT(sum.norm(), 2e-8 * scale) << to_string(isa);
  }
}

/// n x n columns of 1 m^3 on a lattice of 1 m, so 1 m thick; support radius 4 m.
std::vector<SlowColumn> lattice(int n) {
  std::vector<SlowColumn> out(static_cast<std::size_t>(n) * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out[static_cast<std::size_t>(i) * n + j].position = {1.0 * i, 1.0 * j, 0};
  return out;
}

TEST(ColumnSweep, AnEvenLatticeHasItsThicknessAndNoAcceleration) {
  const int n = 24;
  const auto rates = test::fast_columns(lattice(n), constants, best_instruction_set()).rates;
  for (int i = 4; i < n - 4; ++i)
    for (int j = 4; j < n - 4; ++j) {
      const ColumnRates& r = rates[static_cast<std::size_t>(i) * n + j];
      EXPECT_NEAR(r.thickness, 1, 0.01);
      EXPECT_NEAR(r.density, 1, 0.01);
      // Pairs of some 0.5 m/s^2 cancel but for their rounding; measured: 2.4e-7.
      EXPECT_LT(r.acceleration.norm(), 2e-6);
    }
  EXPECT_GT(rates[0].acceleration.norm(), 1) << "a free edge is pushed outward";
  EXPECT_LT(rates[0].acceleration.x(), 0);
  EXPECT_LT(rates[0].acceleration.y(), 0);
}

TEST(ColumnSweep, DivergenceOverThicknessIsThatOfAnEvenExpansion) {
  const int n = 20;
  auto flow = lattice(n);
  for (SlowColumn& c : flow) c.velocity = {0.3 * c.position.x(), -0.1 * c.position.y(), 0};
  const auto rates = test::fast_columns(flow, constants, best_instruction_set()).rates;
  const ColumnRates& r = rates[static_cast<std::size_t>(10) * n + 10];
  EXPECT_NEAR(r.divergence / r.thickness, 0.2, 0.01 * 0.2);
  // Columns four metres off are the fastest, but weigh nothing: (0.3 * 3)^2 beside (0.1 * 2)^2.
  EXPECT_NEAR(r.approach, 0.81 + 0.04, 1e-5);
}

TEST(ColumnSweep, ViscosityActsBetweenApproachingColumnsOnly) {
  std::vector<SlowColumn> pair(2);
  pair[1].position = {1.5, 0, 0};
  const auto push = [&](double approach, double viscosity) {
    pair[0].velocity = {approach, 0, 0};
    return test::fast_columns(pair, {viscosity}, best_instruction_set()).rates[0].acceleration.x();
  };
  EXPECT_LT(push(0, 0.5), 0) << "the other's thickness pushes it away";
  EXPECT_LT(push(2, 0.5), push(0, 0.5));
  EXPECT_EQ(push(-2, 0.5), push(0, 0.5));
  EXPECT_EQ(push(2, 0), push(0, 0));
}

}  // namespace
}  // namespace sturz
