// SPDX-License-Identifier: Apache-2.0
// End to end through assemble and Simulation::run, pass by pass, and against the reference step.
#include "scenarios/assembly/assemble.hpp"
#include "tests/bench/commands.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/measure/fma_peak.hpp"
#include "tests/bench/measure/machine.hpp"
#include "tests/bench/measure/memory.hpp"
#include "tests/bench/measure/pairs.hpp"
#include "tests/bench/measure/peers.hpp"
#include "tests/bench/reference/reference_slide.hpp"
#include "tests/bench/reference/sweep_alone.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/bench/slices.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace sturz::bench {
namespace {

/// Columns take long steps: after these they come near the end of their slope.
constexpr int most_column_slices = 21;

/// A key of JSON from a scene's name.
std::string key_of(std::string name) {
  for (char& c : name)
    if (c == ' ' || c == '.') c = '_';
  return name;
}

std::vector<double> scaled(std::vector<double> v, double factor) {
  for (double& x : v) x *= factor;
  return v;
}

/// What the allocator gave to a member that has made a slice of steps.
double heap_per_particle(const Scene& scene) {
  const std::size_t before = heap_bytes();
  Simulation member = assemble(scene.scenario, scene.inputs, 0, 1);
  SimulationParts& parts = member.parts();
  cpu_slice(parts.state, parts.step);
  return static_cast<double>(heap_bytes() - before) /
         static_cast<double>(parts.state.grains().size());
}

class Throughput {
 public:
  explicit Throughput(const Options& o) : options_(o) {}

  Report run() {
    dense(dense_slide(options_.quick ? 12'000 : 51'000), true);
    dense(thin_slide(), false);
    columns(column_slide(2'500));
    if (!options_.quick) columns(column_slide(10'000));
    report_.tables = {speed_, reference_, peers_table(dense_name_, dense_updates_s_), sweep_,
                      memory_};
    for (Table& t : passes_) report_.tables.push_back(std::move(t));
    add_notes();
    return std::move(report_);
  }

 private:
  void dense(const Scene& scene, bool guarded) {
    Simulation member = assemble(scene.scenario, scene.inputs, 0, 1);
    const ScenePlan plan = plan_scene(scene.scenario, scene.inputs, 0);
    ReferenceSlide reference(member.parts(), plan);
    std::size_t reference_updates = 0;
    const TimedRun timed_run = time_run(member, options_.pairs, [&] {
      reference_updates = slice_steps * reference.size();
      const double dt = member.parts().state.previous_dt;
      return timed(thread_seconds, [&] {
        for (int k = 0; k < slice_steps; ++k) reference.step(dt);
      });
    });
    std::vector<double> reference_speed;
    for (double s : timed_run.other_s)
      reference_speed.push_back(static_cast<double>(reference_updates) / s);
    const Summary ratio = summarize(ratios(timed_run.updates_per_s(), reference_speed));
    if (guarded && ratio.median < options_.fail_below) report_.failed = true;
    reference_.add({cell(scene.name), cell(reference.variant()),
                    range_cell(summarize(scaled(reference_speed, 1e-6)), 2),
                    interval_cell(ratio, 2), cell(reference.neighbors_per_particle(), 1),
                    cell(reference.bytes_per_particle(), 0), cell(mean_vx(member), 2),
                    cell(reference.mean_vx(), 2)});
    report_.tell(scene.name + ": engine / reference", ratio, told(scene.name, ratio.median));
    if (guarded) {
      const Summary speed = summarize(timed_run.updates_per_s());
      dense_name_ = scene.name, dense_updates_s_ = speed.median;
      report_.tell(scene.name + ": updates/s/core", speed,
                   peers_sentence(scene.name, speed.median));
    }
    finish(scene, member, timed_run);
    sweep(scene, member.parts(), plan);
  }

  void columns(const Scene& scene) {
    Simulation member = assemble(scene.scenario, scene.inputs, 0, 1);
    const int slices = std::min(options_.pairs, most_column_slices);
    const TimedRun timed_run = time_run(member, slices, {});
    finish(scene, member, timed_run);
  }

  static std::string told(const std::string& scene, double ratio) {
    return fmt::format(
        "{}: the whole step does {:.2f} times the updates of the least code for the same forces "
        "{}.",
        scene, ratio,
        ratio < 1 ? "(the rest is what that code leaves out: walls, ledger, limits, maps)"
                  : "although it does more");
  }

  static double mean_vx(const Simulation& member) {
    const ParticleSet& p = member.parts().state.grains();
    double momentum = 0, mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i) momentum += p.mass[i] * p.vx[i], mass += p.mass[i];
    return momentum / mass;
  }

  void finish(const Scene&, const Simulation&, const TimedRun&);
  void add_passes(const Scene&, const TimedRun&);
  void sweep(const Scene&, const SimulationParts&, const ScenePlan&);
  void add_notes();

  const Options& options_;
  std::string dense_name_;
  double dense_updates_s_ = 0;
  Report report_;
  Table speed_{"end_to_end",
               "End to end through assemble and Simulation::run, one core, thread time; median "
               "(range)",
               {{"scene", "scene"},
                {"particles", "particles"},
                {"layers", "thickness/spacing"},
                {"m_updates_s", "M updates/s/core"},
                {"ms_per_step", "ms/step"},
                {"slices", "slices of 16 steps"}}};
  Table reference_{"reference",
                   "Against the reference step in alternating slices; ratio: median [95 %]",
                   {{"scene", "scene"},
                    {"variant", "reference loads by"},
                    {"reference_m_updates_s", "reference M updates/s"},
                    {"ratio", "engine / reference"},
                    {"neighbors", "listed neighbours"},
                    {"reference_bytes", "its bytes/particle"},
                    {"engine_mean_vx", "mean vx m/s: engine"},
                    {"reference_mean_vx", "reference"}}};
  Table sweep_{"pair_sweep",
               "Pair sweep alone, one core, no stress smoothing; median (range)",
               {{"scene", "scene"},
                {"instruction_set", "set"},
                {"entries_per_group", "list entries/group of 16"},
                {"pairs_per_particle", "pairs within 2h/particle"},
                {"lanes_used", "lanes used"},
                {"m_updates_s", "M updates/s"},
                {"m_pairs_s", "M pairs/s"},
                {"useful_gflops", "useful GFLOP/s"},
                {"executed_gflops", "executed GFLOP/s"},
                {"peak_gflops", "FMA peak GFLOP/s"},
                {"useful_share", "useful/peak"},
                {"executed_share", "executed/peak"}}};
  Table memory_{"memory",
                "Bytes per particle",
                {{"scene", "scene"},
                 {"set", "particle set"},
                 {"passes", "passes"},
                 {"state", "state arrays"},
                 {"total", "total"},
                 {"heap", "allocated by a member"}}};
  std::vector<Table> passes_;
};

void Throughput::finish(const Scene& scene, const Simulation& member, const TimedRun& run) {
  const SimulationParts& parts = member.parts();
  const double n = run.updates[0] / slice_steps;
  speed_.add({cell(scene.name), cell(static_cast<std::size_t>(n)),
              cell(parts.facts.release.layers, 1),
              range_cell(summarize(scaled(run.updates_per_s(), 1e-6)), 2),
              range_cell(summarize(scaled(run.cpu_s, 1e3 / slice_steps)), 2),
              cell(static_cast<int>(run.cpu_s.size()))});
  const MemoryPerParticle m = memory_per_particle(parts.state, parts.step);
  memory_.add({cell(scene.name), cell(m.set, 0), cell(m.passes, 0), cell(m.state, 0),
               cell(m.total(), 0), cell(heap_per_particle(scene), 0)});
  add_passes(scene, run);
}

void Throughput::add_passes(const Scene& scene, const TimedRun& run) {
  Table t("passes_" + key_of(scene.name),
          "Passes of " + scene.name + ", wall time of the same slices",
          {{"pass", "pass"}, {"share", "share %"}, {"ns_per_update", "ns/particle-update"}});
  const double wall = run.total_wall_s(), updates = run.total_updates();
  double rest = wall;
  for (const PassTime& p : run.passes) {
    t.add({cell(p.name), cell(100 * p.seconds / wall, 1), cell(1e9 * p.seconds / updates, 1)});
    rest -= p.seconds;
  }
  t.add({cell("outside the passes: peak maps, stop rule, bookkeeping"), cell(100 * rest / wall, 1),
         cell(1e9 * rest / updates, 1)});
  t.add({cell("all"), cell(100.0, 1), cell(1e9 * wall / updates, 1)});
  passes_.push_back(std::move(t));
}

void Throughput::sweep(const Scene& scene, const SimulationParts& parts, const ScenePlan& plan) {
  for (auto set : {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::plain}) {
    if (!supports(set) || (options_.quick && set != best_instruction_set())) continue;
    SweepAlone alone(parts, plan, set);
    double burst_flops = 0;
    const Pairs pairs = alternate(
        options_.pairs, [&] { return alone.run(); },
        [&] {
          return timed(thread_seconds, [&] { burst_flops = fma_burst(best_instruction_set()); });
        });
    const double n = static_cast<double>(alone.n_particles());
    const double useful = flops_per_pair * static_cast<double>(alone.n_pairs());
    const double lanes = group_size * static_cast<double>(alone.n_entries());
    std::vector<double> rate, peak, share;
    for (std::size_t k = 0; k < pairs.a.size(); ++k) {
      rate.push_back(1 / pairs.a[k]);
      peak.push_back(1e-9 * burst_flops / pairs.b[k]);
      share.push_back(1e-9 * useful * rate[k] / peak[k]);
    }
    const double used = static_cast<double>(alone.n_pairs()) / lanes;
    sweep_.add(
        {cell(scene.name), cell(std::string(to_string(set))), cell(alone.entries_per_group(), 0),
         cell(static_cast<double>(alone.n_pairs()) / n, 1), cell(used, 3),
         range_cell(summarize(scaled(rate, 1e-6 * n)), 2),
         cell(1e-6 * static_cast<double>(alone.n_pairs()) * summarize(rate).median, 0),
         range_cell(summarize(scaled(rate, 1e-9 * useful)), 1),
         cell(1e-9 * useful / used * summarize(rate).median, 1), range_cell(summarize(peak), 0),
         interval_cell(summarize(share), 3), cell(summarize(share).median / used, 3)});
  }
}

void Throughput::add_notes() {
  report_.notes = {
      fmt::format(
          "Useful operations: {:.0f} per directed pair within 2h (a fused multiply-add "
          "counts two), as counted in tests/bench/reference/sweep_alone.hpp; executed: all lanes.",
          flops_per_pair),
      "FMA peak: twelve independent chains of fused multiply-adds in float, as wide as the best "
      "instruction set, taken in turn with the sweep.",
      "Reference step: float, one list per particle with the engine's skin, one pass over the "
      "lists vectorised by the compiler for this processor with -ffast-math, with or without "
      "gather "
      "instructions, whichever is faster here. It does velocity "
      "gradient, stress force, artificial viscosity, continuity, elastic + mu(I) update, spring "
      "ground with friction, integration. It leaves out: gradient correction, density diffusion, "
      "stress smoothing, mirror image at the ground, drag at rest, dilated grains, walls, periods, "
      "zones, losses, energy ledger, double precision, thread-independent sums, step limits, peak "
      "maps, stop rule.",
      "Bytes per particle: what the passes and arrays say at the end of the timed run; lists count "
      "their capacity. Allocated: all that the allocator holds for a member after its first 16 "
      "steps, first positions and maps included."};
}

}  // namespace

Report throughput(const Options& options) { return Throughput(options).run(); }

}  // namespace sturz::bench
