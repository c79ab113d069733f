// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/evaluation/evaluator.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/marginal.hpp"
#include "ensemble/workflow/evaluation/own_inputs.hpp"
#include "ensemble/workflow/machine/cores.hpp"
#include "io/site/scene_inputs.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>

namespace sturz::workflow {
namespace {

/// As many members at a time as are wanted and the memory holds.
int workers_for(const EvaluatorRequest& request, const SceneDescription& d) {
  const int cores = available_cores();
  const int wanted = request.workers > 0 ? request.workers : cores;
  const auto each = static_cast<double>(d.memory_bytes);
  const double room = 0.9 * available_memory_bytes();
  if (each <= 0 || room <= 0) return wanted;
  return std::clamp(static_cast<int>(std::min(room / each, 1e6)), 1, wanted);
}

/// What is wrong with one value by itself.
void check(const UncertainKey& key, double value, std::vector<std::string>& wrong) {
  const auto row = key_of_number(key.path);
  if (!row) return;
  for (const Problem& problem : check_value(*row, Uncertain(value)))
    wrong.push_back(problem.message);
}

std::string as_lines(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all) {
    if (!text.empty()) text += '\n';
    text += one;
  }
  return text;
}

}  // namespace

Evaluator::Evaluator(const EvaluatorRequest& request)
    : scene_(load_scene(request.scene)), keys_(uncertain_keys(scene_.scenario)) {
  workers_ = workers_for(request, scene_.description);
  threads_ = request.threads > 0 ? request.threads : std::max(1, available_cores() / workers_);
}

std::vector<double> Evaluator::medians() const {
  std::vector<double> values;
  values.reserve(keys_.size());
  for (const UncertainKey& key : keys_)
    values.push_back(Marginal(key.distribution, key.path).median());
  return values;
}

Scenario Evaluator::numbers_of(std::span<const double> values) const {
  require(values.size() == keys_.size(),
          fmt::format("{} values for {} uncertain keys (must be one for each, in their order).",
                      values.size(), keys_.size()));
  std::vector<std::string> wrong;
  Scenario numbers = scene_.scenario;
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    check(keys_[k], values[k], wrong);
    numbers = with_value(std::move(numbers), keys_[k].path, values[k]);
  }
  require(wrong.empty(), as_lines(wrong));
  // What an ensemble would need of its design and couplings is no matter of one member.
  Scenario alone = numbers;
  alone.ensemble = {};
  require_valid(alone);
  return numbers;
}

bool Evaluator::take_turn(const Cancelled& cancelled) {
  using namespace std::chrono_literals;
  std::unique_lock held(lock_);
  while (!free_.wait_for(held, 50ms, [this] { return running_ < workers_; }))
    if (cancelled()) return false;
  if (cancelled()) return false;
  ++running_;
  return true;
}

void Evaluator::give_turn() {
  {
    const std::lock_guard held(lock_);
    --running_;
  }
  free_.notify_one();
}

MemberResult Evaluator::evaluate(std::span<const double> values, const Cancelled& cancelled,
                                 const std::function<void(const Progress&)>& on_progress) {
  const Scenario numbers = numbers_of(values);
  if (!take_turn(cancelled)) {
    MemberResult result;
    result.outcome = Outcome::cancelled;
    result.reason = "cancelled before it began";
    return result;
  }
  struct Turn {
    Evaluator& of;
    explicit Turn(Evaluator& evaluator) : of(evaluator) {}
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    ~Turn() { of.give_turn(); }
  } const turn(*this);
  RunControl control;
  control.max_wall_s = numbers.numerics.max_wall_time_s;
  control.on_progress = [&](const Progress& progress) {
    if (on_progress) on_progress(progress);
    return !cancelled();
  };
  const auto first = ground_of_member(numbers, *scene_.ground->now());
  const auto ground = first ? scene_.ground : own_ground(numbers);
  return ground->computed([&](const SceneInputs& shared) {
    SceneInputs inputs = shared;
    if (first) inputs.reach = first->reach;
    return assemble(numbers, inputs, 0, threads_).run(control);
  });
}

std::shared_ptr<GrowingGround> Evaluator::own_ground(const Scenario& numbers) {
  const std::lock_guard one_at_a_time(reading_);
  return std::make_shared<GrowingGround>(numbers, load_scene_inputs(numbers));
}

double EvaluatorOutput::value(const MemberResult& member) const {
  return field != nullptr ? member.scalars.*field : is_censored(member.censoring) ? 1 : 0;
}

Known EvaluatorOutput::known(const MemberResult& member) const {
  return field != nullptr ? sturz::known(field, member.scalars, member.censoring) : Known::exactly;
}

std::vector<EvaluatorOutput> outputs_named(std::span<const std::string> names) {
  std::vector<std::string> known;
  for (const ScalarInfo& scalar : scalar_table()) known.emplace_back(scalar.name);
  known.emplace_back(censored_output);
  std::vector<EvaluatorOutput> outputs;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      const std::string near = nearest_name(name, known);
      throw SetupError(
          fmt::format("output {} (members have no such number{}). They are the "
                      "columns of members.csv.",
                      name, near.empty() ? "" : "; did you mean " + near + "?"));
    }
    require(std::none_of(outputs.begin(), outputs.end(),
                         [&](const EvaluatorOutput& o) { return o.name == name; }),
            fmt::format("output {} (stands there twice). Name it once.", name));
    if (name == censored_output) {
      outputs.push_back({name, "1",
                         "1 where the member's end was not seen: mass left the known "
                         "ground or still moved at the end time; else 0"});
      continue;
    }
    const ScalarInfo& scalar = scalar_table()[static_cast<std::size_t>(found - known.begin())];
    outputs.push_back({scalar.name, scalar.units, scalar.long_name, scalar.field});
  }
  return outputs;
}

std::vector<EvaluatorOutput> usual_outputs() {
  const std::vector<std::string> names{
      "runout_m",      "reached_area_m2", "deposit_area_m2", "max_speed_m_s", "max_thickness_m",
      "max_deposit_m", "max_energy_j_m2", "max_pressure_pa", "com_travel_m",  "end_time_s"};
  return outputs_named(names);
}

}  // namespace sturz::workflow
