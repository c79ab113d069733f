// SPDX-License-Identifier: Apache-2.0
#include "tests/hard/hard_case.hpp"

#include "tests/hard/cases/cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sturz::test {

bool Check::holds() const {
  return sense == Sense::at_most ? measured <= bound : measured >= bound;
}

double Check::used() const {
  const double part = sense == Sense::at_most ? measured : bound;
  const double whole = sense == Sense::at_most ? bound : measured;
  if (part == 0) return 0;
  return whole > 0 ? part / whole : std::numeric_limits<double>::infinity();
}

Check at_most(std::string quantity, double measured, double bound) {
  return {std::move(quantity), measured, bound, Check::Sense::at_most};
}

Check at_least(std::string quantity, double measured, double bound) {
  return {std::move(quantity), measured, bound, Check::Sense::at_least};
}

bool CaseReport::holds() const {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.holds(); });
}

std::span<const HardCase> hard_cases() {
  static constexpr HardCase cases[] = {
      {"I1", "cohesive bank of 0.75 of its critical height stands", cohesive_bank_stands},
      {"I1", "cohesive bank of 0.9 of its critical height stands", bank_near_its_height},
      {"I1", "cohesive bank of 1.2 of its critical height falls", tall_bank_falls},
      {"I1", "plane strain bank of 0.9 stands", plane_strain_bank_near_its_height},
      {"I1", "plane strain bank of 1.2 falls", plane_strain_bank_falls},
      {"I1", "cohesive bar pulled to 1.3 of its length", stretched_bar},
      {"I4", "heap at rest on a slope for 10 s", heap_on_a_slope},
      {"I5", "fraction swings across 0.6 and 0.02", breathing, true},
      {"I6", "loose layer pressed to the largest fraction at 10 m/s", pressed_to_the_limit, true},
      {"I11", "block dropped on a 60 degree face at 100 m/s", drop_on_60_degrees},
      {"I11", "block dropped on an 80 degree face at 100 m/s", drop_on_80_degrees},
      {"I12", "collapsing column, shear at the scale of the particles", banding},
      {"I13", "mass flies apart until all are alone", jet_breaks_up, true},
      {"I14", "particles touch at 1e-6 to 1 m/s and separate", slow_contacts_part, true},
      {"I15", "masses of the particles of a member", masses_mix, true},
      {"I16", "gate taken away from a column at rest", gate_removal},
      {"I16", "particles leave and come back over a cliff", isolated_come_and_go, true},
      {"I17", "steep member again, on two threads", same_bits},
  };
  return cases;
}

}  // namespace sturz::test
