// SPDX-License-Identifier: Apache-2.0
/// A straight channel on an even slope with a discharge across its upper end.
#pragma once

#include "scenarios/catalogue.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace sturz::test {

/// A folder of its own for the files of a scene, gone with it.
class SceneFolder {
 public:
  SceneFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sturz_flow_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::string path() const { return path_.string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }

 private:
  std::filesystem::path path_;
};

/// `channel` of the catalogue with a hydrograph in `folder`.
inline Scenario channel_with(const SceneFolder& folder, const std::string& hydrograph,
                             double spacing_m = 2) {
  folder.write("flood.csv", hydrograph);
  Scenario s = channel(spacing_m);
  s.directory = folder.path();
  InflowSpec source;
  source.hydrograph = "flood.csv";
  source.line_m = {{-80, -10}, {-80, 10}};
  s.inflow = {source};
  return s;
}

}  // namespace sturz::test
