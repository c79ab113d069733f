// SPDX-License-Identifier: Apache-2.0
/// A time step as an ordered list of passes. What a scene does not call for is not in the list.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/effects/state.hpp"

namespace sturz {

/// Fixed places in a step, in order.
enum class Stage {
  neighbors,   ///< sort and list
  boundary,    ///< what ground and walls are to each particle at x_n
  pack,        ///< records for the pair sweep
  force,       ///< accelerations, velocity gradients at x_n
  kick,        ///< v_{n-1/2} -> v_{n+1/2} by acceleration
  contact,     ///< impulses of ground and walls, friction last
  stress,      ///< stress and density n -> n+1
  move,        ///< x_n -> x_{n+1}, losses, bounds
};
std::string_view to_string(Stage);

/// A limit that a pass sets on the step.
struct StepLimit {
  const char* name;   ///< e.g. "acoustic"
  double dt;          ///< [s], infinity when it does not bind
};

/// One pass over the particles at a fixed stage of the step. An effect is one to three passes.
class Pass {
 public:
  virtual ~Pass() = default;
  virtual std::string_view name() const = 0;   ///< lower-case noun, for `describe` and timings
  virtual Stage stage() const = 0;
  /// Appends this pass's limits; none by default.
  virtual void limits(const State&, std::vector<StepLimit>&) const {}
  virtual void apply(State&, double dt) = 0;   ///< dt in [s]
  /// Memory beyond the particle set's own fields [bytes].
  virtual std::size_t bytes() const { return 0; }
};

/// Seconds spent in one pass, summed over the run.
struct PassTime {
  std::string name;
  double seconds = 0;
};

class Step {
 public:
  /// Keeps the order in which passes of one stage were added.
  void add(std::unique_ptr<Pass>);

  /// The smallest limit of all passes. \return name and dt [s]
  StepLimit limit(const State&) const;
  /// Applies all passes in order and advances the clock.
  void apply(State&, double dt);

  std::vector<std::string> pass_names() const;
  const std::vector<PassTime>& timings() const { return timings_; }
  std::size_t bytes() const;

 private:
  std::vector<std::unique_ptr<Pass>> passes_;
  std::vector<PassTime> timings_;
  mutable std::vector<StepLimit> limits_;
};

}  // namespace sturz
