// SPDX-License-Identifier: Apache-2.0
/// Full-stress members from corners and random points of the priors, on two grounds.
#pragma once

#include "scenarios/scenario.hpp"
#include "scenarios/scene_inputs.hpp"
#include "tests/hard/states.hpp"
#include "tests/hard/steep_ground.hpp"
#include "tests/hard/survival.hpp"

#include <string>
#include <vector>

namespace sturz::test {

/// The members of one ground; member k has row k of hard_points().
class RandomMembers {
 public:
  /// steep_ground: a cap of about 450 particles of 6 m whose place, shape and (in one of five)
  /// start velocity go by the member's number. The domain boundary lets mass out, or in one of five
  /// is a wall.
  static RandomMembers on_steep_ground(States = States::dense_only);
  /// Monte Marsicano, 10 m cells: 1.2e6 m^3 dug out of the slope, about 700 particles of 12 m.
  /// \param folder  with marsicano_10m.tif and release_250m.geojson
  static RandomMembers on_marsicano(const std::string& folder, States = States::dense_only);

  /// With all states every fourth member lets isolated particles meet (hertz_mindlin).
  HardMember member(int number) const;
  const std::string& ground() const { return name_; }
  States states() const { return states_; }
  /// Runs it on one thread.
  Survival run(int number) const;

 private:
  std::string name_;
  HardMember scene_;
  double volume_m3_ = 0;
  bool moving_source_ = false;
  States states_ = States::dense_only;
};

/// `n` of the rows 0..n_points-1, evenly spread.
std::vector<int> spread(int n);
/// Rows of one of four sets: four corners, different ones in every set, and `n` - 4 random points.
/// The sixteen corners of all sets are a quarter of the 64 in which every three of the six numbers
/// meet in every combination (a 2^(6-2) design, e = a b c, f = b c d). More than 16: spread(n).
std::vector<int> drawn(int n, int set);

}  // namespace sturz::test
