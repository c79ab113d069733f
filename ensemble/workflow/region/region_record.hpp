// SPDX-License-Identifier: Apache-2.0
/// Which sources of a region are finished, so that a resumed run need not load them to find out.
///
///   finished.json, finished_K_of_N.json   at the region's root, one for each process that computes
///
/// What they say counts as long as nothing changed that members depend on: scenario, design,
/// program, and size, inode and times of every file behind the scene (io/files/file_stamp.hpp).
/// They are a short cut: without them every source is looked at, and nothing is lost.
#pragma once

#include "ensemble/workflow/folder/output_folder.hpp"
#include "ensemble/workflow/folder/shard.hpp"
#include "io/files/file_stamp.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sturz::workflow {

class RegionRecord {
 public:
  /// What all processes have left that is true today; looks at the stamps of the files now, before
  /// any source is loaded. \param design_hash of the table that all sources share
  RegionRecord(const OutputFolder& region, const std::string& design_hash, const Shard& shard);

  /// All members of the source are there, computed from what its scene is today.
  bool is_finished(const std::string& source, std::int64_t members_per_source) const;
  void add_finished(const std::string& source) { finished_.insert(source); }
  /// Nothing where stamps cannot tell. \throws IoError
  void write() const;

 private:
  void take(const std::filesystem::path& file);

  OutputFolder region_;
  Shard shard_;
  std::string of_;  // scenario, design, program
  std::optional<std::vector<FileStamp>> stamps_;
  std::int64_t looked_ns_ = 0;
  std::set<std::string> finished_;
};

/// When something was found to be not as it was left.
void forget_finished_sources(const OutputFolder& region);

}  // namespace sturz::workflow
