// SPDX-License-Identifier: Apache-2.0
/// The sub-commands of sturz_bench; each answers one question with tables.
#pragma once

#include "tests/bench/measure/table.hpp"

#include <string>

namespace sturz::bench {

struct Options {
  int pairs = 21;               ///< slices or pairs of each measurement
  bool quick = false;           ///< fewer pairs and smaller scenes
  double most = 200'000;        ///< particles of the largest scene of `scaling`
  int threads = 0;              ///< of `threads` and `ensemble`; 0: all processors
  int members = 6;              ///< of each ensemble
  double end_time_s = 60;       ///< simulated time of an ensemble's member
  bool full = false;            ///< of `hard`: all random members instead of 20
  std::string states = "both";  ///< of `hard`: dense | all | both
  int cells = 1000;             ///< of `merge`: edge of the grid
  std::string folder;           ///< of `merge`: where its packs lie meanwhile; empty: /tmp
  /// Least throughput of the dense slide over the reference loop; of `merge`, least speed over that
  /// of reading every map.
  double fail_below = 0;
};

/// How fast is one core, and where does the time go?
Report throughput(const Options&);
/// What does a particle-update cost in a larger scene?
Report scaling(const Options&);
/// How much faster is one member on all processors?
Report threads(const Options&);
/// How many members an hour, and what does the runner cost?
Report ensemble(const Options&);
/// What does an effect cost that a scene does not call for?
Report absent_effects(const Options&);
/// How fast is one core in a liquid?
Report liquid(const Options&);
/// What do grains and a liquid cost together, beside each alone?
Report coupled(const Options&);
/// Are the bits of every shipped scene still the same, on every instruction set and thread count?
Report hashes(const Options&);
/// What do a hundred thousand members cost to keep, read and merge?
Report merge(const Options&);
/// Does it survive what wants to break it, and by which margin?
Report hard(const Options&);

}  // namespace sturz::bench
