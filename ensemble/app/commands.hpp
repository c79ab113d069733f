// SPDX-License-Identifier: Apache-2.0
/// The sub-commands: what each may be told, and the function that does it. One file each.
#pragma once

#include "ensemble/app/console/console.hpp"

#include <optional>
#include <string>
#include <vector>

namespace sturz::app {

struct RunOptions {
  std::string scenario;
  std::string out;                          ///< folder; empty: out/<name of the scenario>
  std::vector<std::string> set;             ///< "key=value"
  int threads = 0;                          ///< 0: all cores available to the process
  std::optional<double> particles_every_s;  ///< frames for ParaView, simulated seconds apart
};

struct EnsembleOptions {
  std::string scenario;
  std::string out;
  std::vector<std::string> set;
  int members = 0;            ///< 0: as the scenario says
  int workers = 0;            ///< 0: all cores available to the process
  std::string shard;          ///< "k/n", 1 <= k <= n; empty: everything
  bool retry_failed = false;  ///< compute failed members again
};

struct MergeOptions {
  std::string folder;
  bool partial = false;  ///< maps from the members that are there
};

struct DescribeOptions {
  std::string scenario;
  std::vector<std::string> set;
  bool measure_again = false;  ///< forget the cached speed of this machine
};

struct TerrainOptions {
  std::string what;  ///< a synthetic shape or a scenario file
  std::string out;   ///< folder
  std::optional<double> cell_size_m;
  std::vector<std::string> set;  ///< shape's "parameter=value", or scenario keys
};

struct SchemaOptions {
  std::string out;  ///< file; empty: stdout
};

struct ReportOptions {
  std::string folder;
};

// Each returns an ExitCode and throws SetupError for what the user can mend.
int run_command(const RunOptions&, Console&);
int ensemble_command(const EnsembleOptions&, Console&);
int merge_command(const MergeOptions&, Console&);
int describe_command(const DescribeOptions&, Console&);
int terrain_command(const TerrainOptions&, Console&);
int schema_command(const SchemaOptions&, Console&);
int report_command(const ReportOptions&, Console&);

}  // namespace sturz::app
