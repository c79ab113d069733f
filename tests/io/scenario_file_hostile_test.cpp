// SPDX-License-Identifier: Apache-2.0
// Files that want to hang, crash or mislead the reader.
#include "io/scenario/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>

namespace sturz {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Processor time, so that a busy machine does not count.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::string message(const std::string& text) {
  try {
    read_scenario_text(text, "s.yaml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HostileScenario, EmptyFilesAreSaidToBeEmpty) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "\xef\xbb\xbf"})
    EXPECT_THAT(message(text), HasSubstr("s.yaml: is empty")) << text;
  EXPECT_THAT(message("---\n"), HasSubstr("must be a list of keys"));
  EXPECT_THAT(message("just words"), HasSubstr("must be a list of keys"));
  EXPECT_THAT(message("[1, 2]"), HasSubstr("must be a list of keys"));
}

TEST(HostileScenario, AnchorsAndAliasesAreRefused) {
  EXPECT_THAT(message("a: &x 1\nb: *x\n"), HasSubstr("s.yaml:1:4: an anchor '&' (not allowed"));
  EXPECT_THAT(message("&a [*a]"), HasSubstr("an anchor"));
  EXPECT_THAT(message("a: *x\n"), HasSubstr("s.yaml:1:4: not readable as YAML"));
  EXPECT_THAT(message("<<: {a: 1}\n"), HasSubstr("a merge key '<<' (not allowed"));
}

TEST(HostileScenario, ABillionLaughsEndAtTheFirst) {
  std::string text = "a0: &a0 [lol, lol, lol, lol, lol, lol, lol, lol, lol]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string mine = std::to_string(i), last = std::to_string(i - 1);
    text.append("a").append(mine).append(": &a").append(mine).append(" [*a").append(last);
    for (int k = 0; k < 8; ++k) text.append(", *a").append(last);
    text += "]\n";
  }
  const std::clock_t start = std::clock();
  EXPECT_THAT(message(text), HasSubstr("s.yaml:1:5: an anchor"));
  EXPECT_LT(seconds_since(start), 0.5);
}

TEST(HostileScenario, TagsAreRefused) {
  EXPECT_THAT(message("a: !!binary aGk=\n"), HasSubstr("the tag \"tag:yaml.org,2002:binary\""));
  EXPECT_THAT(message("!thing {a: 1}"), HasSubstr("the tag"));
}

TEST(HostileScenario, OneFileIsOneDocument) {
  EXPECT_THAT(message("title: a\n---\ntitle: b\n"), HasSubstr("a second document"));
}

TEST(HostileScenario, DepthAndSizeAreBounded) {
  for (const char bracket : {'[', '{'}) {
    const std::string many(60000, bracket);
    EXPECT_THAT(message(many), HasSubstr("s.yaml:1:1: a list or map as a key"));
    EXPECT_THAT(message("a:\n  " + many), HasSubstr("s.yaml:2:"));
    std::string nested = "a: ";
    for (int i = 0; i < 100; ++i) nested += bracket == '[' ? "[" : "{b: ";
    nested += std::string(100, bracket == '[' ? ']' : '}');
    EXPECT_THAT(message(nested), HasSubstr("nested deeper than 16 levels"));
  }
  std::string dashes;
  for (int i = 0; i < 20000; ++i) dashes += "- ";
  EXPECT_THAT(message(dashes), HasSubstr("nested deeper than 16 levels"));
  EXPECT_THAT(message("title: " + std::string(65536, 'x')),
              HasSubstr("s.yaml: is 65543 bytes long (a scenario file may have 65536)"));
}

TEST(HostileScenario, LargeLegalFilesTakeNoTime) {
  std::string keys, values = "hazard: {thickness_m: [1";
  for (int i = 0; keys.size() < 60000; ++i)
    keys.append("k").append(std::to_string(i)).append(": 1\n");
  while (values.size() < 60000) values += ",1";
  const std::clock_t start = std::clock();
  EXPECT_THAT(message(keys), HasSubstr("k1 (unknown key)"));
  EXPECT_THAT(message(keys), HasSubstr("s.yaml: and more problems. Mend these first."));
  EXPECT_THAT(message(values + "]}"), HasSubstr("every number must be above the one before"));
  EXPECT_THAT(message(std::string(60000, ' ') + "a"), HasSubstr("must be a list of keys"));
  EXPECT_LT(seconds_since(start), 10) << "0.4 s optimised; a sanitizer build takes longer";
}

TEST(HostileScenario, BytesThatAreNoTextAreNamed) {
  EXPECT_THAT(message(std::string("II*\0\x08\0\0\0", 8)), HasSubstr("`sturz init RASTER RELEASE"));
  EXPECT_THAT(message(std::string("title: a\0b", 10)), HasSubstr("s.yaml:1:9: a byte that is not"));
  EXPECT_THAT(message("title: x\nb: \xff\n"), HasSubstr("s.yaml:2:4: a byte that is not UTF-8"));
  EXPECT_THAT(message("title: \xc0\xaf"), HasSubstr("byte 0xc0"));
  EXPECT_THAT(message(std::string("\xff\xfe"
                                  "a\0:\0",
                                  6)),
              HasSubstr("byte 0xff"));
}

TEST(HostileScenario, BrokenYamlHasAPlace) {
  EXPECT_THAT(message("a: [1, 2\nb: 3\n"), HasSubstr("not readable as YAML"));
  EXPECT_THAT(message("a: 1\n  b: 2\n"), HasSubstr("s.yaml:2:4: not readable as YAML"));
  EXPECT_THAT(message("a:\n\t- 1\n"), HasSubstr("s.yaml:2:2: not readable as YAML"));
  EXPECT_THAT(message("\"a"), HasSubstr("not readable as YAML"));
  EXPECT_THAT(message("a: {b: 1"), HasSubstr("bracket"));
}

TEST(HostileScenario, ATabInFrontOfALineIsNamed) {
  EXPECT_THAT(message("title: x\nterrain:\n\traster: dem.tif\n"),
              HasSubstr("Line 3 is indented by a tab; YAML knows blanks only"));
  EXPECT_THAT(message("a:\r\n  \t- 1\r\n"), HasSubstr("Line 2 is indented by a tab"));
  EXPECT_THAT(message("a:\tx\n  b: 2\n"), Not(HasSubstr("tab"))) << "elsewhere a tab may stand";
}

TEST(HostileScenario, KeysAreNames) {
  EXPECT_THAT(message("? [a]\n: 1\n"), HasSubstr("a list or map as a key"));
  EXPECT_THAT(message(": 1\n"), HasSubstr("a key is missing before ':'"));
}

TEST(HostileScenario, MessagesStayShort) {
  const std::string text = message("title: [" + std::string(30000, 'x') + "]\n");
  EXPECT_LT(text.size(), 1200u) << text;
  EXPECT_THAT(text, HasSubstr("..."));
}

}  // namespace
}  // namespace sturz
