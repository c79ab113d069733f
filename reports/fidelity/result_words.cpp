// SPDX-License-Identifier: Apache-2.0
#include "reports/fidelity/result_words.hpp"

#include "reports/page/text.hpp"

#include <map>

namespace sturz {

std::string result_words(const std::string& name) {
  static const std::map<std::string, std::string> known{
      {"runout_m", "run-out"},
      {"reached_area_m2", "area reached"},
      {"com_travel_m", "way of the centre of mass"},
      {"max_speed_m_s", "largest speed"},
      {"max_thickness_m", "largest thickness"},
      {"max_energy_j_m2", "largest kinetic energy per area"}};
  const auto found = known.find(name);
  return found == known.end() ? words_without_unit(name) : found->second;
}

}  // namespace sturz
