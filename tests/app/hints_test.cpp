// SPDX-License-Identifier: Apache-2.0
// What the program says to words that it does not know, and before it computes.
#include "tests/app/app_fixture.hpp"

#include <algorithm>
#include <sstream>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Hints : public App {};

TEST_F(Hints, HelpIsACommandToo) {
  const Ended all = sturz({"help"}), one = sturz({"help", "run"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(all.out, sturz({"--help"}).out);
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, sturz({"run", "--help"}).out);
}

TEST_F(Hints, HelpOnAWordThatIsNoCommandNamesTheNearest) {
  const Ended ended = sturz({"help", "ensembl"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("There is no command 'ensembl'. Did you mean ensemble?"));
  EXPECT_EQ(ended.out, "");
}

TEST_F(Hints, HelpFitsTheTerminal) {
  std::vector<std::string> words = environment();
  words.emplace_back("COLUMNS=64");
  const Ended ended = run_process(command({"ensemble", "--help"}), path("."), words);
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  std::istringstream lines(ended.out);
  std::size_t longest = 0, n = 0;
  for (std::string line; std::getline(lines, line); ++n) longest = std::max(longest, line.size());
  EXPECT_LE(longest, 64);
  EXPECT_GT(n, 30);
  std::string in_one = ended.out, plain = sturz({"ensemble", "--help"}).out;
  const auto is_blank = [](char c) { return c == ' ' || c == '\n'; };
  std::erase_if(in_one, is_blank), std::erase_if(plain, is_blank);
  EXPECT_EQ(in_one, plain) << "no word is lost or torn";
}

TEST_F(Hints, ANearCommandIsSuggested) {
  const Ended ended = sturz({"ensembl", path("scene.yaml")});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("There is no command 'ensembl'. Did you mean ensemble?"));
  EXPECT_THAT(sturz({"desribe"}).err, HasSubstr("Did you mean describe?"));
  EXPECT_THAT(ended.err, Not(HasSubstr("A subcommand is required"))) << "one was given";
  EXPECT_THAT(ended.err, HasSubstr("sturz help"));
  EXPECT_THAT(sturz({"xyzzyxyzzy"}).err, HasSubstr("Commands: "));
  EXPECT_THAT(sturz({}).err, HasSubstr("`sturz help` lists them"));
}

TEST_F(Hints, AValueOfTheScenarioIsSet) {
  const Ended ended = sturz({"run", path("scene.yaml"), "--spacing", "5"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("--spacing is a value of the scenario: --set "
                                   "numerics.spacing_m=5"));
  EXPECT_THAT(sturz({"run", path("scene.yaml"), "--volume-m3=4e5"}).err,
              HasSubstr("--set release.volume_m3=4e5"));
}

TEST_F(Hints, ANearOptionIsSuggested) {
  EXPECT_THAT(sturz({"ensemble", path("scene.yaml"), "--worker", "2"}).err,
              HasSubstr("Did you mean --workers?"));
}

TEST_F(Hints, NoSecondsBetweenFramesIsExplained) {
  const Ended ended = sturz({"run", path("scene.yaml"), "--particles", "0"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("0 (must be seconds above 0, such as 0.5)"));
}

TEST_F(Hints, TextOfTheUserCannotCommandTheTerminal) {
  write("red.yaml", replaced(tiny_scene(), "title: tiny slide",
                             "title: \"\\e[31mred\\e]0;owned\\a \\x9b31m\""));
  const Ended ended = sturz({"describe", path("red.yaml")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("\\x1b[31mred\\x1b]0;owned\\x07 \\x9b31m"));
  EXPECT_THAT(ended.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(ended.out, Not(HasSubstr("\xc2\x9b")));
}

TEST_F(Hints, ATitleWithAColonIsExplained) {
  write("colon.yaml", replaced(tiny_scene(), "title: tiny slide", "title: North: second try"));
  EXPECT_THAT(sturz({"describe", path("colon.yaml")}).err,
              HasSubstr("must stand in quotes: title: \"North: second try\""));
}

TEST_F(Hints, DescribeTellsBulkDensityAndWhatDoesNothing) {
  const Ended ended =
      sturz({"describe", path("scene.yaml"), "--set", "formulation=depth_averaged", "--set",
             "grains.density_kg_m3=200", "--set", "grains.earth_pressure=isotropic"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("bulk density: 120 kg/m3 (grains of 200 kg/m3, solid fraction "
                                   "0.6; grains lighter than ice: if 200 is the bulk density, "
                                   "write 333.33)"));
  EXPECT_THAT(ended.out, HasSubstr("without effect in depth_averaged: grains.friction_angle_deg"));
  // Effects that are on have a line each, the others one line together.
  EXPECT_THAT(ended.out, HasSubstr("\neffect gravity: on (always)\n"));
  EXPECT_THAT(ended.out, HasSubstr("\neffects off: "));
  EXPECT_THAT(ended.out, Not(HasSubstr(": off (")));
  EXPECT_THAT(sturz({"describe", path("scene.yaml")}).out,
              HasSubstr("bulk density: 1560 kg/m3 (grains of 2600 kg/m3, solid fraction 0.6)"));
}

TEST_F(Hints, DescribeLooksAtTheEnsemble) {
  const Ended same =
      sturz({"describe", path("scene.yaml"), "--set", "basal.friction_coefficient=0.3", "--set",
             "basal.pore_pressure_ratio=0"});
  EXPECT_THAT(same.err, HasSubstr("warning: nothing is uncertain: 6 members"));
  write("t.csv", "basal.friction_coefficient\n0.3\n");
  const Ended table = sturz({"describe", path("scene.yaml"), "--set", "ensemble.design=table",
                             "--set", "ensemble.table=t.csv"});
  EXPECT_EQ(table.exit_code, 1);
  EXPECT_THAT(table.err, AllOf(HasSubstr("t.csv"), HasSubstr("basal.pore_pressure_ratio")));
}

TEST_F(Hints, OneWorkerOfTwoThreadsSaysSo) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--workers", "1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("6 to do, 1 at a time"));
}

TEST_F(Hints, AWallOnTheWrongSideIsRefusedBeforeAnything) {
  const Ended ended = sturz({"ensemble", path("scene.yaml"), "-o", path("out"), "--set",
                             "domain={walls: [{point_m: [-55, 0, 0], normal: [-1, 0, 0]}]}"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("domain.walls[0]: the release lies behind this wall, all "
                                         "300 particles"),
                               HasSubstr("Turn the normal: [1, 0, 0]")));
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace sturz::test
