// SPDX-License-Identifier: Apache-2.0
#include "scenarios/schema/number_text.hpp"

#include "scenarios/schema/suggest.hpp"
#include "scenarios/schema/value_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz {
namespace {

TEST(NumberText, ReadsBackToTheSameBits) {
  for (const double v : {0.0, 0.1, -0.1, 1.0 / 3, 491000.0, 1e15, 1e300, 5e-324,
                         1.7976931348623157e308, 123456789.123456789, -2e-7, 9007199254740993.0})
    EXPECT_EQ(parse_number(number_text(v)), v) << number_text(v);
}

TEST(NumberText, LooksAsPeopleWriteNumbers) {
  EXPECT_EQ(number_text(240), "240");
  EXPECT_EQ(number_text(0.24), "0.24");
  EXPECT_EQ(number_text(1e6), "1000000");
  EXPECT_EQ(number_text(1e30), "1.0e+30") << "without the point other YAML readers see text";
}

TEST(NumberText, RefusesEverythingThatIsNoPlainDecimalNumber) {
  for (const char* text : {"", " 1", "1 ", "+1", "0x10", "nan", "inf", "-inf", "1e999", "1,5", "5m",
                           "1_000", "--1", "1e", ".", "1.5.2"})
    EXPECT_FALSE(parse_number(text)) << text;
  for (const char* text : {"1.0", "1e3", "9223372036854775808", "+1", "0x1", ""})
    EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Suggest, CountsEditsWithSwapsOfNeighbours) {
  EXPECT_EQ(edit_distance("friction", "friction"), 0);
  EXPECT_EQ(edit_distance("firction", "friction"), 1);
  EXPECT_EQ(edit_distance("frction", "friction"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(Suggest, GivesOnlyNamesThatCouldBeMeant) {
  EXPECT_EQ(nearest_name("frictoin", {"cohesion", "friction"}), "friction");
  EXPECT_EQ(nearest_name("porosity", {"cohesion", "friction"}), "");
  EXPECT_EQ(nearest_name("ab", {"xy"}), "") << "two edits of two letters are another word";
}

TEST(ValueText, QuotesWhatYamlWouldTakeForSomethingElse) {
  EXPECT_EQ(quoted_text("outflow"), "outflow");
  EXPECT_EQ(quoted_text("data/bed.tif"), "data/bed.tif");
  for (const char* word : {"", "no", "Yes", "null", "true", "5", "a: b", "- a", "#x", "a b"})
    EXPECT_EQ(quoted_text(word), std::string("\"").append(word).append("\""));
  EXPECT_EQ(quoted_text("a\"b\\c\nd\x01"), R"("a\"b\\c\nd\x01")");
}

}  // namespace
}  // namespace sturz
