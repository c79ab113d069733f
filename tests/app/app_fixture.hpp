// SPDX-License-Identifier: Apache-2.0
/// A folder of its own, a tiny scene in it, and the program.
#pragma once

#include "tests/support/process.hpp"
#include "tests/support/tiny_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace sturz::test {

class App : public ::testing::Test {
 protected:
  App();
  ~App() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  /// Number of finished member files in a results folder.
  std::size_t n_members(const std::string& results) const;
  std::string hazard_hash(const std::string& results) const;

  std::vector<std::string> command(const std::vector<std::string>& arguments) const;
  std::vector<std::string> environment() const;
  /// Runs `sturz ...`; the paths in `arguments` are the caller's to complete with path().
  Ended sturz(const std::vector<std::string>& arguments) const;
  /// The lines of --json output.
  static std::vector<nlohmann::json> events(const Ended&);
  /// The first event of that name; fails when there is none.
  static nlohmann::json event(const Ended&, const std::string& name);

 private:
  std::filesystem::path folder_;
};

}  // namespace sturz::test
