// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/member_result.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

namespace sturz {
namespace {

TEST(MemberResult, EveryLayerHasItsOwnNameAndUnit) {
  std::set<std::string> names;
  for (int i = 0; i < n_peak_layers; ++i) {
    const PeakLayerInfo& layer = info(static_cast<PeakLayer>(i));
    names.insert(layer.name);
    EXPECT_GT(std::strlen(layer.units), 0u);
    EXPECT_GT(std::strlen(layer.long_name), 0u);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(n_peak_layers));
  EXPECT_STREQ(info(PeakLayer::thickness).name, "peak_thickness");
  EXPECT_STREQ(info(PeakLayer::energy).units, "J m-2");
  EXPECT_STREQ(info(PeakLayer::deposit).name, "deposit_thickness");
}

TEST(MemberResult, OnlyWhatNeedsAFlowIsUndefinedWhereNothingCame) {
  for (int i = 0; i < n_peak_layers; ++i) {
    const auto layer = static_cast<PeakLayer>(i);
    const bool needs_flow = layer == PeakLayer::arrival || layer == PeakLayer::solid_arrival ||
                            layer == PeakLayer::liquid_arrival ||
                            layer == PeakLayer::liquid_fraction;
    EXPECT_EQ(std::isnan(info(layer).untouched), needs_flow) << info(layer).name;
  }
}

TEST(MemberResult, TheScalarTableNamesEveryFieldOnceInOrder) {
  MemberScalars s;
  std::set<std::string> names;
  const double* first = &s.runout_m;
  std::ptrdiff_t expected = 0;
  for (const ScalarInfo& scalar : scalar_table()) {
    names.insert(scalar.name);
    EXPECT_EQ(&(s.*scalar.field) - first, expected++) << scalar.name;
    EXPECT_GT(std::strlen(scalar.units), 0u);
  }
  EXPECT_EQ(names.size(), scalar_table().size());
  EXPECT_EQ(names.size() * sizeof(double), sizeof(MemberScalars));
}

TEST(MemberResult, ConcernsAMaterialByWhatLeftOfIt) {
  MemberScalars m;
  using C = Censoring;
  EXPECT_EQ(censoring_of(Phase::grains, m, C::left_terrain), C::left_terrain) << "not told apart";
  m.solid_lost_fraction = 0, m.liquid_lost_fraction = 1e-9;
  EXPECT_EQ(censoring_of(Phase::both, m, C::left_and_moving), C::left_and_moving);
  EXPECT_EQ(censoring_of(Phase::grains, m, C::left_terrain), C::none);
  EXPECT_EQ(censoring_of(Phase::grains, m, C::left_and_moving), C::still_moving);
  EXPECT_EQ(censoring_of(Phase::liquid, m, C::left_and_moving), C::left_and_moving);
  EXPECT_EQ(censoring_of(Phase::liquid, m, C::none), C::none);
}

TEST(MemberResult, UnitsAgreeWithTheNames) {
  const std::pair<const char*, const char*> endings[] = {
      {"_m2_s2", "m2 s-2"}, {"_m_s", "m s-1"}, {"_j_m2", "J m-2"}, {"_m2", "m2"}, {"_m3", "m3"},
      {"_kg", "kg"},        {"_pa", "Pa"},     {"_s", "s"},        {"_m", "m"}};
  for (const ScalarInfo& scalar : scalar_table()) {
    const std::string name = scalar.name;
    std::string_view unit = "1";
    for (const auto& [ending, u] : endings)
      if (name.size() > std::strlen(ending) && name.ends_with(ending)) {
        unit = u;
        break;
      }
    if (name == "n_steps" || name == "n_particles" || name == "release_layers") unit = "1";
    EXPECT_EQ(std::string_view(scalar.units), unit) << name;
  }
}

}  // namespace
}  // namespace sturz
