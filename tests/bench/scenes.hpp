// SPDX-License-Identifier: Apache-2.0
/// The scenes that are timed, by their number of particles.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"

#include <cstdint>
#include <string>

namespace sturz::bench {

struct Scene {
  std::string name;
  Scenario scenario;
  SceneInputs inputs;
};

/// A box of 100 x 80 x 27 m on an even slope of 26 degrees; the spacing follows from the number.
Scene dense_slide(double n_particles);
/// 40 x 20 m, 4 m or four particles thick, on an even slope of 30 degrees: 3,200 particles.
Scene thin_slide();
/// 100 x 100 m, 5 m thick, on a slope of 26 degrees with bumps of 2 m; the spacing follows from
/// the number. \param end_time_s where a whole member is run
Scene column_slide(double n_columns, double end_time_s = 60);
/// A round mass of about 2,100 particles, 1.5 m apart, that slides from 30 degrees onto level
/// ground: a member of a screening ensemble in full stress.
Scene small_member(double end_time_s = 60);

/// The scenario of one member: the bed's friction varied by +-10 % with the member's number.
Scenario varied(const Scenario&, std::int64_t member);

}  // namespace sturz::bench
