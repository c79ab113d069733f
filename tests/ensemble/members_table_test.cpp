// SPDX-License-Identifier: Apache-2.0
#include "ensemble/members/members_table.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sturz {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

DesignTable design() {
  DesignTable table;
  table.keys = {"basal.friction_coefficient", "release.volume_m3"};
  table.units = {"1", "m3"};
  table.values = {{0.1, 2e6}, {1.0 / 3, 1e-300}};
  return table;
}

std::vector<MemberSummary> summaries() {
  std::vector<MemberSummary> members(2);
  members[0].member = 1;
  members[0].outcome = Outcome::failed;
  members[0].reason = "release.polygon: \"source.gpkg\", layer 2\nis empty";
  members[1].member = 0;
  members[1].outcome = Outcome::settled;
  members[1].formulation = "full_stress";
  members[1].state_hash = 0xABC;
  members[1].warnings = "thin flow";
  members[1].scalars.runout_m = 0.1 + 0.2;
  members[1].scalars.max_speed_m_s = nan_d;
  return members;
}

/// Lines of text outside quotes.
std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == '\n' && !quoted)
      result.emplace_back();
    else
      result.back() += c;
  }
  result.pop_back();
  return result;
}

/// Cells of one line, unquoted.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      result.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      result.emplace_back();
    else
      result.back() += line[i];
  }
  return result;
}

std::size_t column(const std::vector<std::string>& header, const std::string& name) {
  return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
}

TEST(MembersCsv, HasOneLinePerMemberInAscendingOrder) {
  const auto table = lines(members_csv(design(), summaries()));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table[0],
              StartsWith("member,outcome,censored,reason,formulation,basal.friction_coefficient,"
                         "release.volume_m3,"));
  EXPECT_THAT(table[1], StartsWith("0,settled,none,,full_stress,0.1,2000000"));
  const std::size_t width = cells(table[0]).size();
  const auto sparse = std::count_if(scalar_table().begin(), scalar_table().end(),
                                    [](const ScalarInfo& s) { return s.sparse; });
  EXPECT_EQ(width, 7 + scalar_table().size() - sparse + 3);
  for (const std::string& line : table) EXPECT_EQ(cells(line).size(), width);
}

TEST(MembersCsv, QuotesReasonsWithCommasQuotesAndLineEnds) {
  const auto table = lines(members_csv(design(), summaries()));
  EXPECT_EQ(cells(table[2])[3], "release.polygon: \"source.gpkg\", layer 2\nis empty");
  EXPECT_THAT(table[2], HasSubstr("\"release.polygon: \"\"source.gpkg\"\", layer 2\nis empty\""));
}

TEST(MembersCsv, WritesNumbersThatReadBackToTheSameBits) {
  const auto table = lines(members_csv(design(), summaries()));
  const auto header = cells(table[0]);
  EXPECT_EQ(std::stod(cells(table[1])[column(header, "runout_m")]), 0.1 + 0.2);
  EXPECT_EQ(std::stod(cells(table[2])[5]), 1.0 / 3);
  EXPECT_EQ(cells(table[1])[column(header, "max_speed_m_s")], "") << "NaN is an empty cell";
}

TEST(MembersCsv, SaysInAWordWhyAMembersEndWasNotSeen) {
  std::vector<MemberSummary> members = summaries();
  members[1].outcome = Outcome::left_terrain;
  members[1].censoring = Censoring::left_and_moving;
  members[1].scalars.lost_fraction = 0.25;
  const auto table = lines(members_csv(design(), members));
  const auto header = cells(table[0]), row = cells(table[1]);
  EXPECT_EQ(row[column(header, "censored")], "left_and_moving");
  EXPECT_EQ(row[column(header, "lost_fraction")], "0.25");
}

TEST(MembersCsv, HasColumnsOfGrainsAndLiquidWhereSomeMemberHasThem) {
  std::vector<MemberSummary> members = summaries();
  EXPECT_THAT(members_csv(design(), members), testing::Not(HasSubstr("liquid_lost_fraction")));
  members[1].scalars.solid_lost_fraction = 0, members[1].scalars.liquid_lost_fraction = 0.2;
  const auto table = lines(members_csv(design(), members));
  const auto header = cells(table[0]), row = cells(table[1]), failed = cells(table[2]);
  EXPECT_EQ(row[column(header, "solid_lost_fraction")], "0");
  EXPECT_EQ(row[column(header, "liquid_lost_fraction")], "0.2");
  EXPECT_EQ(failed[column(header, "liquid_lost_fraction")], "");
}

TEST(MembersCsv, GivesAFailedMemberNoResults) {
  const auto table = lines(members_csv(design(), summaries()));
  const auto header = cells(table[0]), good = cells(table[1]), failed = cells(table[2]);
  EXPECT_EQ(good[column(header, "state_hash")], "0000000000000abc");
  EXPECT_EQ(failed[column(header, "state_hash")], "");
  for (const ScalarInfo& scalar : scalar_table())
    if (!scalar.sparse) {
      EXPECT_EQ(failed[column(header, scalar.name)], "") << scalar.name;
    }
}

TEST(MembersCsv, RefusesMembersOfAnotherEnsemble) {
  std::vector<MemberSummary> members = summaries();
  members[0].member = 2;
  EXPECT_THROW(members_csv(design(), members), SetupError);
}

}  // namespace
}  // namespace sturz
