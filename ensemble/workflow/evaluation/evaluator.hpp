// SPDX-License-Identifier: Apache-2.0
/// A scene as a function: values of its uncertain keys in, one member out, nothing stored. For
/// doors that ask again and again: samplers of other programs, Python.
#pragma once

#include "engine/simulation/member_result.hpp"
#include "engine/simulation/simulation.hpp"
#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/workflow/scene.hpp"
#include "scenarios/schema/schema.hpp"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace sturz::workflow {

/// True once a member is not wanted any more; looked at about five times a second while it runs,
/// and more often while it waits for its turn.
using Cancelled = std::function<bool()>;

struct EvaluatorRequest {
  SceneRequest scene;
  int workers = 0;  ///< members at a time; 0: all cores available to the process
  int threads = 0;  ///< of each member; 0: what is left of the cores
};

/// Files are read once and members share them, except members of scenes with rasters of the bed,
/// dams or buildings, and those whose values lie so far outside the distributions that they may
/// come beyond the ground that was read: these read their own. Safe to call from any number of
/// threads.
class Evaluator {
 public:
  /// \throws SetupError for what is wrong with the scene
  explicit Evaluator(const EvaluatorRequest&);

  const Scene& scene() const { return scene_; }
  /// The uncertain keys in the order of the scenario's schema: the arguments of the function.
  const std::vector<UncertainKey>& keys() const { return keys_; }
  int workers() const { return workers_; }
  int threads() const { return threads_; }
  /// Of members from now on; not while one begins.
  void set_threads(int n) { threads_ = n; }
  /// The median of every distribution [n_keys].
  std::vector<double> medians() const;

  /// The member that `sturz run --set key=value ...` computes, bit for bit. Waits for its turn
  /// where `workers` members run already.
  /// \param values [n_keys] in the keys' units, inside the keys' ranges; the distributions do not
  ///        bound them
  /// \param on_progress about five times a second on this thread; may be empty. What it throws
  ///        comes out here.
  /// \param cancelled asked on this thread; the outcome is then `cancelled`
  /// \throws SetupError naming the key whose value cannot be
  MemberResult evaluate(std::span<const double> values, const Cancelled& cancelled,
                        const std::function<void(const Progress&)>& on_progress = {});
  MemberResult evaluate(std::span<const double> values, const std::atomic<bool>& cancel,
                        const std::function<void(const Progress&)>& on_progress = {}) {
    return evaluate(
        values, [&cancel] { return cancel.load(); }, on_progress);
  }

 private:
  Scenario numbers_of(std::span<const double> values) const;
  std::shared_ptr<GrowingGround> own_ground(const Scenario& numbers);
  bool take_turn(const Cancelled&);
  void give_turn();

  Scene scene_;
  std::vector<UncertainKey> keys_;
  int workers_ = 1, threads_ = 1;
  std::mutex reading_;  ///< of files for one member
  std::mutex lock_;
  std::condition_variable free_;
  int running_ = 0;
};

/// A number of a member that evaluations give back.
struct EvaluatorOutput {
  std::string name, units, meaning;
  double MemberScalars::*field = nullptr;  ///< null: 1 for a censored member, else 0
  double value(const MemberResult&) const;
  /// What the number says of a member whose end was not seen.
  Known known(const MemberResult&) const;
};

/// The name of the output without a field.
inline constexpr const char* censored_output = "censored";

/// Scalars of members, or `censored`, by their names. \throws SetupError for an unknown or repeated
/// name, with the nearest known one
std::vector<EvaluatorOutput> outputs_named(std::span<const std::string> names);

/// What every valid member has a number for: runout, area, largest speed, thickness, energy and
/// pressure, and the simulated end.
std::vector<EvaluatorOutput> usual_outputs();

}  // namespace sturz::workflow
