// SPDX-License-Identifier: Apache-2.0
// Members beside what was observed: scores in the table, in text, JSON and page.
#include "tests/app/app_fixture.hpp"

#include <map>
#include <sstream>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Columns of members.csv by name; no cell of these scenes holds a quoted comma before them.
std::map<std::string, std::vector<std::string>> columns_of(const std::string& csv) {
  std::map<std::string, std::vector<std::string>> columns;
  std::vector<std::string> names;
  std::istringstream lines(csv);
  std::string line;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    }
    if (names.empty())
      names = cells;
    else
      for (std::size_t i = 0; i < cells.size(); ++i) columns[names.at(i)].push_back(cells[i]);
  }
  return columns;
}

class Observation : public App {
 protected:
  Observation() {
    write("mapped.geojson",
          R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
             "geometry": {"type": "Polygon", "coordinates":
             [[[-51, -6], [-30, -6], [-30, 6], [-51, 6], [-51, -6]]]}}]})");
    write("plain.yaml", tiny_scene());
    write("scene.yaml", tiny_scene() + block);
  }
  std::string members(const std::string& folder) const { return read(folder + "/members.csv"); }

  static constexpr const char* block =
      "observation:\n"
      "  outline: mapped.geojson\n"
      "  outline_sd_m: 3\n"
      "  runout_m: {value: 24, sd: 2}\n"
      "  speeds: [{point_m: [-38, 0], speed_m_s: 6, sd_m_s: 1}]\n";
};

TEST_F(Observation, ScoresStandInTheTableThePageAndTheLastWords) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("nearest to what was observed: member "));
  const auto columns = columns_of(members("out"));
  for (const char* name :
       {"score_misfit", "score_outline_iou", "score_outline_hss", "score_outline_distance_m",
        "score_runout_error_m", "score_speed_1_error_m_s", "score_bounds"})
    EXPECT_EQ(columns.count(name), 1U) << name;
  bool differ = false;
  for (const std::string& cell : columns.at("score_outline_iou")) {
    EXPECT_GT(std::stod(cell), 0);
    EXPECT_LT(std::stod(cell), 1);
    differ = differ || cell != columns.at("score_outline_iou").front();
  }
  EXPECT_TRUE(differ);
  // The error of a length is the scalar less what was observed.
  EXPECT_NEAR(std::stod(columns.at("score_runout_error_m")[0]),
              std::stod(columns.at("crown_to_toe_length_m")[0]) - 24, 1e-9);
  const std::string page = read("out/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("<section id=\"observed\">"), HasSubstr("swatch observed"),
                          HasSubstr("the nearest to what was observed")));
}

TEST_F(Observation, WithoutItNothingIsScored) {
  const Ended ended = sturz({"ensemble", path("plain.yaml"), "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, Not(HasSubstr("observed")));
  EXPECT_THAT(members("out"), Not(HasSubstr("score_")));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section id=\"observed\">")));
}

TEST_F(Observation, WorkersAndShardsLeaveNoTrace) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("a"), "--workers", "1"}).exit_code,
            0);
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("b"), "--workers", "2"}).exit_code,
            0);
  for (const char* shard : {"2/2", "1/2"})
    ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("c"), "--shard", shard}).exit_code,
              0);
  ASSERT_EQ(sturz({"merge", path("c")}).exit_code, 0);
  const auto a = columns_of(members("a")), b = columns_of(members("b")),
             c = columns_of(members("c"));
  int scores = 0;
  for (const auto& [name, cells] : a) {
    if (!name.starts_with("score_")) continue;
    ++scores;
    EXPECT_EQ(cells, b.at(name)) << name;
    EXPECT_EQ(cells, c.at(name)) << name;
  }
  EXPECT_GT(scores, 10);
}

TEST_F(Observation, MayComeAndChangeLaterWithoutComputingAgain) {
  ASSERT_EQ(sturz({"ensemble", path("plain.yaml"), "-o", path("out")}).exit_code, 0);
  const std::string hash = hazard_hash("out"), member = read("out/members/000003.nc");
  const Ended scored = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--json"});
  ASSERT_EQ(scored.exit_code, 0) << scored.err;
  EXPECT_EQ(event(scored, "start").value("to_do", -1), 0);
  EXPECT_EQ(hazard_hash("out"), hash);
  EXPECT_EQ(read("out/members/000003.nc"), member);
  const auto before = columns_of(members("out")).at("score_outline_iou");
  const auto nearest = event(scored, "done")["nearest"];
  ASSERT_EQ(nearest.size(), 3U);
  EXPECT_LE(nearest[0]["scores"]["misfit"]["value"], nearest[1]["scores"]["misfit"]["value"]);
  EXPECT_EQ(nearest[0]["observed"][1]["name"], "runout_m");
  // Another outline, and nothing but `merge`.
  write("mapped.geojson",
        R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
           "geometry": {"type": "Polygon", "coordinates":
           [[[-51, -6], [-36, -6], [-36, 6], [-51, 6], [-51, -6]]]}}]})");
  const Ended merged = sturz({"merge", path("out")});
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_NE(columns_of(members("out")).at("score_outline_iou"), before);
  EXPECT_EQ(hazard_hash("out"), hash);
  EXPECT_EQ(sturz({"report", path("out")}).exit_code, 0);
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"observed\">"));
}

TEST_F(Observation, ARunTellsItsScores) {
  const Ended ended = sturz({"run", path("scene.yaml"), "-o", path("out")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("IoU "), HasSubstr("HSS "),
                               HasSubstr("(observed 24 +- 2)"), HasSubstr("misfit")));
  const Ended json = sturz({"run", path("scene.yaml"), "-o", path("out"), "--json"});
  const auto comparison = event(json, "done")["comparison"];
  EXPECT_EQ(comparison["observed"].size(), 3U);
  EXPECT_EQ(comparison["scores"]["outline_iou"]["known"],
            event(json, "done")["censored"] == "none" ? "exactly" : "not_at_all");
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"observed\">"));
}

TEST_F(Observation, AFileThatIsMissingIsToldBeforeAnythingIsComputed) {
  std::filesystem::remove(path("mapped.geojson"));
  const Ended ended = sturz({"describe", path("scene.yaml")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("observation.outline = mapped.geojson"));
}

}  // namespace
}  // namespace sturz::test
