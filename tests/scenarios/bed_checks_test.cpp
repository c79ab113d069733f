// SPDX-License-Identifier: Apache-2.0
// Rasters of the bed and its SamosAT form: what goes together, and what a member gets.
#include "scenarios/assembly/bed/bed_rasters_plan.hpp"
#include "scenarios/assembly/formulation.hpp"
#include "scenarios/assembly/reach.hpp"
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/validate.hpp"
#include "scenarios/schema/schema.hpp"
#include "tests/support/distributions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Scenario slide() {
  Scenario s = ramp_slide();
  s.formulation = Formulation::depth_averaged;
  return s;
}
std::vector<std::string> paths(const Scenario& s) {
  std::vector<std::string> out;
  for (const Problem& p : validate(s)) out.push_back(p.path);
  return out;
}

TEST(BedChecks, AcceptWhatGoesTogether) {
  Scenario s = slide();
  s.basal.rasters.friction_coefficient = {"mu.tif", Uncertain(1.1)};
  s.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  s.basal.rasters.crs = "EPSG:2056";
  EXPECT_THAT(paths(s), IsEmpty());
  s = slide();
  s.basal.samosat.emplace();
  s.basal.rasters.friction_coefficient.path = "mu.tif";
  EXPECT_THAT(paths(s), IsEmpty());
}

TEST(BedChecks, NameWhatExcludesEachOther) {
  Scenario s = slide();
  s.basal.rasters.cohesion_pa.factor = Uncertain(2);
  s.basal.rasters.crs = "EPSG:2056";
  EXPECT_THAT(paths(s), ElementsAre("basal.rasters.cohesion_pa_factor", "basal.rasters.crs"));

  s = slide();
  s.basal.samosat.emplace();
  s.basal.turbulent_coefficient_m_s2 = Uncertain(900);
  s.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  s.mixture.emplace();
  EXPECT_THAT(paths(s), ElementsAre("basal.samosat", "basal.samosat", "basal.samosat"));

  s = slide();
  s.mixture.emplace();
  s.basal.rasters.pore_pressure_ratio.path = "ru.tif";
  EXPECT_THAT(paths(s), ElementsAre("basal.rasters.pore_pressure_ratio"));

  s = slide();
  s.formulation = Formulation::full_stress;
  s.basal.samosat.emplace();
  EXPECT_THAT(paths(s), ElementsAre("basal.samosat"));
  s.basal.samosat.reset();
  s.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  EXPECT_THAT(paths(s), ElementsAre("basal.rasters.turbulent_coefficient_m_s2"));
}

TEST(BedChecks, AFactorIsAColumnOfTheDesign) {
  Scenario s = slide();
  s.basal.rasters.friction_coefficient.path = "mu.tif";
  s.basal.rasters.friction_coefficient.factor.emplace().distribution =
      test::bounded(Distribution::Kind::uniform, 0.8, 1.2);
  const auto keys = uncertain_keys(s);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].path, "basal.rasters.friction_coefficient_factor");
  EXPECT_EQ(with_value(s, keys[0].path, 0.9).basal.rasters.friction_coefficient.factor,
            Uncertain(0.9));
  s.basal.rasters.friction_coefficient.factor->distribution = test::normal(1, 0.1);
  EXPECT_THAT(validate(s).at(0).message, HasSubstr("Truncate it"));
}

/// Two rasters over four cells, and a zone.
SceneInputs inputs() {
  SceneInputs in;
  in.elevation = std::make_shared<const Raster<double>>(Grid{2, 2, 0, 2, 1, ""}, 0.0);
  for (const BedNumber number : {BedNumber::friction, BedNumber::turbulence}) {
    BedLayerInput& layer = in.bed_layers.emplace_back();
    layer.number = number;
    auto values = std::make_shared<Raster<double>>(in.elevation->grid, 0.5);
    values->at(0, 1) = nan_d;
    layer.values = values;
    layer.least = 0.25, layer.most = 0.5, layer.mean = 0.375;
  }
  return in;
}

TEST(BedChecks, AMemberHasItsFactorAndItsZones) {
  Scenario s = slide();
  s.basal.rasters.friction_coefficient = {"mu.tif", Uncertain(2)};
  s.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  BasalZone& zone = s.basal.zones.emplace_back();
  zone.polygon = "wood.gpkg", zone.turbulent_coefficient_m_s2 = Uncertain(400);
  const BedRasters rasters = plan_bed_rasters(s, inputs());
  ASSERT_EQ(rasters.layers.size(), 2U);
  BasalResistance bed;
  bed.friction_coefficient = 0.3, bed.turbulent_coefficient = 400;
  const BasalResistance open = rasters.over(bed, 0, 0.5, 1.5),
                        wood = rasters.over(bed, 1, 0.5, 1.5);
  EXPECT_EQ(open.friction_coefficient, 1);
  EXPECT_EQ(open.turbulent_coefficient, 0.5);
  EXPECT_EQ(wood.friction_coefficient, 1);
  EXPECT_EQ(wood.turbulent_coefficient, 400);
  EXPECT_EQ(rasters.over(bed, 0, 1.5, 1.5).friction_coefficient, 0.3);
  EXPECT_EQ(rasters.range(bed, BedNumber::friction), std::pair(0.3, 1.0));
}

TEST(BedChecks, EstimatesKnowTheRasters) {
  Scenario s = slide();
  s.basal.friction_coefficient = Uncertain(0.6);
  s.basal.rasters.friction_coefficient = {"mu.tif", Uncertain(2)};
  EXPECT_EQ(typical_friction(with_typical_bed(s, inputs())), 0.75);
  s.basal.rasters.friction_coefficient.factor->distribution =
      test::bounded(Distribution::Kind::uniform, 0.8, 1.2);
  EXPECT_EQ(drawn_bed_range(s, inputs(), BedNumber::friction), std::pair(0.2, 0.6));
  EXPECT_EQ(drawn_bed_range(s, {}, BedNumber::friction), std::pair(0.6, 0.6));
  s.formulation = Formulation::automatic;
  s.basal.rasters.turbulent_coefficient_m_s2.path = "xi.tif";
  const Raster<double> thick(Grid{9, 9, 0, 9, 1, ""}, 50.0);
  EXPECT_THAT(choose_formulation(s, thick).reason,
              HasSubstr("`basal.rasters.turbulent_coefficient_m_s2` acts on columns"));
}

}  // namespace
}  // namespace sturz
