// SPDX-License-Identifier: Apache-2.0
#include "engine/effects/step.hpp"

#include "engine/effects/arrivals.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace sturz {

std::string_view to_string(Stage stage) {
  constexpr std::string_view names[] = {"neighbors", "boundary", "across",  "gather", "force",
                                        "kick",      "walls",    "contact", "stress", "move"};
  return names[static_cast<int>(stage)];
}

NamedSeconds by_pass(std::span<const PassTime> passes) {
  NamedSeconds out;
  for (const PassTime& p : passes) {
    add_seconds(out, p.name, p.seconds - p.part_seconds);
    if (!p.part.effect.empty())
      add_seconds(out, p.name + ", " + std::string(p.part.name), p.part_seconds);
  }
  return out;
}

NamedSeconds by_effect(std::span<const PassTime> passes) {
  NamedSeconds out;
  for (const PassTime& p : passes) {
    add_seconds(out, p.effect, p.seconds - p.part_seconds);
    if (!p.part.effect.empty()) add_seconds(out, p.part.effect, p.part_seconds);
  }
  return out;
}

void Step::add(std::unique_ptr<Pass> pass) {
  auto after =
      std::upper_bound(passes_.begin(), passes_.end(), pass->stage(),
                       [](Stage s, const std::unique_ptr<Pass>& p) { return s < p->stage(); });
  const std::string effect(pass->effect().empty() ? effect_ : pass->effect());
  timings_.insert(timings_.begin() + (after - passes_.begin()),
                  {std::string(pass->name()), 0.0, effect, pass->part(), 0.0});
  passes_.insert(after, std::move(pass));
}

StepLimit Step::limit(const State& state) const {
  limits_.clear();
  for (const auto& pass : passes_) pass->limits(state, limits_);
  StepLimit least{"none", std::numeric_limits<double>::infinity()};
  for (const StepLimit& l : limits_)
    if (l.dt < least.dt) least = l;
  return least;
}

void Step::admit(State& state) {
  for (std::size_t set = 0; set < state.sets.size(); ++set) {
    if (state.sets[set].arrivals.empty()) continue;
    const std::size_t first = enter_arrivals(state.domain, state.sets[set]);
    for (const auto& pass : passes_) pass->entered(state, set, first);
  }
}

void Step::apply(State& state, double dt) {
  using Clock = std::chrono::steady_clock;
  auto before = Clock::now();
  for (std::size_t k = 0; k < passes_.size(); ++k) {
    passes_[k]->apply(state, dt);
    const auto after = Clock::now();
    const double seconds = std::chrono::duration<double>(after - before).count();
    timings_[k].seconds += seconds;
    timings_[k].part_seconds += passes_[k]->part().share * seconds;
    before = after;
  }
  state.time += dt;
  state.previous_dt = dt;
  ++state.n_steps;
  admit(state);
}

std::vector<std::string> Step::pass_names() const {
  std::vector<std::string> names;
  for (const auto& pass : passes_)
    names.push_back(std::string(to_string(pass->stage())) + ": " + std::string(pass->name()));
  return names;
}

void Step::warnings(const State& state, std::vector<std::string>& out) const {
  for (const auto& pass : passes_) pass->warnings(state, out);
}

std::size_t Step::bytes() const {
  std::size_t total = 0;
  for (const auto& pass : passes_) total += pass->bytes();
  return total;
}

}  // namespace sturz
