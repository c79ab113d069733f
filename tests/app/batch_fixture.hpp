// SPDX-License-Identifier: Apache-2.0
/// Eight small slopes on two elevation rasters and a broken one, and lists of them.
#pragma once

#include "tests/app/app_fixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace sturz::test {

class BatchApp : public App {
 protected:
  BatchApp() {
    write("a.asc", slope(0.58));
    write("b.asc", slope(0.62));
    write("broken.asc", "ncols what\n");
    for (const char* name : {"a", "b", "broken"})
      write(std::string(name) + ".yaml", scene(std::string(name) + ".asc"));
  }

  /// An elevation raster of 60 x 25 cells of 2 m that falls to the east.
  static std::string slope(double tangent) {
    std::string text =
        "ncols 60\nnrows 25\nxllcorner 500000\nyllcorner 5000000\ncellsize 2\n"
        "NODATA_value -9999\n";
    for (int row = 0; row < 25; ++row) {
      for (int col = 0; col < 60; ++col)
        text += fmt::format("{:.3f} ", 100 - (2 * col + 1) * tangent);
      text += '\n';
    }
    return text;
  }

  static std::string scene(const std::string& raster) {
    return "title: tiny slide\nterrain: {raster: " + raster + R"(, crs: "EPSG:32632"}
release:
  box: {x_m: [500014, 500024], y_m: [5000020, 5000030]}
  thickness_m: 3
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal: {friction_coefficient: {uniform: [0.3, 0.5]}}
numerics: {spacing_m: 1, end_time_s: 2}
ensemble: {design: sobol, members: 2, seed: 1}
hazard: {cell_size_m: 2, thickness_m: [0.5], speed_m_s: [1], energy_kj_m2: [1], pressure_kpa: [1]}
formulation: depth_averaged
)";
  }

  /// a1 .. a4 on a.asc, b1 .. b3 on b.asc, and one that fails.
  static std::string eight() {
    std::string list = "min_free_disk_gb: 0\njobs:\n";
    for (const char* name : {"a1", "a2", "a3", "a4", "b1", "b2", "b3"})
      list += fmt::format(
          "  - {{name: {0}, scenario: {1}.yaml, set: {{basal.friction_coefficient: "
          "{{uniform: [0.3, 0.4{2}]}}}}}}\n",
          name, name[0], name[1]);
    return list + "  - {name: broken, scenario: broken.yaml}\n";
  }

  Ended batch(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"batch", path("list.yaml"), "-o", path("out")};
    words.insert(words.end(), more.begin(), more.end());
    return sturz(words);
  }

  /// Cells of summary.csv by the name of their column, a map per job. Cells with commas stand in
  /// quotes.
  std::vector<std::map<std::string, std::string>> summary() const {
    std::istringstream lines(read("out/summary.csv"));
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells(1);
      bool quoted = false;
      for (const char c : line) {
        if (c == '"')
          quoted = !quoted;
        else if (c == ',' && !quoted)
          cells.emplace_back();
        else
          cells.back() += c;
      }
      if (names.empty()) {
        names = cells;
        continue;
      }
      EXPECT_EQ(cells.size(), names.size()) << line;
      auto& row = rows.emplace_back();
      for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i)
        row[names[i]] = cells[i];
    }
    return rows;
  }
  /// One column, in the order of the jobs.
  std::vector<std::string> column(const std::string& name) const {
    std::vector<std::string> cells;
    for (const auto& row : summary()) cells.push_back(row.at(name));
    return cells;
  }
};

}  // namespace sturz::test
