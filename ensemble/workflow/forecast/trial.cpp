// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/forecast/trial.hpp"

#include "engine/core/error.hpp"
#include "engine/core/thread_time.hpp"
#include "ensemble/members/executor.hpp"
#include "ensemble/workflow/machine/temporary_folder.hpp"
#include "io/files/io_error.hpp"
#include "io/members/member_file.hpp"
#include "io/members/member_writer.hpp"
#include "io/members/packs/pack_record.hpp"
#include "io/site/hazard_grid.hpp"
#include "scenarios/assembly/discrete/discrete_plan.hpp"
#include "scenarios/assembly/ground.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace sturz::workflow {
namespace {

namespace fs = std::filesystem;

constexpr int most_members = 24, least_members = 3, wanted_members = 6;
/// A twin this little coarser saves nothing: then it is the scene itself.
constexpr double hardly_coarser = 1.15;

bool is_columns(const SceneDescription& d) {
  return d.formulation == to_string(Formulation::depth_averaged);
}

/// Work goes with spacing to minus this power.
double cost_power(const SceneDescription& d) { return is_columns(d) ? 3 : 4; }

/// A twin still has some sixty particles, and at least one layer of them.
double coarsest(const SceneDescription& d) {
  const double fewest = 60;
  const auto n = static_cast<double>(std::max<std::size_t>(d.n_particles, 1));
  const double by_number = std::pow(n / fewest, is_columns(d) ? 1.0 / 2 : 1.0 / 3);
  return std::max(1.0, is_columns(d) ? by_number : std::min(by_number, d.layers));
}

/// The scene at `coarser` times the spacing and the maps' cell, to compute members of.
class Twin {
 public:
  /// \param packed members are kept in packs
  Twin(const Scene& scene, double coarser, const TrialLimits& limits, bool packed)
      : scene_(scene),
        coarser_(coarser),
        packed_(packed),
        limits_(limits),
        ground_(scene.scenario, inputs_of(scene, coarser)) {
    if (coarser_ > 1) described_ = describe_on_ground(at_spacing(scene.medians));
  }

  /// \param numbers of a member of the scene \throws SetupError; Cancelled
  TriedMember tried(const Scenario& numbers, std::int64_t member) {
    const Scenario twin = at_spacing(numbers);
    const double begin = thread_cpu_seconds();
    double came = 0, limit = 0;  // of the member's own time
    RunControl control;
    control.progress_every_s = std::min(control.progress_every_s, 0.1 * limits_.longest_s);
    control.on_progress = [&](const Progress& p) {
      came = p.time_s, limit = p.end_time_s;
      return !limits_.cancel.raised() && thread_cpu_seconds() - begin < limits_.longest_s;
    };
    double cpu_s = 0;
    const MemberResult result = ground_.computed([&](const SceneInputs& inputs) {
      const double start = thread_cpu_seconds();
      MemberResult r = assemble(twin, inputs, member, 1).run(control);
      cpu_s = thread_cpu_seconds() - start;
      return r;
    });
    limits_.cancel.check();
    TriedMember m = as_the_scene(result, cpu_s, numbers);
    if (result.outcome == Outcome::cancelled) m.longer = std::max(1.0, limit / came);
    return m;
  }

 private:
  static SceneInputs inputs_of(const Scene& scene, double coarser) {
    SceneInputs inputs = *scene.ground->now();
    if (coarser == 1) return inputs;
    Scenario twin = scene.scenario;
    twin.numerics.spacing_m *= coarser;
    twin.hazard.cell_size_m = inputs.hazard_grid.cell_m * coarser;
    inputs.hazard_grid = hazard_grid(twin, inputs.terrain_grid());
    inputs.column_ground = nullptr;
    prepare_grounds(twin, inputs);
    return inputs;
  }

  /// In the formulation that the member has at its own spacing.
  Scenario at_spacing(Scenario numbers) const {
    if (coarser_ == 1) return numbers;
    numbers.formulation =
        from_word<Formulation>(own_description(numbers).formulation).value_or(numbers.formulation);
    numbers.numerics.spacing_m *= coarser_;
    scale_grains(numbers, coarser_);
    numbers.numerics.accept_unresolved = true;
    return numbers;
  }

  SceneDescription describe_on_ground(const Scenario& numbers) const {
    return describe(numbers, *ground_.now());
  }

  /// Whether members are to be looked at one by one: where they may be computed unlike, or where
  /// whole layers of particles jump with their thickness. Of very many particles it takes too long.
  bool one_by_one(const Scenario& numbers) const {
    if (numbers.formulation == Formulation::automatic) return true;
    return !is_columns(scene_.description) && scene_.description.n_particles < 100'000;
  }

  /// Of a member at its own spacing; that of the medians where they are much alike.
  SceneDescription own_description(const Scenario& numbers) const {
    return one_by_one(numbers) ? describe(numbers, *scene_.ground->now()) : scene_.description;
  }

  /// Steps and particle updates of the scene's member over those of its twin.
  std::pair<double, double> ratios(const Scenario& numbers) const {
    if (coarser_ == 1) return {1, 1};
    const SceneDescription own = own_description(numbers);
    const SceneDescription twin =
        one_by_one(numbers) ? describe_on_ground(at_spacing(numbers)) : described_;
    const double described = own.n_steps / std::max(twin.n_steps, 1.0);
    // Cells of the ground bound fast columns besides their spacing, which described steps know
    // less.
    const double steps = is_columns(own) ? std::pow(described, 0.85) : described;
    const double particles = static_cast<double>(own.n_particles) /
                             static_cast<double>(std::max<std::size_t>(twin.n_particles, 1));
    return {steps, steps * particles};
  }

  TriedMember as_the_scene(const MemberResult& result, double cpu_s, const Scenario& numbers) {
    const auto [steps, updates] = ratios(numbers);
    const double cells = coarser_ * coarser_;
    TriedMember m;
    m.steps = result.scalars.n_steps * steps;
    m.touched_cells = cells * static_cast<double>(std::count_if(
                                  result.layer(PeakLayer::arrival).begin(),
                                  result.layer(PeakLayer::arrival).end(),
                                  [](float arrival) { return !std::isnan(arrival); }));
    m.window = in_the_scene(result.window);
    const double begin = thread_cpu_seconds();
    m.file_bytes = stored_bytes(result);
    const double written_s = thread_cpu_seconds() - begin;
    if (coarser_ > 1 && result.window.n_cells() > 0) {  // what a file has besides does not grow
      MemberResult bare = result;
      bare.window = {result.window.row0, result.window.col0, 1, 1};
      for (auto& layer : bare.layers) layer.resize(std::min<std::size_t>(layer.size(), 1));
      const double fixed = stored_bytes(bare);
      m.file_bytes = fixed + cells * std::max(0.0, m.file_bytes - fixed);
    }
    m.cpu_s = cpu_s * updates + written_s;
    return m;
  }

  Window in_the_scene(const Window& w) const {
    const auto down = [this](int i) { return static_cast<int>(i * coarser_); };
    const auto up = [this](int i) { return static_cast<int>(std::ceil(i * coarser_)); };
    return window_between(down(w.row0), up(w.end_row()), down(w.col0), up(w.end_col()),
                          scene_.inputs.hazard_grid);
  }

  double stored_bytes(const MemberResult& result) const {
    if (packed_) return static_cast<double>(encode_record(result, {}).size());
    const TemporaryFolder folder;
    write_member(folder.path(), result);
    return static_cast<double>(fs::file_size(folder.path() / member_file_name(result.member)));
  }

  const Scene& scene_;
  double coarser_;
  bool packed_;
  TrialLimits limits_;
  GrowingGround ground_;  // of its own: the scene's manifest names only what members read
  SceneDescription described_;
};

/// Which members stand for all. Drawn designs begin with rows that fill the space (every eighth
/// point of a Sobol sequence does not); a table may be sorted.
std::vector<std::int64_t> chosen(const DesignTable& design, std::int64_t n) {
  const std::int64_t all = design.n_members();
  n = std::min(n, all);
  std::vector<std::int64_t> members;
  for (std::int64_t i = 0; i < n; ++i)
    members.push_back(design.design == Design::table ? (2 * i + 1) * all / (2 * n) : i);
  return members;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Some of the design, side by side. One that cannot be built fails at once in the ensemble too.
void try_some(const Scene& scene, const DesignTable& design, Twin& twin, std::int64_t n,
              const TrialLimits& limits, Trial& trial) {
  const std::vector<std::int64_t> members = chosen(design, n);
  std::vector<TriedMember> tried(members.size());
  std::vector<double> cpu_s(members.size()), wall_s(members.size());
  const std::atomic<bool> never{false};
  make_executor(limits.workers)->for_each(members.size(), never, [&](std::size_t i) {
    const auto start = Clock::now();
    const double begin = thread_cpu_seconds();
    try {
      tried[i] = twin.tried(member_scenario(scene.scenario, design, members[i]), members[i]);
    } catch (const IoError&) {
      throw;
    } catch (const SetupError&) {  // fails at once
    }
    cpu_s[i] = thread_cpu_seconds() - begin;
    wall_s[i] = seconds_since(start);
  });
  const double cpu = std::accumulate(cpu_s.begin(), cpu_s.end(), 0.0);
  const double wall = std::accumulate(wall_s.begin(), wall_s.end(), 0.0);
  trial.members = std::move(tried);
  trial.cpu_s += cpu;
  if (cpu > 0) trial.slowdown = std::max(1.0, wall / cpu);
}

void not_tried(Trial& trial, std::string why) {
  trial.median.reset();
  trial.members.clear();
  trial.failure = std::move(why);
}

}  // namespace

Trial try_members(const Scene& scene, const DesignTable* design, const TrialLimits& limits) {
  Trial trial;
  const SceneDescription& d = scene.description;
  const double power = cost_power(d), most = coarsest(d);
  const auto for_cost = [&](double coarser, double takes_s, double may_take_s) {
    const double c = std::clamp(coarser * std::pow(takes_s / may_take_s, 1 / power), 1.0, most);
    return c < hardly_coarser ? 1.0 : c;
  };
  const bool packed = design != nullptr && design->n_members() > most_member_files;
  const auto timed = [&](Twin& twin, const Scenario& numbers) {
    const auto start = Clock::now();
    const double begin = thread_cpu_seconds();
    const TriedMember tried = twin.tried(numbers, 0);
    const double cpu_s = thread_cpu_seconds() - begin;
    trial.cpu_s += cpu_s;
    trial.slowdown = std::max(1.0, seconds_since(start) / std::max(cpu_s, 1e-6));
    const bool ended = tried.longer == 1;
    if (ended) trial.median = tried;
    return std::pair(ended, cpu_s);
  };
  try {
    trial.coarser = for_cost(1, d.predicted_seconds, 0.15 * limits.budget_s);
    auto twin = std::make_unique<Twin>(scene, trial.coarser, limits, packed);
    auto [ended, took_s] = timed(*twin, scene.medians);
    if (!ended) return trial;
    const double share_s = 0.75 * limits.budget_s / (design != nullptr ? wanted_members + 1 : 1);
    const double better = for_cost(trial.coarser, took_s, share_s);
    if (better < 0.85 * trial.coarser) {
      const double promised_s = trial.median->cpu_s;
      auto finer = std::make_unique<Twin>(scene, better, limits, packed);
      const auto [ended_too, finer_took_s] = timed(*finer, scene.medians);
      if (ended_too) {
        trial.surprise = std::exp(std::abs(std::log(promised_s / trial.median->cpu_s)));
        trial.coarser = better, twin = std::move(finer), took_s = finer_took_s;
      }
    }
    if (design == nullptr || design->n_members() == 0) return trial;
    const auto n = static_cast<std::int64_t>(0.75 * limits.budget_s / std::max(took_s, 1e-4));
    try_some(scene, *design, *twin, std::clamp<std::int64_t>(n, least_members, most_members),
             limits, trial);
  } catch (const IoError& problem) {
    not_tried(trial, problem.what());  // no room for a member's file: no reason not to compute
  } catch (const fs::filesystem_error& problem) {
    not_tried(trial,
              "there is no folder for temporary files (TMPDIR): " + problem.code().message());
  } catch (const SetupError&) {
    // What is coarser may be no scene; the ensemble itself says what is wrong.
    not_tried(trial, "");
  }
  return trial;
}

}  // namespace sturz::workflow
