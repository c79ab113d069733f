// SPDX-License-Identifier: Apache-2.0
// What a run says of columns that did what no grains can.
#include "engine/effects/columns/shared.hpp"
#include "tests/support/hand_made.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Of a mass that was `thickness` thick and rose by `rise` above its energy head.
std::vector<std::string> said_of(double rise, double thickness) {
  const State state(test::even_ground(4), {});
  ColumnFlow flow(0, {});
  flow.release_top = 1800, flow.release_thickness = thickness;
  flow.highest_surface = 1800 + rise;
  std::vector<std::string> out;
  warn_of_implausible(state, flow, out);
  return out;
}

TEST(Plausible, ARiseIsNeverSaidToBeNothing) {
  EXPECT_THAT(said_of(0.31, 2), ElementsAre(HasSubstr("rose 0.31 m above")));
  EXPECT_THAT(said_of(0.31, 0.4), ElementsAre(HasSubstr("(it was 0.4 m thick)")));
  EXPECT_THAT(said_of(1.26, 6), ElementsAre(HasSubstr("rose 1.3 m above")));
  EXPECT_THAT(said_of(112.4, 99.97),
              ElementsAre(::testing::AllOf(HasSubstr("rose 112 m above"),
                                           HasSubstr("(it was 100 m thick)"))));
}

TEST(Plausible, ARiseThatSmoothingMayMakeIsNotSaid) { EXPECT_THAT(said_of(0.19, 2), IsEmpty()); }

}  // namespace
}  // namespace sturz
