// SPDX-License-Identifier: Apache-2.0
// Keys of grains that are computed one by one: grains.discrete.
#include "scenarios/schema/rows/rows.hpp"

namespace sturz::schema_rows {
namespace {

constexpr auto discrete = blocks::at<&Scenario::grains, &GrainsSpec::discrete>;

}  // namespace

void add_discrete_keys(std::vector<KeyInfo>& keys) {
  using enum ValueKind;
  const auto add = [&keys](auto member, const Row& row) {
    keys.push_back(key(discrete, member, row));
  };
  const auto add_positive = [&keys](auto member, const Row& row) {
    keys.push_back(above_min(key(discrete, member, row)));
  };
  add_positive(&DiscreteSpec::diameter_m,
               {"grains.discrete.diameter_m", uncertain, "m", 0, 100,
                "Diameter of the mean grain that is computed; by default grains.diameter_m. It "
                "sets their number in the place of numerics.spacing_m."});
  add(&DiscreteSpec::size_spread,
      {"grains.discrete.size_spread", number, "1", 0, 0.3,
       "Diameters lie evenly between 1 - this and 1 + this times the mean; grains all alike form "
       "crystals."});
  add_positive(&DiscreteSpec::youngs_modulus_pa,
               {"grains.discrete.youngs_modulus_pa", number, "Pa", 0, 1e13,
                "Stiffness of the grains at most; softened as far as greatest_overlap lets it."});
  add(&DiscreteSpec::greatest_overlap,
      {"grains.discrete.greatest_overlap", number, "1", 0.005, 0.25,
       "Overlap over the radius of an impact at the speed that is expected; under weight a tenth "
       "of it. Less is stiffer, truer and dearer."});
  add_positive(&DiscreteSpec::restitution,
               {"grains.discrete.restitution", uncertain, "1", 0, 0.999,
                "Share of the speed that two grains keep; of the bed it is basal.restitution."});
  add(&DiscreteSpec::friction_coefficient, {"grains.discrete.friction_coefficient", uncertain, "1",
                                            0, 2, "Sliding friction between two grains."});
  add(&DiscreteSpec::rolling_friction,
      {"grains.discrete.rolling_friction", uncertain, "1", 0, 2,
       "Rolling friction between two grains: moment over normal force and reduced radius."});
  add(&DiscreteSpec::bed_rolling_friction,
      {"grains.discrete.bed_rolling_friction", uncertain, "1", 0, 2,
       "The same on the bed; by default the bed's own friction coefficient, so that a grain does "
       "not roll where it would not slide."});
}

void add_discrete_blocks(std::vector<BlockInfo>& blocks) {
  blocks.push_back(optional_block("grains.discrete",
                                  "Grains one by one, with contacts; formulation: discrete only.",
                                  discrete));
}

}  // namespace sturz::schema_rows
