// SPDX-License-Identifier: Apache-2.0
/// No memory is asked for inside a step once the first ones are done. A binary of its own because
/// it replaces operator new for everything in it.
#include "engine/simulation/parts.hpp"
#include "engine/simulation/simulation.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/engine/effects/coupling/coupled_sets.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace {

std::atomic<long> n_allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++n_allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* p = std::aligned_alloc(alignment, whole ? whole : alignment);
  if (!p) throw std::bad_alloc();
  return p;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new[](std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) {
  return counted(size, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t size, std::align_val_t a) {
  return counted(size, static_cast<std::size_t>(a));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace sturz {
namespace {

/// Allocations of `steps` steps after `warm_up` steps.
long allocations(const Scenario& s, int warm_up, int steps, bool rebuild) {
  Simulation simulation = assemble(s, load_scene_inputs(s), 0, 1);
  for (int n = 0; n < warm_up; ++n) simulation.step();
  const long before = n_allocations;
  for (int n = 0; n < steps; ++n) {
    if (rebuild) simulation.parts().state.grains().order_changed = true;
    simulation.step();
  }
  return n_allocations - before;
}

TEST(Allocation, IsCounted) {
  const long before = n_allocations;
  std::vector<int>(100).swap(*std::make_unique<std::vector<int>>());
  EXPECT_GT(n_allocations, before);
}

TEST(Allocation, AStepNeedsNoNewMemory) {
  EXPECT_EQ(allocations(ramp_slide(90, 4), 1, 40, false), 0);
  EXPECT_EQ(allocations(column_collapse(1, 12), 1, 20, false), 0);
}

TEST(Allocation, AMovingMassAsksOnlyWhenItsListsOutgrowTheirRoom) {
  EXPECT_LE(allocations(ramp_slide(90, 4), 1, 400, false), 4);
}

TEST(Allocation, ARebuildOfTheListsSettlesIntoItsMemory) {
  // Lists that grow may ask for more now and then, but not every time.
  Scenario s = ramp_slide(90, 4);
  EXPECT_LE(allocations(s, 20, 100, true), 10);
}

/// A collapsing column of liquid behind a wall. While it stays within the skin of its lists it asks
/// for nothing, beyond that only where they grow.
TEST(Allocation, AStepOfLiquidNeedsNoNewMemory) {
  test::LiquidBox box;
  box.n = {8, 4, 16};
  box.domain.y = {true, 0, 0.4, 0};
  box.domain.walls = {Wall{{0, 0, 0}, {1, 0, 0}}};
  box.settings.law = {50, 1, 0.5};
  test::HandMade made = test::liquid_of(box);
  made.advance();
  long before = n_allocations;
  for (int n = 0; n < 40; ++n) made.advance();
  EXPECT_EQ(n_allocations - before, 0);
  before = n_allocations;
  for (int n = 0; n < 400; ++n) made.advance();
  EXPECT_LE(n_allocations - before, 10);
}

Scenario as_columns(Scenario s) {
  s.formulation = Formulation::depth_averaged;
  return s;
}

TEST(Allocation, AStepOfColumnsNeedsNoNewMemory) {
  // Support radii settle and columns come to the period's edges within the first steps.
  const int settled = 60;
  Scenario sheet = as_columns(thin_sheet(1));  // periodic
  EXPECT_EQ(allocations(sheet, settled, 100, false), 0);
  sheet.grains->earth_pressure = LateralPressure::active_passive;
  sheet.basal.turbulent_coefficient_m_s2 = Uncertain(200);
  EXPECT_EQ(allocations(sheet, settled, 100, false), 0);
  // A wall, a period and columns at rest.
  Scenario box = as_columns(column_collapse(1, 12));
  box.basal.friction_coefficient = 2;
  EXPECT_EQ(allocations(box, settled, 100, false), 0);
}

TEST(Allocation, ASpreadingFlowOfColumnsAsksOnlyWhenItsCellsOutgrowTheirRoom) {
  // Tables of cells and runs grow by factors: a handful of times while the flow doubles its extent.
  EXPECT_LE(allocations(similarity_slide(), 4, 100, false), 8);
}

TEST(Allocation, AStepOfGrainsInLiquidNeedsNoNewMemory) {
  auto sets = test::full_pores(10, 0.2);
  sets[0].velocity = {0.5, 0, 0};
  test::CoupledSets made = test::coupled_sets(sets[0], sets[1], test::periodic_box(10), {});
  const auto asked = [&](int steps, double dt) {
    const long before = n_allocations;
    for (int n = 0; n < steps; ++n) made.step.apply(made.state, dt);
    return n_allocations - before;
  };
  asked(1, 1e-3);
  EXPECT_EQ(asked(20, 1e-3), 0) << "no new lists";
  asked(20, 0.1);
  EXPECT_LE(asked(40, 0.1), 4) << "new lists every few steps";
}

}  // namespace
}  // namespace sturz
