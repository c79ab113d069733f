// SPDX-License-Identifier: Apache-2.0
#include "io/batch/batch_file.hpp"

#include "engine/core/error.hpp"
#include "io/batch/batch_schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string problems_of(const std::string& text) {
  try {
    parse_batch(text, "list.yaml");
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return {};
}

TEST(BatchFile, SaysWhatIsComputedAndWithinWhichLimits) {
  const BatchSpec spec = parse_batch(R"(
results: out/slopes
max_workers: 4
between: "20:00-06:00"
wait: true
stop_file: STOP
nice: 10
min_free_disk_gb: 5
max_memory_gb: 8
keep: 3
defaults: {scenario: slope.yaml, members: 64, set: {numerics.end_time_s: 60, title: a}}
jobs:
  - {name: north, set: {basal.friction_coefficient: 0.3, title: "x: y"}}
  - {name: south, scenario: south.yaml, mode: ensemble, members: 12, folder: elsewhere/south}
  - name: each
    features: each
  - {name: some, features: [3, "upper part"]}
)",
                                     "list.yaml");
  EXPECT_EQ(spec.results, "out/slopes");
  EXPECT_EQ(spec.max_workers, 4);
  ASSERT_TRUE(spec.between);
  EXPECT_TRUE(spec.wait);
  EXPECT_EQ(spec.stop_file, "STOP");
  EXPECT_EQ(spec.nice, 10);
  EXPECT_EQ(spec.min_free_disk_gb, 5);
  EXPECT_EQ(spec.max_memory_gb, 8);
  EXPECT_EQ(spec.keep, 3);
  ASSERT_EQ(spec.jobs.size(), 4u);
  const BatchEntry& north = spec.jobs[0];
  EXPECT_EQ(north.scenario, "slope.yaml");
  EXPECT_EQ(north.members, 64);
  ASSERT_EQ(north.set.size(), 3u) << "a job's own value is in the place of the default";
  EXPECT_EQ(north.set[0].key + "=" + north.set[0].value, "numerics.end_time_s=60");
  EXPECT_EQ(north.set[2].key + "=" + north.set[2].value, "title=\"x: y\"");
  EXPECT_EQ(north.set[1].at.text(), "list.yaml:13:53");
  EXPECT_EQ(spec.jobs[1].scenario, "south.yaml");
  EXPECT_EQ(spec.jobs[1].folder, "elsewhere/south");
  EXPECT_TRUE(spec.jobs[2].each_feature);
  EXPECT_THAT(spec.jobs[3].features, ElementsAre("3", "\"upper part\""));
}

TEST(BatchFile, ValuesReadBackAsTheyWereWritten) {
  const BatchSpec spec = parse_batch(
      "jobs:\n- name: a\n  scenario: a.yaml\n  set:\n"
      "    basal.friction_coefficient: {uniform: [0.1, 0.2]}\n"
      "    terrain.dams: [{line: \"a b.gpkg\", height_m: 3}]\n"
      "    domain: null\n    title: 'it''s \"so\"'\n",
      "list.yaml");
  std::vector<std::string> values;
  for (const BatchValue& v : spec.jobs.at(0).set) values.push_back(v.value);
  EXPECT_THAT(values, ElementsAre("{uniform: [0.1, 0.2]}", "[{line: \"a b.gpkg\", height_m: 3}]",
                                  "null", "\"it's \\\"so\\\"\""));
}

TEST(BatchFile, AllProblemsComeAtOnceEachAtItsPlace) {
  const std::string all = problems_of(R"(jobs:
  - {name: a b, scenario: a.yaml}
  - {scenario: a.yaml}
  - {name: c}
  - {name: d, scenario: a.yaml, members: 0, mode: fast}
  - {name: e, scenario: a.yaml, colour: red}
  - {name: e, scenario: a.yaml}
  - {name: f, scenario: a.yaml, features: all}
  - {name: g, scenario: a.yaml, mode: run, members: 3}
  - {name: h-0123abcd, scenario: a.yaml}
max_workers: many
between: 20-06
nice: 30
resutls: out
)");
  EXPECT_THAT(all, HasSubstr("list.yaml:2:12: jobs[0].name = a b (must be letters"));
  EXPECT_THAT(all, HasSubstr("list.yaml:3:5: jobs[1] (name is missing). Add it."));
  EXPECT_THAT(all, HasSubstr("list.yaml:4:5: jobs[2] (scenario is missing)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:5:42: jobs[3].members = 0 (must be in 1..100000000)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:5:51: jobs[3].mode = fast (must be ensemble or run)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:6:33: jobs[4].colour (unknown key)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:7:5: jobs[5].name = e (is also that of the job in line 6"));
  EXPECT_THAT(all, HasSubstr("list.yaml:8:43: jobs[6].features = all (must be each, or a list"));
  EXPECT_THAT(all, HasSubstr("list.yaml:9:5: jobs[7] (mode: run has no members)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:10:12: jobs[8].name = h-0123abcd (ends as a folder"));
  EXPECT_THAT(all, HasSubstr("list.yaml:11:14: max_workers = many (must be a whole number)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:12:10: between = 20-06 (must be two times of day"));
  EXPECT_THAT(all, HasSubstr("list.yaml:13:7: nice = 30 (must be in 0..19)"));
  EXPECT_THAT(all, HasSubstr("list.yaml:14:1: the list.resutls (unknown key). Did you mean "
                             "results?"));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 13) << all;
}

TEST(BatchFile, WhatIsNoListIsSaid) {
  EXPECT_THAT(problems_of("[a, b]"), HasSubstr("list.yaml:1:1: the list = [a, b]"));
  EXPECT_THAT(problems_of("results: out"), HasSubstr("jobs (is missing)"));
  EXPECT_THAT(problems_of("jobs: []"), HasSubstr("jobs = [] (must be a list of"));
  EXPECT_THAT(problems_of("jobs: [a"), HasSubstr("not readable as YAML"));
  EXPECT_THAT(problems_of("defaults: {name: a}\njobs: [{name: b, scenario: c}]"),
              HasSubstr("list.yaml:1:12: defaults.name (unknown key)"));
}

TEST(BatchFile, TheSchemaKnowsEveryKey) {
  const std::string schema = batch_schema();
  for (const char* key : {"jobs", "defaults", "results", "max_workers", "between", "stop_file",
                          "min_free_disk_gb", "features", "members", "scenario"})
    EXPECT_THAT(schema, HasSubstr(std::string("\"").append(key).append("\": {"))) << key;
  EXPECT_THAT(schema, HasSubstr("\"const\": \"each\""));
}

}  // namespace
}  // namespace sturz
