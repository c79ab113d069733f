// SPDX-License-Identifier: Apache-2.0
#include "engine/core/error.hpp"
#include "ensemble/sampling/design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace sturz {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

DesignTable random_table(std::size_t n_keys, std::size_t n_members) {
  std::mt19937_64 random(4);
  DesignTable table;
  table.design = Design::sobol;
  table.seed = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t k = 0; k < n_keys; ++k) {
    table.keys.push_back("block.key" + std::to_string(k));
    table.units.push_back(k % 2 ? "kg m-3" : "1");
  }
  const auto any_finite = [&] {  // every exponent, subnormals too
    for (;;)
      if (const double v = std::bit_cast<double>(random()); std::isfinite(v)) return v;
  };
  for (std::size_t m = 0; m < n_members; ++m) {
    table.values.emplace_back();
    table.unit_cube.emplace_back();
    for (std::size_t k = 0; k < n_keys; ++k) {
      table.values.back().push_back(any_finite());
      table.unit_cube.back().push_back(static_cast<double>(random() >> 11) * 0x1p-53);
    }
  }
  return table;
}

std::string error_of(const std::string& text) {
  try {
    from_csv(text);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "no error";
}

TEST(DesignCsv, SurvivesTheRoundTripBitByBit) {
  for (const std::size_t n_keys : {0U, 1U, 4U}) {
    const DesignTable table = random_table(n_keys, 200);
    EXPECT_EQ(from_csv(to_csv(table)), table) << n_keys << " keys";
  }
}

TEST(DesignCsv, KeepsTheSignOfZero) {
  DesignTable table = random_table(1, 1);
  table.values[0][0] = -0.0;
  EXPECT_TRUE(std::signbit(from_csv(to_csv(table)).values[0][0]));
}

TEST(DesignCsv, KeepsATableWithoutUnitCube) {
  DesignTable table = random_table(2, 3);
  table.design = Design::table;
  table.unit_cube.clear();
  EXPECT_EQ(from_csv(to_csv(table)), table);
}

TEST(DesignCsv, SaysWhatItIs) {
  DesignTable table = random_table(1, 1);
  table.seed = 12;
  table.values = {{0.1}};
  table.unit_cube = {{0.5}};
  EXPECT_EQ(to_csv(table),
            "# design table: one row per member, drawn once\n"
            "# design: sobol\n# seed: 12\n# units: 1\n"
            "member,block.key0,unit_cube:block.key0\n"
            "0,0.10000000000000001,0.5\n");
}

TEST(DesignCsv, ReadsAUsersPlainTable) {
  const DesignTable table =
      from_csv("\xEF\xBB\xBF# from the survey\r\n\r\n\"a.b\" , c.d\r\n1, 2e-3\r\n-3,4\r\n");
  EXPECT_THAT(table.keys, ElementsAre("a.b", "c.d"));
  EXPECT_THAT(table.values, ElementsAre(ElementsAre(1, 2e-3), ElementsAre(-3, 4)));
  EXPECT_EQ(table.design, Design::table);
  EXPECT_TRUE(table.unit_cube.empty());
}

TEST(DesignCsv, NamesTheLineOfAnError) {
  EXPECT_THAT(error_of("a,b\n1,2\n1\n"), StartsWith("design table, line 3: 1 cells for 2"));
  EXPECT_THAT(error_of("a,b\n1,x\n"), HasSubstr("line 2: 'x' in column b"));
  EXPECT_THAT(error_of("a,b\n1,\n"), HasSubstr("line 2: '' in column b"));
  EXPECT_THAT(error_of("a,b\n1,inf\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of("a;b\n1;2\n"), HasSubstr("separated by ';'"));
  EXPECT_THAT(error_of("a,,b\n1,2,3\n"), HasSubstr("no name"));
  EXPECT_THAT(error_of("member,a\n0,1\n2,1\n"), HasSubstr("member '2' where 1 is due"));
  EXPECT_THAT(error_of("# seed: -1\na\n1\n"), HasSubstr("seed '-1'"));
  EXPECT_THAT(error_of("a,unit_cube:b\n1,0.5\n"), HasSubstr("unit_cube columns"));
}

TEST(DesignCsv, RefusesEmptyText) {
  EXPECT_THAT(error_of(""), HasSubstr("no line of keys"));
  EXPECT_THAT(error_of("a,b\n"), HasSubstr("no rows"));
}

}  // namespace
}  // namespace sturz
