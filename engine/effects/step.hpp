// SPDX-License-Identifier: Apache-2.0
/// A time step as an ordered list of passes. What a scene does not call for is not in the list.
#pragma once

#include "engine/core/named_seconds.hpp"
#include "engine/effects/effect_names.hpp"
#include "engine/effects/state.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sturz {

/// Fixed places in a step, in order.
enum class Stage {
  neighbors,  ///< sort and list
  boundary,   ///< what ground and walls are to each particle at x_n
  across,     ///< what the particles of two sets are to each other at x_n
  gather,     ///< neighbour records for the pair sweep
  force,      ///< accelerations, velocity gradients at x_n
  kick,       ///< v_{n-1/2} -> v_{n+1/2} by acceleration
  walls,      ///< impulses of analytic walls: what they stop the ground does not rub
  contact,    ///< impulses of the ground, friction last
  stress,     ///< stress and density n -> n+1
  move,       ///< x_n -> x_{n+1}, losses, bounds
};
std::string_view to_string(Stage);

/// A limit that a pass sets on the step.
struct StepLimit {
  const char* name;  ///< e.g. "acoustic"
  double dt;         ///< [s], infinity when it does not bind
};

/// A part of a pass that works for another effect than the pass itself.
struct EffectPart {
  std::string_view effect;  ///< EffectName; empty: no such part
  std::string_view name;    ///< after the pass's name, e.g. "dispersed groups"
  double share = 0;         ///< of the last `apply`'s time, 0..1
};

/// One pass over the particles at a fixed stage of the step. An effect is one to three passes.
class Pass {
 public:
  virtual ~Pass() = default;
  virtual std::string_view name() const = 0;  ///< lower-case noun, for `describe` and timings
  virtual Stage stage() const = 0;
  /// EffectName that its time counts to; empty: the effect that was begun when it was added.
  virtual std::string_view effect() const { return {}; }
  virtual EffectPart part() const { return {}; }
  /// Appends this pass's limits; none by default.
  virtual void limits(const State&, std::vector<StepLimit>&) const {}
  virtual void apply(State&, double dt) = 0;  ///< dt in [s]
  /// Particles [first, size) of a set are new: a pass whose effect owns fields that must not start
  /// at their initial value fills them.
  virtual void entered(State&, std::size_t /*set*/, std::size_t /*first*/) {}
  /// Appends what a reader of the result must know of this run, one sentence each without "; ";
  /// asked at the end of the run.
  virtual void warnings(const State&, std::vector<std::string>&) const {}
  /// Memory beyond the particle set's own fields [bytes].
  virtual std::size_t bytes() const { return 0; }
};

/// Seconds spent in one pass, summed over the run.
struct PassTime {
  std::string name;
  double seconds = 0;
  std::string effect = {};  ///< see Pass::effect
  EffectPart part = {};     ///< share: not used
  double part_seconds = 0;  ///< of `seconds`, for the part's effect
};

/// By pass, in the order of the step; the part of a pass that has one stands behind it as "pass,
/// part".
NamedSeconds by_pass(std::span<const PassTime>);
/// By effect. Has the same sum.
NamedSeconds by_effect(std::span<const PassTime>);

class Step {
 public:
  /// Passes that are added from now on and name no effect themselves count to this one.
  void begin_effect(std::string_view name) { effect_ = name; }
  /// Keeps the order in which passes of one stage were added.
  void add(std::unique_ptr<Pass>);

  /// The smallest limit of all passes. \return name and dt [s]
  StepLimit limit(const State&) const;
  /// Makes particles of what waits in MovingSet::arrivals. `apply` does so at its end, so that the
  /// next limit knows them; to be called by hand for arrivals from outside a step.
  void admit(State&);
  /// Applies all passes in order, advances the clock and admits what passes let arrive.
  void apply(State&, double dt);

  std::vector<std::string> pass_names() const;
  /// Appends those of all passes, see Pass::warnings.
  void warnings(const State&, std::vector<std::string>& out) const;
  const std::vector<PassTime>& timings() const { return timings_; }
  std::size_t bytes() const;

 private:
  std::vector<std::unique_ptr<Pass>> passes_;
  std::vector<PassTime> timings_;
  std::string effect_;
  mutable std::vector<StepLimit> limits_;
};

}  // namespace sturz
