// SPDX-License-Identifier: Apache-2.0
/// A folder of its own, a tiny scene of columns in it, and an observer that remembers.
#pragma once

#include "ensemble/workflow/members/ensemble_job.hpp"
#include "ensemble/workflow/members/run_ensemble.hpp"
#include "ensemble/workflow/results/maps.hpp"
#include "tests/support/tiny_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sturz::test {

/// Remembers all events, and cancels after a number of stored members when told to.
struct Recorder : workflow::Observer {
  std::vector<std::string> warnings;
  std::vector<std::string> order;  ///< "folder", "member", "maps", as they came
  std::vector<std::int64_t> members;
  std::vector<Outcome> outcomes;  ///< of `members`
  RunnerProgress last_progress;
  int n_run_progress = 0;
  std::size_t cancel_after = 0;  ///< 0: never
  std::atomic<bool> cancel{false};

  void warning(std::string_view text) override;
  void folder_ready(const workflow::OutputFolder& folder) override;
  void run_progress(const Progress&) override;
  void ensemble_progress(const RunnerProgress& progress, std::int64_t finished_before) override;
  void member_stored(const MemberResult& result) override;
  void maps_begin() override;
};

class Workflow : public ::testing::Test {
 protected:
  Workflow();
  ~Workflow() override;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  /// Number of finished member files in a results folder.
  std::size_t n_members(const std::string& results) const;
  /// Cuts a member's file in half, as a full disk or a lost network share does.
  void damage(const std::string& results, std::int64_t member) const;

  workflow::SceneRequest scene(std::vector<std::string> overrides = {}) const;
  /// Of scene.yaml into a folder of that name, one member at a time.
  workflow::EnsembleRequest request(const std::string& results) const;
  /// Prepares and runs, up to the recorder's cancel.
  static workflow::MembersRun run(const workflow::EnsembleRequest&, Recorder&);
  /// Prepares, runs and makes the maps.
  static workflow::MapsMade whole(const workflow::EnsembleRequest&, Recorder&);
  /// The hash of the maps of an ensemble that ran undisturbed.
  std::string undisturbed() const;

 private:
  std::filesystem::path folder_;
};

/// Members of scene.yaml.
inline constexpr std::int64_t n_tiny = 6;

}  // namespace sturz::test
