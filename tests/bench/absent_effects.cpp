// SPDX-License-Identifier: Apache-2.0
// Pairs of members that differ by one effect which moves nothing.
#include "engine/core/error.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/memory.hpp"
#include "tests/bench/measure/pairs.hpp"
#include "tests/bench/reference/by_hand.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/slices.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace sturz::bench {
namespace {

constexpr double most_time_ratio = 1.02;

/// A member under test, however it was put together.
struct Moving {
  std::shared_ptr<void> owner;
  State* state = nullptr;
  Step* step = nullptr;
};

Moving assembled(const Scene& scene) {
  auto member = std::make_shared<Simulation>(assemble(scene.scenario, scene.inputs, 0, 1));
  return {member, &member->parts().state, &member->parts().step};
}

Moving plain(const Scene& scene) {
  auto made = std::make_shared<ByHand>(by_hand(plan_scene(scene.scenario, scene.inputs, 0)));
  return {made, &made->state, &made->step};
}

Scene with_far_wall(Scene scene) {
  scene.scenario.domain.walls = {WallSpec{{-5000, 0, 0}, {1, 0, 0}, 0, std::nullopt}};
  return scene;
}

Scene with_removed_wall(Scene scene) {
  scene.scenario.domain.walls = {WallSpec{{-5000, 0, 0}, {1, 0, 0}, 0, 0.0}};
  return scene;
}

/// A zone that covers no cell.
Scene with_empty_zone(Scene scene) {
  BasalZone zone;
  zone.friction_coefficient = 0.3;
  scene.scenario.basal.zones = {zone};
  scene.inputs.zones =
      std::make_shared<const Raster<std::uint8_t>>(scene.inputs.elevation->grid, std::uint8_t{0});
  return scene;
}

Scene with_active_passive(Scene scene) {
  scene.scenario.grains->earth_pressure = LateralPressure::active_passive;
  return scene;
}

/// Whether every particle is at the same place, bit by bit, whatever the order of storage.
bool same_places(const ParticleSet& a, const ParticleSet& b) {
  if (a.size() != b.size()) return false;
  std::vector<std::size_t> at(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) at[a.id[i]] = i;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const std::size_t k = at[b.id[i]];
    if (a.x[k] != b.x[i] || a.y[k] != b.y[i] || a.z[k] != b.z[i]) return false;
  }
  return true;
}

class Comparison {
 public:
  explicit Comparison(int pairs) : pairs_(pairs) {}

  /// \param must  the limits of an absent effect apply
  void add(const std::string& what, bool must, Moving with, Moving without) {
    const Pairs times = alternate(
        pairs_, [&] { return cpu_slice(*with.state, *with.step); },
        [&] { return cpu_slice(*without.state, *without.step); });
    const Summary ratio = times.ratio();
    const MemoryPerParticle a = memory_per_particle(*with.state, *with.step);
    const MemoryPerParticle b = memory_per_particle(*without.state, *without.step);
    const auto passes = [](const Moving& m) { return m.step->pass_names(); };
    const bool holds = ratio.low < most_time_ratio && a.set == b.set && a.state == b.state &&
                       a.passes == b.passes && passes(with) == passes(without);
    if (must)
      figures_.push_back({what, ratio.median, ratio.low, ratio.high, false,
                          fmt::format("{}: effects that the scene does not call for cost {:+.1f} % "
                                      "of a step.",
                                      what, 100 * (ratio.median - 1))});
    table_.add({cell(what), cell(with.state->grains().size()), interval_cell(ratio, 4),
                cell(a.total(), 1), cell(b.total(), 1),
                cell(static_cast<int>(passes(with).size() - passes(without).size())),
                yes_no(same_places(with.state->grains(), without.state->grains())),
                must ? yes_no(holds) : cell("-")});
  }
  Table take() { return std::move(table_); }
  std::vector<Figure> figures() const { return figures_; }

 private:
  int pairs_;
  std::vector<Figure> figures_;
  Table table_{"absent_effects",
               "A member with an effect that moves nothing over the same without, thread time",
               {{"comparison", "with / without"},
                {"particles", "particles"},
                {"time_ratio", "time/step [95 %]"},
                {"bytes_with", "bytes/particle with"},
                {"bytes_without", "without"},
                {"more_passes", "more passes"},
                {"same_places", "same bits"},
                {"holds", "holds"}}};
};

}  // namespace

Report absent_effects(const Options& options) {
  Comparison all(options.pairs);
  const Scene grains = dense_slide(options.quick ? 4'000 : 12'000), thin = thin_slide();
  const Scene columns = column_slide(options.quick ? 2'500 : 10'000);
  for (const Scene* scene : {&grains, &thin, &columns})
    all.add(scene->name + ": assembled / by hand", true, assembled(*scene), plain(*scene));
  for (const Scene* scene : {&grains, &columns}) {
    all.add(scene->name + ": a far wall / none", false, assembled(with_far_wall(*scene)),
            assembled(*scene));
    all.add(scene->name + ": a wall long removed / none", false,
            assembled(with_removed_wall(*scene)), assembled(*scene));
    all.add(scene->name + ": zones that cover nothing / none", false,
            assembled(with_empty_zone(*scene)), assembled(*scene));
  }
  all.add(columns.name + ": earth pressure active_passive / isotropic", false,
          assembled(with_active_passive(columns)), assembled(columns));
  Report report;
  report.figures = all.figures();
  report.tables.push_back(all.take());
  report.notes = {
      "By hand: the engine's effects alone (grain stress, gravity, terrain contact, motion; or "
      "columns), without walls, zones, earth pressure, turbulence or viscosity of the bed.",
      "Holds: the interval's near end is below 1.02, the bytes are equal and no pass is more. "
      "Rows without a verdict tell what an effect costs that is there and has nothing to do; "
      "earth pressure does something."};
  return report;
}

}  // namespace sturz::bench
