// SPDX-License-Identifier: Apache-2.0
// What a study of what accuracy costs says of made-up ladders.
#include "ensemble/workflow/fidelity/cost_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sturz::workflow {
namespace {

using ::testing::HasSubstr;

/// Of mean 100 at all spacings. \param spread of the members \param errors of the mean
ResultAccuracy result(const std::string& name, double spread, const std::vector<double>& errors) {
  const std::vector<double> spacings{8, 4, 2};
  ResultAccuracy r;
  r.name = name;
  r.n_members = 4;
  r.refinement.spacings_m = spacings;
  r.refinement.means = {100, 100, 100};
  r.spread = spread;
  r.mean_errors = r.member_errors = ErrorCurve(spacings, errors);
  return r;
}

/// Run-out scatters and is exact anywhere, the area is the other way round.
LadderAccuracy ladder(const std::string& formulation) {
  LadderAccuracy l;
  l.formulation = formulation;
  l.spacings_m = {8, 4, 2};
  l.member_cpu_s = {1, 8, 64};
  l.seconds = {512, -3, 1};
  l.members = {0, 1, 2, 3};
  l.results = {result("runout_m", 20, {0.01, 0.01, 0.01}),
               result("reached_area_m2", 1e-3, {40, 20, 10})};
  return l;
}

Change change(double mean) { return {"runout_m", "m", mean, 1, 100, 4}; }

TEST(Certainty, OfThreeFormulationsLooksAtThePairsOfItsOwn) {
  CostStudy study;
  for (const char* name : {"a", "b", "c"}) study.ladders.push_back(ladder(name));
  study.models = {{"a", "b", {change(5)}}, {"a", "c", {change(-30)}}, {"b", "c", {change(12)}}};
  EXPECT_NEAR(certainty_at(study, 0, 2, 64).front().sampling, 1.645 * 0.2 / 8, 1e-5);  // 90 %
  EXPECT_DOUBLE_EQ(certainty_at(study, 0, 2, 64).front().model, 0.30);
  EXPECT_DOUBLE_EQ(certainty_at(study, 1, 2, 64).front().model, 0.12);
  EXPECT_DOUBLE_EQ(certainty_at(study, 2, 2, 64).front().model, 0.30);
}

std::string best_for(const std::vector<std::string>& wanted) {
  CostStudy study;
  study.ladders.push_back(ladder("a"));
  study.planned_members = 64;
  CostQuestions questions;
  questions.wanted = wanted;
  for (const std::string& line : ladder_sentences(study, 0, questions))
    if (line.starts_with("Best for")) return line;
  return {};
}

TEST(BestFor, IsOverWhatWasAskedForAndSaysWhenItIsAnEdge) {
  const std::string runout = best_for({"runout_m", map_word});
  EXPECT_THAT(runout, HasSubstr("over run-out: "));
  EXPECT_THAT(runout, HasSubstr("members at 8 m"));
  EXPECT_THAT(runout, HasSubstr("the coarsest computed, coarser may be better"));
  const std::string area = best_for({"reached_area_m2"});
  EXPECT_THAT(area, HasSubstr("over area reached: "));
  EXPECT_THAT(area, HasSubstr("members at 2 m"));
  EXPECT_THAT(area, HasSubstr("the finest computed, finer may be better"));
}

}  // namespace
}  // namespace sturz::workflow
